//! Formats with a mark of their own, each in a file.

mod arrays;
pub(crate) mod arrow;
pub(crate) mod camonitor;
mod channels;
pub(crate) mod eqmod;
pub(crate) mod hdf5;
pub(crate) mod iso230;
pub(crate) mod linuxcnc;
pub(crate) mod markdown;
pub(crate) mod matlab;
pub(crate) mod npy;
pub(crate) mod npz;
pub(crate) mod parquet;
pub(crate) mod phd2;
pub(crate) mod phd2_debug;
pub(crate) mod renishaw;
pub(crate) mod sigrok;
pub(crate) mod spreadsheet;
pub(crate) mod twincat;
mod unpacked;

use crate::error::ImportError;
use crate::place::Place;

/// The format of bytes that are no text; `None` for text.
pub(crate) fn binary(
    name: &str,
    bytes: &[u8],
) -> Result<Option<(&'static str, &'static str)>, ImportError> {
    let begins = |mark: &[u8]| bytes.starts_with(mark);
    let holds = |word: &[u8]| bytes.windows(word.len()).any(|window| window == word);
    if begins(b"PK\x03\x04") {
        let sigrok = bytes.get(30..37) == Some(b"version");
        return match () {
            () if sigrok => Ok(Some(("sigrok", "a ZIP archive that begins with `version`"))),
            () if holds(b"xl/") => {
                Ok(Some(("spreadsheet", "a ZIP archive with `xl/` in it: an Excel workbook")))
            }
            () if holds(b"opendocument") => {
                Ok(Some(("spreadsheet", "a ZIP archive of OpenDocument")))
            }
            () if holds(b".npy") => {
                Ok(Some(("npz", "a ZIP archive with `.npy` in it: arrays of NumPy")))
            }
            () => Err(refused(name, "a ZIP archive", "unpack it, and import what is in it")),
        };
    }
    let kinds: [(&[u8], &str, &str); 7] = [
        (b"\xD0\xCF\x11\xE0", "spreadsheet", "an old Excel workbook"),
        (b"\x93NUMPY", "npy", "the mark of NumPy"),
        (b"PAR1", "parquet", "the mark of Parquet"),
        (b"ARROW1", "arrow", "the mark of Arrow"),
        (b"MATLAB 5.0", "matlab", "the mark of MATLAB up to version 7"),
        (b"MATLAB 7.3", "hdf5", "the mark of MATLAB 7.3, whose files are HDF5"),
        (b"\x89HDF", "hdf5", "the mark of HDF5"),
    ];
    if let Some((_, format, reason)) = kinds.iter().find(|(mark, ..)| begins(mark)) {
        return Ok(Some((format, reason)));
    }
    let foreign: [(&[u8], &str, &str); 5] = [
        (b"FEA1", "Feather of version 1", "write it anew: pyarrow writes version 2"),
        (
            b"\xFF\xFF\xFF\xFF",
            "a stream of Arrow",
            "write it as a file of Arrow, which begins `ARROW1`",
        ),
        (b"\x1F\x8B", "a gzip archive", "`gunzip` unpacks it"),
        (b"%PDF", "a PDF", "export the table as text from the program that made it"),
        (b"\x50\x4B", "a broken ZIP archive", "fetch it again"),
    ];
    match foreign.iter().find(|(mark, ..)| begins(mark)) {
        Some((_, found, hint)) => Err(refused(name, found, hint)),
        None if is_old_matlab(bytes) => {
            Err(refused(name, "MATLAB of version 4", "`save -v7` writes a newer one"))
        }
        None => Ok(None),
    }
}

/// The head of a matrix of version 4: type, rows, columns, imaginary part, length of the name, name.
fn is_old_matlab(bytes: &[u8]) -> bool {
    let word = |at: usize| {
        let four = bytes.get(4 * at..4 * at + 4)?.try_into().ok()?;
        Some(u32::from_le_bytes(four)).and_then(|word| usize::try_from(word).ok())
    };
    let (Some(kind), Some(imaginary), Some(length)) = (word(0), word(3), word(4)) else {
        return false;
    };
    let name = bytes.get(20..20 + length.min(64)).and_then(|name| name.strip_suffix(b"\0"));
    let named = name.is_some_and(|name| !name.is_empty() && name.iter().all(u8::is_ascii_graphic));
    kind <= 52 && imaginary <= 1 && named
}

fn refused(name: &str, found: &str, hint: &str) -> ImportError {
    ImportError::found(Place::file(name), found, "a table of measured data").hinted(hint)
}

/// Refuses JSON: an object, or a list of objects, lists or numbers, which begins as no section `[…]` does.
pub(crate) fn check_text(name: &str, text: &str) -> Result<(), ImportError> {
    let text = text.trim_start();
    let behind = |mark: char| Some(text.strip_prefix(mark)?.trim_start());
    let object = behind('{').is_some_and(|rest| rest.starts_with(['"', '}']));
    let list = behind('[').is_some_and(|rest| {
        let number = rest.starts_with(|c: char| c.is_ascii_digit() || c == '-');
        rest.starts_with(['{', '[']) || number && rest.contains(',')
    });
    if object || list {
        return Err(refused(
            name,
            "JSON",
            "write its lists as the columns of a table, such as CSV",
        ));
    }
    Ok(())
}

/// The format of a text, by the words in it.
pub(crate) fn textual(name: &str, lines: &[&str]) -> (&'static str, &'static str) {
    let head = || lines.iter().take(400);
    let any = |fits: &dyn Fn(&str) -> bool| head().any(|line| fits(line.trim()));
    let ending = name.rsplit('.').next().unwrap_or_default().to_lowercase();
    if any(&|line| line.starts_with("Guiding Begins at") || line.starts_with("Frame,Time,mount,")) {
        ("phd2", "the words of a PHD2 guide log")
    } else if any(&phd2_debug::fits) {
        ("phd2-debug", "clock, seconds since the line before and thread begin each line")
    } else if any(&|line| eqmod::fits(line)) {
        ("eqmod", "the period of a worm behind `!`")
    } else if any(&|line| line.starts_with("DEVIATIONS::") || line.starts_with("TARGET DATA::")) {
        ("renishaw", "sections such as `DEVIATIONS::`")
    } else if any(&|line| {
        line.starts_with("REF_DATA_FWD[")
            || line.starts_with("TGT_DATA[")
            || line.contains("ref_pos(i,1)")
    }) {
        ("iso230", "target and reference positions of an ISO 230-2 test")
    } else if camonitor::fits(lines) {
        ("camonitor", "a name, a date, a time and a value in each line")
    } else if twincat::fits(lines) {
        ("twincat", "the header of a TwinCAT scope")
    } else if markdown::fits(lines) {
        ("markdown", "a line of dashes stands below a line of names")
    } else if ending == "comp" && linuxcnc::is_comp(lines) {
        ("linuxcnc-comp", "the ending `.comp` and three numbers a line")
    } else if linuxcnc::is_sampler(lines) {
        ("halsampler", "a number that counts samples begins each line, and there is no header")
    } else {
        ("table", "text with cells in lines")
    }
}
