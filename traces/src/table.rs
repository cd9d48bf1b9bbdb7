//! Named columns of numbers, and the place of every row in its file.

use std::path::PathBuf;

use crate::error::{At, TraceError};

/// Most columns of a table; an instrument has some twenty.
pub(crate) const MOST_COLUMNS: usize = 4096;
/// Longest name of a column, bytes: it is compared, sorted and quoted at every turn.
pub(crate) const LONGEST_NAME: usize = 1000;
/// Most cells of a table: 400 MB of numbers.
pub(crate) const MOST_CELLS: usize = 50_000_000;

/// One column: its name, with the unit in it, and a number a row.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Name as in the header, such as `position_mm`.
    pub name: String,
    /// One value a row; a missing cell is NaN and keeps its place.
    pub values: Vec<f64>,
}

impl Column {
    /// A column made in memory.
    pub fn new(name: impl Into<String>, values: Vec<f64>) -> Self {
        Self { name: name.into(), values }
    }
}

/// A column that was left out because it holds words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextColumn {
    /// Name as in the header.
    pub name: String,
    /// Its first word.
    pub first: String,
    /// Where that stands.
    pub at: At,
    /// What the likely reason is; empty, or a line of its own.
    pub(crate) hint: &'static str,
}

impl TextColumn {
    /// The refusal of this column, for who needs numbers of it.
    #[must_use]
    pub fn refused(&self) -> TraceError {
        let Self { name, first, at, hint } = self.clone();
        TraceError::Cell { at, name, found: first, hint }
    }
}

/// Columns of equal length, in the order of the file.
#[derive(Clone, Debug, Default)]
pub struct Table {
    /// The file they came from; empty for a table made in memory.
    pub path: PathBuf,
    /// The columns.
    pub columns: Vec<Column>,
    /// Columns of words, which are not among `columns`.
    pub text: Vec<TextColumn>,
    /// `(row, line)` where the numbering of lines jumps; empty for formats without lines.
    pub(crate) line_jumps: Vec<(usize, usize)>,
}

impl Table {
    /// A table made in memory; columns are of equal length.
    #[must_use]
    pub fn new(columns: Vec<Column>) -> Self {
        debug_assert!(columns.windows(2).all(|pair| pair[0].values.len() == pair[1].values.len()));
        Self { columns, ..Self::default() }
    }

    /// Number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, |column| column.values.len())
    }

    /// Names of the columns, in the order of the file.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.columns.iter().map(|column| column.name.as_str())
    }

    /// Names of all columns as a message lists them, behind the others those that hold words.
    #[must_use]
    pub fn listed(&self) -> String {
        let words = self.text.iter().map(|text| text.name.as_str());
        self.names().chain(words).map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
    }

    /// Values of one column, NaN where a cell is missing; `None` when there is no such column.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        let column = self.columns.iter().find(|column| column.name == name)?;
        Some(&column.values)
    }

    /// Values of a column that has to be there.
    ///
    /// # Errors
    ///
    /// [`TraceError::NoColumn`] names the columns there are; [`TraceError::Cell`] when the column
    /// holds words.
    pub fn require(&self, name: &str) -> Result<&[f64], TraceError> {
        let missing = || match self.text.iter().find(|text| text.name == name) {
            Some(text) => text.refused(),
            None => TraceError::NoColumn {
                path: self.path.clone(),
                name: name.to_owned(),
                found: self.listed(),
            },
        };
        self.column(name).ok_or_else(missing)
    }

    /// Where a row (from 0) stands in its file; no line for formats that have none.
    #[must_use]
    pub fn at(&self, row: usize) -> At {
        let at = At::file(&self.path);
        let jump = self.line_jumps.partition_point(|(first, _)| *first <= row).checked_sub(1);
        match jump.and_then(|jump| self.line_jumps.get(jump)) {
            Some((first, line)) => at.on_line(line + (row - first)),
            None => at,
        }
    }
}

/// At most forty characters, so that a message stays a line.
pub(crate) fn shortened(text: &str) -> String {
    const LONGEST: usize = 40;
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::csv;

    fn read(text: &str) -> Table {
        csv::read_csv(text.as_bytes(), Path::new("data.csv")).unwrap()
    }

    #[test]
    fn rows_know_their_lines_through_comments_and_blank_lines() {
        let table = read("# made by hand\nposition_mm\n1\n\n# pause\n2\n3\n");
        assert_eq!(table.column("position_mm"), Some(&[1.0, 2.0, 3.0][..]));
        let lines: Vec<_> = (0..3).map(|row| table.at(row).line).collect();
        assert_eq!(lines, [Some(3), Some(6), Some(7)]);
    }

    #[test]
    fn a_missing_column_names_those_there_are() {
        let error = read("position_mm,error_um\n1,2\n").require("time_s").unwrap_err();
        assert_eq!(
            error.to_string(),
            "data.csv: column `time_s` is missing, found `position_mm`, `error_um`"
        );
    }
}
