//! A place in a file, as messages tell it.

use std::fmt;

use helixlock_traces::At;

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
