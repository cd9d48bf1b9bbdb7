//! A file of columns, whatever its format.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use flate2::read::MultiGzDecoder;

use crate::error::TraceError;
use crate::table::Table;
use crate::{csv, parquet};

/// Longest file that is taken, bytes: ten million rows of three columns.
pub const LONGEST_BYTES: u64 = 256 << 20;

/// What a file compressed by gzip (RFC 1952, section 2.3.1) begins with.
const GZIP: &[u8] = b"\x1F\x8B";

/// Reads a file whole, once, so that it may be a pipe, and unpacks what gzip has compressed;
/// refuses one that does not end.
///
/// # Errors
///
/// What the system says, a damaged archive, and more than `most` bytes, packed or not.
pub fn read_bytes(path: &Path, most: u64) -> Result<Vec<u8>, TraceError> {
    let file =
        File::open(path).map_err(|source| TraceError::Read { path: path.to_owned(), source })?;
    let length = file.metadata().map_or(0, |found| found.len().min(most));
    let bytes = read_at_most(file, most, usize::try_from(length).unwrap_or(0), path)?;
    unpacked(bytes, most, path)
}

/// What gzip has compressed, or the bytes as they are; `path` is for messages only.
///
/// # Errors
///
/// A damaged archive, and one of more than `most` bytes.
pub fn unpacked(bytes: Vec<u8>, most: u64, path: &Path) -> Result<Vec<u8>, TraceError> {
    if bytes.starts_with(GZIP) {
        return read_at_most(MultiGzDecoder::new(bytes.as_slice()), most, bytes.len(), path);
    }
    Ok(bytes)
}

fn read_at_most(
    from: impl Read,
    most: u64,
    likely: usize,
    path: &Path,
) -> Result<Vec<u8>, TraceError> {
    let mut bytes = Vec::with_capacity(likely + 1);
    let read = from.take(most + 1).read_to_end(&mut bytes);
    read.map_err(|source| TraceError::Read { path: path.to_owned(), source })?;
    if most < bytes.len() as u64 {
        return Err(TraceError::TooLong { path: path.to_owned(), most });
    }
    Ok(bytes)
}

/// Reads a table of numbers, CSV or Parquet by what the file begins with.
///
/// # Errors
///
/// Whatever is wrong with the file, with its place; see [`csv::read_csv`] and
/// [`parquet::read_parquet`].
pub fn read_table(path: &Path) -> Result<Table, TraceError> {
    table_of(read_bytes(path, LONGEST_BYTES)?, path)
}

/// As [`read_table`], from bytes already at hand; `path` is for messages only.
///
/// # Errors
///
/// As [`read_table`].
pub fn table_of(bytes: Vec<u8>, path: &Path) -> Result<Table, TraceError> {
    if bytes.starts_with(b"PAR1") {
        return parquet::read_parquet(bytes, path);
    }
    match foreign_kind(&bytes) {
        Some(found) => Err(TraceError::Kind {
            path: path.to_owned(),
            found,
            expected: "comma-separated text or Parquet",
        }),
        None => csv::read_csv(&bytes, path),
    }
}

/// Kinds of file that people hand over by mistake.
fn foreign_kind(bytes: &[u8]) -> Option<&'static str> {
    const KINDS: &[(&[u8], &str)] = &[
        (b"PARE", "an encrypted Parquet file"),
        (b"PK\x03\x04", "a spreadsheet or a ZIP archive"),
        (b"\xD0\xCF\x11\xE0", "an old spreadsheet"),
        (b"\x89HDF", "an HDF5 file"),
        (b"ARROW1", "an Arrow file"),
        (b"\xFF\xFE", "UTF-16 text"),
        (b"\xFE\xFF", "UTF-16 text"),
        (b"{", "JSON"),
        (b"<", "HTML or XML"),
        (b"$date", "a value change dump"),
        (b"$version", "a value change dump"),
        (b"$timescale", "a value change dump"),
    ];
    // A sigrok session is a ZIP archive whose first file is called `version`.
    if bytes.starts_with(b"PK\x03\x04") && bytes.get(30..37) == Some(b"version") {
        return Some("a sigrok session (`sigrok-cli -i FILE -O vcd` makes a capture of it)");
    }
    let known = KINDS.iter().find(|(start, _)| bytes.starts_with(start)).map(|(_, kind)| *kind);
    known.or_else(|| bytes.contains(&0).then_some("binary data"))
}

#[cfg(test)]
mod tests {
    use std::io::Write;

    use flate2::Compression;
    use flate2::write::GzEncoder;

    use super::*;

    #[test]
    fn what_gzip_packed_is_unpacked_to_a_limit() {
        let mut packed = GzEncoder::new(Vec::new(), Compression::default());
        packed.write_all(&[b'1'; 5000]).unwrap();
        let packed = packed.finish().unwrap();
        let read = |bytes: &[u8], most| {
            let read = unpacked(bytes.to_vec(), most, Path::new("data.csv.gz"));
            read.map_err(|error| error.to_string())
        };
        assert_eq!(read(&packed, 5000).unwrap(), [b'1'; 5000]);
        // Members of an archive are one behind the other.
        assert_eq!(read(&packed.repeat(2), 10_000).unwrap(), [b'1'; 10_000]);
        assert!(read(&packed, 4999).unwrap_err().contains("more than 4999 bytes"));
        assert!(read(&packed[..packed.len() - 1], 5000).unwrap_err().ends_with("cannot be read"));
    }

    #[test]
    fn foreign_files_are_recognised() {
        assert_eq!(foreign_kind(b"PK\x03\x04rest"), Some("a spreadsheet or a ZIP archive"));
        let session = [&b"PK\x03\x04"[..], &[0; 26], b"version"].concat();
        assert!(foreign_kind(&session).is_some_and(|kind| kind.starts_with("a sigrok session")));
        assert_eq!(foreign_kind(b"a,b\n1,2\0\n"), Some("binary data"));
        assert_eq!(foreign_kind(b"a,b\n1,2\n"), None);
    }
}
