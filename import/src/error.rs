//! What was wrong with a file or a recipe, and where.

use std::fmt;

use helixlock_traces::At;

use crate::question::Question;

/// A place in a file of text, or a cell of a sheet.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// File, line and column; for a sheet, row and column of the cell.
    pub at: At,
    /// Sheet of a workbook.
    pub sheet: Option<String>,
}

impl Place {
    /// The file as a whole.
    #[must_use]
    pub fn file(name: &str) -> Self {
        Self { at: At::file(name), sheet: None }
    }

    /// A line of text, from 1.
    #[must_use]
    pub fn line(name: &str, line: usize) -> Self {
        Self { at: At::file(name).on_line(line), sheet: None }
    }

    /// A part of a line of text, by where it lies in memory; the line alone for any other text.
    pub(crate) fn word(name: &str, line: usize, text: &str, word: &str) -> Self {
        let mut place = Self::line(name, line);
        let byte = word.as_ptr().addr().checked_sub(text.as_ptr().addr());
        let before = byte.and_then(|byte| text.get(..byte));
        place.at.column = before.map(|before| 1 + before.chars().count());
        place
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(sheet) = &self.sheet else { return self.at.fmt(f) };
        write!(f, "{}: sheet `{sheet}`", self.at.path.display())?;
        match (self.at.line, self.at.column) {
            (Some(row), Some(column)) => write!(f, ", cell {}{row}", letters(column)),
            (Some(row), None) => write!(f, ", row {row}"),
            _ => Ok(()),
        }
    }
}

/// Name of a column of a sheet: A, B … Z, AA.
fn letters(mut column: usize) -> String {
    let mut name = Vec::new();
    while 0 < column {
        column -= 1;
        name.push(b'A' + u8::try_from(column % 26).unwrap_or(0));
        column /= 26;
    }
    name.iter().rev().map(|letter| char::from(*letter)).collect()
}

/// Why a file was not imported.
#[derive(Debug, Clone, thiserror::Error)]
#[non_exhaustive]
pub enum ImportError {
    /// Something in the file or the recipe cannot be used.
    #[error("{place}: found {found}, expected {expected}{}", hint_line(hint))]
    Found {
        /// Where.
        place: Box<Place>,
        /// What stands there.
        found: String,
        /// What was expected.
        expected: String,
        /// What probably helps; empty when nothing is known.
        hint: String,
    },
    /// Something can be read in more than one way.
    #[error("{0}")]
    Unanswered(Box<Question>),
}

fn hint_line(hint: &str) -> String {
    if hint.is_empty() { String::new() } else { format!("\n\nhint: {hint}") }
}

impl ImportError {
    /// Something found in place of something expected.
    pub(crate) fn found(
        place: Place,
        found: impl Into<String>,
        expected: impl Into<String>,
    ) -> Self {
        Self::Found {
            place: Box::new(place),
            found: found.into(),
            expected: expected.into(),
            hint: String::new(),
        }
    }

    /// The same with a hint.
    pub(crate) fn hinted(self, more: impl Into<String>) -> Self {
        match self {
            Self::Found { place, found, expected, .. } => {
                Self::Found { place, found, expected, hint: more.into() }
            }
            Self::Unanswered(question) => Self::Unanswered(question),
        }
    }
}

/// A cell or line as a message shows it: at most forty characters.
pub(crate) fn quoted(text: &str) -> String {
    const LONGEST: usize = 40;
    let line: String = text.chars().take(LONGEST).flat_map(char::escape_debug).collect();
    if text.chars().nth(LONGEST).is_some() { format!("`{line}…`") } else { format!("`{line}`") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_told_by_where_they_lie() {
        let line = "µ 1 1";
        let column = |word| Place::word("a", 1, line, word).at.column;
        assert_eq!([&line[3..4], &line[5..6], line].map(column), [Some(3), Some(5), Some(1)]);
    }

    #[test]
    fn cells_of_a_sheet_have_letters() {
        assert_eq!([letters(1), letters(26), letters(27), letters(703)], ["A", "Z", "AA", "AAA"]);
    }
}
