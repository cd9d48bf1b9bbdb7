//! MATLAB files up to version 7: arrays of numbers, in whatever structure or cell; texts are passed over.
//!
//! Format: `MathWorks`, "MAT-File Format", version 5: elements of a type and a length, an array being
//! one that holds four others, a structure one that holds arrays. Version 7.3 is HDF5. Of the crates for it one prints on its own and
//! refuses a file for one array of whole numbers, the other needs a crate that is given up.

use std::io::Read;

use flate2::read::ZlibDecoder;

use super::arrays::{self, Array};
use crate::decide::Decisions;
use crate::error::ImportError;
use crate::grid::Grid;
use crate::limits;
use crate::place::Place;

/// Bytes of text, version and byte order before the first element.
const HEADER: usize = 128;
/// Bytes that say of what type and how long an element is.
const TAG: usize = 8;
/// Types of elements: an array, and one that is packed.
const MATRIX: u32 = 14;
const PACKED: u32 = 15;
/// Classes of arrays that hold arrays.
const CELLS: u32 = 1;
const STRUCTURE: u32 = 2;
/// Deepest structures; programs write two or three.
const DEPTH: usize = 16;
/// Class of arrays that hold their elements beside zeros alone.
const SPARSE: u32 = 5;
/// Classes of arrays whose elements are numbers, and the mark of complex ones.
const NUMBERS: std::ops::RangeInclusive<u32> = 6..=15;
const COMPLEX: u32 = 0x800;

/// Reads the arrays as a grid with one row of names.
pub(crate) fn grid(bytes: &[u8], decisions: &mut Decisions<'_>) -> Result<Grid, ImportError> {
    let refused = |found: &str, expected: &str| {
        ImportError::found(Place::file(decisions.file()), found, expected)
    };
    let is_swapped = bytes.get(126..HEADER) == Some(b"MI");
    let plain = unpacked(bytes, is_swapped).map_err(|(at, what)| {
        refused(&format!("at byte {at} an element that {what}"), "a file that MATLAB opens")
    })?;
    if limits::UNPACKED < plain.len() {
        return Err(refused("more than it may unpack to", &format!("{} bytes", limits::UNPACKED)));
    }
    let mut found = Found::default();
    for (kind, body) in (Elements { rest: &plain, is_swapped }) {
        if kind == MATRIX {
            walk(Elements { rest: body, is_swapped }, "", 0, &mut found);
        }
    }
    if found.arrays.is_empty() {
        return Err(refused("no array of numbers", "arrays that are columns"));
    }
    decisions.pass_over(&found.passed_over);
    arrays::grid("arrays", &found.arrays, decisions)
}

/// What a file holds.
#[derive(Default)]
struct Found {
    arrays: Vec<Array>,
    /// Names of arrays of complex numbers and of sparse ones, which are no columns.
    passed_over: Vec<(String, String)>,
}

/// The elements behind the header, those that are packed unpacked, until they are too many.
///
/// Otherwise where one is longer than the file, or cannot be unpacked.
fn unpacked(bytes: &[u8], is_swapped: bool) -> Result<Vec<u8>, (usize, &'static str)> {
    let (mut plain, mut rest) = (Vec::new(), bytes.get(HEADER..).unwrap_or_default());
    while let Some((tag, behind)) = rest.split_at_checked(TAG) {
        let [kind, size] = [0, 4].map(|at| word(&tag[at..], is_swapped));
        let at = bytes.len() - rest.len();
        let element = behind.get(..size as usize).ok_or((at, "reaches beyond the file"))?;
        if kind == PACKED {
            let left = (limits::UNPACKED + 1).saturating_sub(plain.len()) as u64;
            let unpacked = ZlibDecoder::new(element).take(left).read_to_end(&mut plain);
            unpacked.map_err(|_| (at, "cannot be unpacked"))?;
        } else {
            plain.extend_from_slice(&rest[..TAG + element.len()]);
        }
        rest = &behind[element.len()..];
    }
    Ok(plain)
}

/// A number of four bytes.
fn word(bytes: &[u8], is_swapped: bool) -> u32 {
    let word = bytes.iter().take(4).fold(0, |word, byte| word << 8 | u32::from(*byte));
    if is_swapped { word } else { word.swap_bytes() }
}

/// Elements one behind the other, each with its type and what it holds.
struct Elements<'a> {
    rest: &'a [u8],
    is_swapped: bool,
}

impl<'a> Iterator for Elements<'a> {
    type Item = (u32, &'a [u8]);

    fn next(&mut self) -> Option<Self::Item> {
        let (tag, behind) = self.rest.split_at_checked(TAG)?;
        let first = word(tag, self.is_swapped);
        let short = (first >> 16) as usize;
        if short != 0 {
            // Up to four bytes stand in the tag itself.
            self.rest = behind;
            return Some((first & 0xFFFF, tag.get(4..4 + short)?));
        }
        let size = word(&tag[4..], self.is_swapped) as usize;
        let body = behind.get(..size)?;
        self.rest = behind.get(size.next_multiple_of(8)..).unwrap_or_default();
        Some((first, body))
    }
}

/// The arrays of numbers in an element; `path` is where it stands, for its own name is then empty.
///
/// Complex numbers, more than two dimensions, and what contradicts itself are passed over.
fn walk(mut parts: Elements<'_>, path: &str, depth: usize, found: &mut Found) -> Option<()> {
    let is_swapped = parts.is_swapped;
    let flags = word(parts.next()?.1, is_swapped);
    let shape: Vec<usize> =
        parts.next()?.1.chunks_exact(4).map(|length| word(length, is_swapped) as usize).collect();
    let name = format!("{path}{}", String::from_utf8_lossy(parts.next()?.1));
    match flags & 0xFF {
        CELLS | STRUCTURE if depth == DEPTH => None,
        CELLS => {
            for (index, (_, cell)) in parts.enumerate() {
                let path = format!("{name} {}", index + 1);
                walk(Elements { rest: cell, is_swapped }, &path, depth + 1, found);
            }
            Some(())
        }
        STRUCTURE => {
            let longest = word(parts.next()?.1, is_swapped) as usize;
            let names: Vec<String> =
                parts.next()?.1.chunks_exact(longest.max(1)).map(text).collect();
            let several = 1 < shape.iter().product::<usize>();
            for (index, (_, field)) in parts.enumerate() {
                let number = index.checked_div(names.len())? + 1;
                let number = if several { format!(" {number}") } else { String::new() };
                let path = format!("{name}{number}/{}", names[index % names.len()]);
                walk(Elements { rest: field, is_swapped }, &path, depth + 1, found);
            }
            Some(())
        }
        class if NUMBERS.contains(&class) && flags & COMPLEX == 0 => {
            let (kind, body) = parts.next()?;
            let (rows, columns) = arrays::upright(&shape)?;
            let values = numbers(kind, body, is_swapped)?;
            let whole = !values.is_empty() && values.len() == rows.checked_mul(columns)?;
            whole.then(|| found.arrays.push(Array { name, unit: None, rows, values }))
        }
        class if class == SPARSE || NUMBERS.contains(&class) => {
            let what = if class == SPARSE { "sparse numbers" } else { "complex numbers" };
            found.passed_over.push((name, what.to_owned()));
            None
        }
        _ => None,
    }
}

/// A name of a field, which ends at its first zero.
fn text(bytes: &[u8]) -> String {
    let end = bytes.iter().position(|byte| *byte == 0).unwrap_or(bytes.len());
    String::from_utf8_lossy(&bytes[..end]).into_owned()
}

/// The numbers of an element; MATLAB stores them as small as they go.
fn numbers(kind: u32, body: &[u8], is_swapped: bool) -> Option<Vec<f64>> {
    let (size, number): (usize, fn(u64) -> f64) = match kind {
        1 => (1, |bits| signed(bits, 8)),
        2 => (1, unsigned),
        3 => (2, |bits| signed(bits, 16)),
        4 => (2, unsigned),
        5 => (4, |bits| signed(bits, 32)),
        6 => (4, unsigned),
        7 => (4, |bits| f64::from(f32::from_bits((bits & 0xFFFF_FFFF) as u32))),
        9 => (8, f64::from_bits),
        12 => (8, |bits| signed(bits, 64)),
        13 => (8, unsigned),
        _ => return None,
    };
    let bits = |bytes: &[u8]| {
        let join = |bits: u64, byte: &u8| bits << 8 | u64::from(*byte);
        if is_swapped { bytes.iter().fold(0, join) } else { bytes.iter().rev().fold(0, join) }
    };
    Some(body.chunks_exact(size).map(|bytes| number(bits(bytes))).collect())
}

#[expect(
    clippy::cast_precision_loss,
    reason = "counters of 64 bits are read as MATLAB's double does"
)]
fn signed(bits: u64, width: u32) -> f64 {
    ((bits << (64 - width)).cast_signed() >> (64 - width)) as f64
}

#[expect(clippy::cast_precision_loss, reason = "as above")]
fn unsigned(bits: u64) -> f64 {
    bits as f64
}
