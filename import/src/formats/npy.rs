//! `NumPy` arrays: one or two dimensions of numbers, or records with names.
//!
//! Format: `NumPy` Enhancement Proposal 1, versions 1.0 to 3.0. The header is one Python literal of three keys,
//! and is read as that; the crates for it bring a parser generator into every build.

use crate::error::{ImportError, quoted};
use crate::grid::Grid;
use crate::limits;
use crate::place::Place;

/// A number in an array.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Kind {
    letter: u8,
    size: usize,
    big_endian: bool,
}

/// What the header says.
struct Header {
    names: Vec<String>,
    kinds: Vec<Kind>,
    rows: usize,
    columns: usize,
    /// Column by column instead of row by row.
    fortran: bool,
}

/// Reads an array as a grid; records have a row of names.
pub(crate) fn grid(file: &str, bytes: &[u8]) -> Result<Grid, ImportError> {
    let columns = columns(file, bytes)?;
    let mut grid = Grid::of_sheet(file, "array");
    if columns.iter().any(|(name, _)| !name.is_empty()) {
        grid.start_row(0, false);
        for (index, (name, _)) in columns.iter().enumerate() {
            grid.push(name, index + 1)?;
        }
    }
    for row in 0..columns.first().map_or(0, |(_, values)| values.len()) {
        grid.start_row(row + 1, false);
        for (index, (_, values)) in columns.iter().enumerate() {
            let value = values[row];
            let cell = if value.is_nan() { String::new() } else { value.to_string() };
            grid.push(&cell, index + 1)?;
        }
    }
    Ok(grid)
}

/// The columns of an array, those of records with their names; what is not finite is NaN.
pub(super) fn columns(file: &str, bytes: &[u8]) -> Result<Vec<(String, Vec<f64>)>, ImportError> {
    let (text, data) = parted(bytes).ok_or_else(|| {
        let found = format!("the end of the file at byte {}", bytes.len());
        refused(file, &found, "a header of NumPy")
    })?;
    let header = Header::read(file, &text)?;
    let row_size = header.kinds.iter().map(|kind| kind.size).sum::<usize>();
    let cells = header
        .rows
        .checked_mul(header.columns)
        .and_then(|cells| cells.checked_mul(header.kinds.len()));
    if cells.is_none_or(|cells| limits::CELLS < cells) {
        return Err(refused(file, "more cells", &format!("up to {}", limits::CELLS)));
    }
    let size = header.rows * header.columns * row_size;
    if data.len() != size {
        return Err(refused(
            file,
            &format!("{} bytes behind byte {}", data.len(), bytes.len() - data.len()),
            &format!("{size} as the header says"),
        ));
    }
    Ok(header.columns(data, row_size))
}

/// The header's text, and the data behind it.
fn parted(bytes: &[u8]) -> Option<(String, &[u8])> {
    let (start, length): (usize, usize) = if 1 < *bytes.get(6)? {
        (12, usize::try_from(u32::from_le_bytes(bytes.get(8..12)?.try_into().ok()?)).ok()?)
    } else {
        (10, usize::from(u16::from_le_bytes(bytes.get(8..10)?.try_into().ok()?)))
    };
    let end = start.checked_add(length)?;
    let text = String::from_utf8_lossy(bytes.get(start..end)?).into_owned();
    Some((text, &bytes[end..]))
}

fn refused(file: &str, found: &str, expected: &str) -> ImportError {
    ImportError::found(Place::file(file), found, expected)
}

impl Header {
    fn read(file: &str, text: &str) -> Result<Self, ImportError> {
        let value = |key: &str| text.split(&format!("'{key}':")).nth(1).map(str::trim_start);
        let descr = value("descr").unwrap_or_default();
        let fortran = value("fortran_order").is_some_and(|text| text.starts_with("True"));
        let dimensions = shape(value("shape").unwrap_or_default());
        let Some((names, kinds)) = fields(descr) else {
            let found =
                format!("the type {}", quoted(descr.split(", 'f").next().unwrap_or_default()));
            return Err(refused(file, &found, "numbers, or records of numbers"));
        };
        let (rows, columns) = match dimensions.as_deref() {
            Some([rows]) => (*rows, 1),
            Some([rows, columns]) if names.is_empty() => (*rows, *columns),
            Some(other) => {
                return Err(refused(file, &format!("{} dimensions", other.len()), "one or two"));
            }
            None => return Err(refused(file, "no `shape`", "one or two dimensions")),
        };
        Ok(Self { names, kinds, rows, columns, fortran })
    }

    /// The numbers of each column, and in each column of each field.
    fn columns(&self, data: &[u8], row_size: usize) -> Vec<(String, Vec<f64>)> {
        let mut columns = Vec::new();
        for column in 0..self.columns {
            let mut offset = 0;
            for (field, kind) in self.kinds.iter().enumerate() {
                let number = |row: usize| {
                    let index = if self.fortran {
                        column * self.rows + row
                    } else {
                        row * self.columns + column
                    };
                    let at = index * row_size + offset;
                    kind.read(&data[at..at + kind.size]).unwrap_or(f64::NAN)
                };
                let name = self.names.get(field).cloned().unwrap_or_default();
                columns.push((name, (0..self.rows).map(number).collect()));
                offset += kind.size;
            }
        }
        columns
    }
}

fn shape(text: &str) -> Option<Vec<usize>> {
    let inside = text.strip_prefix('(')?.split(')').next()?;
    inside
        .split(',')
        .map(str::trim)
        .filter(|word| !word.is_empty())
        .map(|word| word.parse().ok())
        .collect()
}

/// Names and kinds: `'<f8'`, or `[('time', '<f8'), ('pos', '<f4')]`.
fn fields(descr: &str) -> Option<(Vec<String>, Vec<Kind>)> {
    if descr.starts_with('\'') {
        let kind = Kind::of(descr.split('\'').nth(1)?)?;
        return Some((Vec::new(), vec![kind]));
    }
    let inside = descr.strip_prefix('[')?.split(']').next()?;
    let (mut names, mut kinds) = (Vec::new(), Vec::new());
    for record in inside.split('(').skip(1) {
        let mut words = record.split('\'').skip(1).step_by(2);
        names.push(words.next()?.to_owned());
        kinds.push(Kind::of(words.next()?)?);
    }
    (!names.is_empty()).then_some((names, kinds))
}

impl Kind {
    fn of(text: &str) -> Option<Self> {
        let (order, rest) = match text.as_bytes() {
            [order @ (b'<' | b'>' | b'|' | b'='), rest @ ..] => (*order, rest),
            rest => (b'<', rest),
        };
        let (&letter, digits) = rest.split_first()?;
        let size = std::str::from_utf8(digits).ok()?.parse().ok()?;
        let known =
            matches!((letter, size), (b'f', 4 | 8) | (b'i' | b'u', 1 | 2 | 4 | 8) | (b'b', 1));
        known.then_some(Self { letter, size, big_endian: order == b'>' })
    }

    /// The number; `None` when it is not finite.
    #[expect(
        clippy::cast_precision_loss,
        reason = "counters of 64 bits are read as NumPy's float does"
    )]
    fn read(self, bytes: &[u8]) -> Option<f64> {
        let mut word = [0_u8; 8];
        for (index, byte) in bytes.iter().enumerate() {
            let place = if self.big_endian { self.size - 1 - index } else { index };
            word[place] = *byte;
        }
        let whole = u64::from_le_bytes(word);
        let value = match (self.letter, self.size) {
            (b'f', 4) => {
                f64::from(f32::from_bits(u32::from_le_bytes([word[0], word[1], word[2], word[3]])))
            }
            (b'f', _) => f64::from_bits(whole),
            (b'i', size) => ((whole << (64 - 8 * size)).cast_signed() >> (64 - 8 * size)) as f64,
            _ => whole as f64,
        };
        value.is_finite().then_some(value)
    }
}
