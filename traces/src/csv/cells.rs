//! The cells of one column: numbers, instants, or words.

use super::place::Line;
use super::stamp;
use crate::error::TraceError;
use crate::number::{LARGEST, in_range};
use crate::table::{Column, TextColumn, shortened};

pub(super) const CUT_OFF: &str = "\n\nhint: the file ends here, it may have been cut off";
pub(super) const DECIMAL_COMMA: &str = "\n\nhint: write the decimal sign as a point";

const UNITS: &str = "\n\nhint: write units into the names, such as `error [um]`";

/// A column while it is read; what it holds is only known at its end.
pub(super) struct Reading {
    column: Column,
    /// Its cells are instants of a clock.
    stamped: bool,
    /// Cells that are numbers or instants.
    numbers: usize,
    /// Cells that are words.
    words: usize,
    /// The first word, with its place.
    first: Option<TextColumn>,
}

impl Reading {
    pub(super) fn new(name: String) -> Self {
        let column = Column { name, values: Vec::new() };
        Self { column, stamped: false, numbers: 0, words: 0, first: None }
    }

    /// Takes the next cell; words count as missing until the column's end.
    pub(super) fn push(
        &mut self,
        cell: &[u8],
        line: &Line,
        index: usize,
    ) -> Result<(), TraceError> {
        let value = if let Some(value) = self.value(cell) {
            self.numbers += usize::from(!value.is_nan());
            value
        } else {
            self.keep_word(cell, line, index)?;
            f64::NAN
        };
        self.column.values.push(value);
        Ok(())
    }

    /// The cell as a number; its first one decides whether the column holds numbers or instants.
    fn value(&mut self, cell: &[u8]) -> Option<f64> {
        let plain = number(cell);
        if plain.is_some_and(|value| !self.stamped || value.is_nan()) {
            return plain;
        }
        if plain.is_some() || !(self.stamped || self.numbers == 0) {
            return None;
        }
        let instant = stamp::seconds(cell)?;
        self.stamped = true;
        Some(instant)
    }

    /// Counts a word; refuses what was meant to be a number.
    fn keep_word(&mut self, cell: &[u8], line: &Line, index: usize) -> Result<(), TraceError> {
        let found = String::from_utf8_lossy(cell.trim_ascii());
        let hint = hint(&found, line);
        if !hint.is_empty() || !is_word(&found) {
            let (at, name) = (line.at(index), self.column.name.clone());
            return Err(TraceError::Cell { at, name, found: shortened(&found), hint });
        }
        self.words += 1;
        if self.first.is_none() {
            let (at, name) = (line.at(index), self.column.name.clone());
            self.first = Some(TextColumn { name, first: shortened(&found), at, hint: "" });
        }
        Ok(())
    }
}

/// Columns of numbers and columns of words.
///
/// A word among numbers is a mistake, and so is a file of nothing but words.
pub(super) fn told_apart(
    columns: Vec<Reading>,
) -> Result<(Vec<Column>, Vec<TextColumn>), TraceError> {
    // A line of nothing but words below the header is one of units.
    let first_is_word = |one: &Reading| one.column.values.first().is_some_and(|v| v.is_nan());
    let units = columns.iter().all(|one| one.words == 1 && first_is_word(one));
    let only_words = columns.iter().all(|column| column.numbers == 0 && 0 < column.words);
    let (mut numeric, mut text) = (Vec::new(), Vec::new());
    let mut refused: Vec<TextColumn> = Vec::new();
    for Reading { mut column, stamped, numbers, words, first } in columns {
        match first {
            None => {
                if stamped {
                    column.name = stamp::column_name(&column.name);
                }
                numeric.push(column);
            }
            Some(first) if only_words || words <= numbers => refused.push(first),
            Some(first) => text.push(first),
        }
    }
    match refused.into_iter().min_by_key(|one| (one.at.line, one.at.column)) {
        Some(first) if units => Err(TextColumn { hint: UNITS, ..first }.refused()),
        Some(first) => Err(first.refused()),
        None => Ok((numeric, text)),
    }
}

/// The cell as a number, NaN when it is empty; `None` when it is anything but finite and in range.
fn number(cell: &[u8]) -> Option<f64> {
    let bare = cell.trim_ascii();
    if bare.len() < cell.len() && cell.contains(&b'\n') {
        return None; // a quote was not closed on its line
    }
    if bare.is_empty() {
        return Some(f64::NAN);
    }
    let value: f64 = std::str::from_utf8(bare).ok()?.parse().ok()?;
    in_range(value).then_some(value)
}

/// Text that begins with a letter: what begins with a digit or a sign was meant to be a number.
fn is_word(found: &str) -> bool {
    found.chars().next().is_some_and(char::is_alphabetic) && !found.contains(char::is_control)
}

/// Numbers with blanks between them; a blank that no line breaks at groups the digits of one.
fn is_row(text: &str) -> bool {
    let mut words = text.split_ascii_whitespace();
    1 < words.clone().count() && words.all(|word| word.parse::<f64>().is_ok())
}

/// A number with its thousands in groups: `1 234.5`, `1'234.5`.
fn is_grouped(text: &str) -> bool {
    const MARKS: [char; 4] = ['\u{a0}', '\u{202f}', '\'', '\u{2019}'];
    text.contains(MARKS) && text.replace(MARKS, "").replacen(',', ".", 1).parse::<f64>().is_ok()
}

/// A number in parentheses, as accountants write a negative one.
fn is_in_parentheses(text: &str) -> bool {
    let inside = text.strip_prefix('(').and_then(|text| text.strip_suffix(')'));
    inside.is_some_and(|inside| inside.trim().replacen(',', ".", 1).parse::<f64>().is_ok())
}

/// A number beyond the largest that is taken.
fn is_too_large(text: &str) -> bool {
    text.parse::<f64>().is_ok_and(|value| LARGEST < value.abs())
}

/// Why a cell is likely no number; empty when there is nothing to say.
fn hint(found: &str, line: &Line) -> &'static str {
    if line.last && found.ends_with(['-', '+', 'e', 'E', '.']) && !is_word(found) {
        return CUT_OFF;
    }
    let word = found.trim_start_matches(['+', '-']).to_ascii_lowercase();
    let decimal_comma = found.contains(',') && found.replacen(',', ".", 1).parse::<f64>().is_ok();
    if is_row(found) {
        "\n\nhint: put commas between cells"
    } else if is_grouped(found) {
        "\n\nhint: write thousands without a mark between them"
    } else if is_in_parentheses(found) {
        "\n\nhint: write minus as `-`, and leave the cell empty where a value does not count"
    } else if decimal_comma {
        DECIMAL_COMMA
    } else if matches!(word.as_str(), "nan" | "na" | "n/a" | "null" | "none" | "-" | "") {
        "\n\nhint: leave the cell empty where a value is missing"
    } else if found.starts_with('\u{2212}') {
        "\n\nhint: write minus as `-`"
    } else if matches!(word.as_str(), "inf" | "infinity") || is_too_large(found) {
        "\n\nhint: only finite numbers up to 1e30 can be used"
    } else {
        ""
    }
}
