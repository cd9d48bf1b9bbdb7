//! Cells in rows, as text, each with its place in the file.

use std::borrow::Cow;

use crate::error::ImportError;
use crate::limits;
use crate::place::Place;

/// What stands between two cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Delimiter {
    Char(char),
    Blanks,
}

impl Delimiter {
    /// The delimiter of a recipe's word.
    pub(crate) fn named(name: &str) -> Option<Self> {
        match name {
            "tab" => Some(Self::Char('\t')),
            "blanks" => Some(Self::Blanks),
            _ => {
                let mut chars = name.chars();
                chars.next().filter(|_| chars.next().is_none()).map(Self::Char)
            }
        }
    }

    /// The word for a recipe.
    pub(crate) fn name(self) -> String {
        match self {
            Self::Char('\t') => "tab".into(),
            Self::Char(c) => c.into(),
            Self::Blanks => "blanks".into(),
        }
    }
}

/// Where cells come from.
#[derive(Clone, Debug)]
enum Origin {
    Text,
    Sheet(String),
}

/// A column of a format that has columns.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Cells<'a> {
    Numbers(&'a [f64]),
    Words(&'a [String]),
}

impl Cells<'_> {
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::Numbers(values) => values.len(),
            Self::Words(words) => words.len(),
        }
    }

    /// The text of a cell, empty where none is.
    fn text(&self, row: usize) -> Cow<'_, str> {
        match self {
            Self::Numbers(values) if values[row].is_nan() => Cow::Borrowed(""),
            Self::Numbers(values) => Cow::Owned(values[row].to_string()),
            Self::Words(words) => Cow::Borrowed(words[row].trim()),
        }
    }
}

/// A row of cells.
#[derive(Clone, Copy, Debug)]
struct Row {
    first_cell: usize,
    line: usize,
    comment: bool,
}

/// Rows of cells of different lengths.
#[derive(Clone, Debug)]
pub(crate) struct Grid {
    file: String,
    origin: Origin,
    text: String,
    /// Where a cell begins and ends in `text`, and its column in the line or the sheet.
    cells: Vec<(usize, usize, usize)>,
    rows: Vec<Row>,
}

impl Grid {
    /// An empty grid of a text.
    pub(crate) fn of_text(file: &str) -> Self {
        let (text, cells, rows) = (String::new(), Vec::new(), Vec::new());
        Self { file: file.to_owned(), origin: Origin::Text, text, cells, rows }
    }

    /// An empty grid of a sheet.
    pub(crate) fn of_sheet(file: &str, sheet: &str) -> Self {
        Self { origin: Origin::Sheet(sheet.to_owned()), ..Self::of_text(file) }
    }

    /// Columns below a row of their names; what is no number is an empty cell, infinity a word.
    pub(crate) fn of_columns(
        file: &str,
        sheet: &str,
        columns: &[(&str, Cells<'_>)],
    ) -> Result<Self, ImportError> {
        let mut grid = Self::of_sheet(file, sheet);
        grid.start_row(0, false);
        for (index, (name, _)) in columns.iter().enumerate() {
            grid.push(name, index + 1)?;
        }
        let rows = columns.first().map_or(0, |(_, cells)| cells.len());
        for row in 0..rows {
            grid.start_row(row + 1, false);
            for (index, (_, cells)) in columns.iter().enumerate() {
                grid.push(&cells.text(row), index + 1)?;
            }
        }
        Ok(grid)
    }

    /// Splits lines into cells.
    pub(crate) fn split(
        file: &str,
        lines: &[&str],
        delimiter: Delimiter,
    ) -> Result<Self, ImportError> {
        let mut grid = Self::of_text(file);
        for (index, line) in lines.iter().enumerate() {
            let bare = line.trim_start_matches(['#', '%']);
            let comment = bare.len() < line.len();
            grid.start_row(index + 1, comment);
            let skipped = line.chars().count() - bare.chars().count();
            grid.split_line(bare, delimiter, skipped)?;
        }
        Ok(grid)
    }

    /// Begins a row.
    pub(crate) fn start_row(&mut self, line: usize, comment: bool) {
        self.rows.push(Row { first_cell: self.cells.len(), line, comment });
    }

    /// Adds a cell to the last row; `column` counts from 1.
    pub(crate) fn push(&mut self, cell: &str, column: usize) -> Result<(), ImportError> {
        if self.cells.len() == limits::CELLS {
            let place = Place::file(&self.file);
            let expected = format!("up to {}", limits::CELLS);
            return Err(ImportError::found(place, "more cells", expected));
        }
        if limits::CELL < cell.len() {
            let place = Place::file(&self.file);
            let found = format!("a cell of {} bytes", cell.len());
            return Err(ImportError::found(place, found, format!("up to {}", limits::CELL)));
        }
        let start = self.text.len();
        self.text.push_str(cell);
        self.cells.push((start, self.text.len(), column));
        Ok(())
    }

    fn split_line(
        &mut self,
        line: &str,
        delimiter: Delimiter,
        skipped: usize,
    ) -> Result<(), ImportError> {
        match delimiter {
            Delimiter::Blanks => self.split_blanks(line, skipped),
            Delimiter::Char(mark) => self.split_quoted(line, mark, skipped),
        }
    }

    /// A line of words is parted where two blanks stand, if they do; a unit stays with its name.
    fn split_blanks(&mut self, line: &str, skipped: usize) -> Result<(), ImportError> {
        let body = line.trim();
        let words = body.starts_with(char::is_alphabetic);
        let wide = words && (body.contains("  ") || body.contains('\t'));
        let mut begun: Option<usize> = None;
        for (at, c) in line.char_indices().chain([(line.len(), '\t')]) {
            let blank = c == ' ' || c == '\t';
            let rest = line[at..].trim_start();
            let ends = blank && (c == '\t' || !wide || line[at..].starts_with("  "));
            let unit = words && (rest.starts_with('[') || rest.starts_with('('));
            match begun {
                None if !blank => begun = Some(at),
                Some(start) if ends && !(unit && at < line.len()) => {
                    let column = skipped + 1 + line[..start].chars().count();
                    self.push(line[start..at].trim(), column)?;
                    begun = None;
                }
                _ => {}
            }
        }
        Ok(())
    }

    fn split_quoted(&mut self, line: &str, mark: char, skipped: usize) -> Result<(), ImportError> {
        if line.trim().is_empty() {
            return Ok(());
        }
        let mut cell = String::new();
        let (mut quoted, mut begun) = (None, skipped + 1);
        let mut chars = line.chars().enumerate().peekable();
        while let Some((at, c)) = chars.next() {
            match c {
                '"' if quoted.is_some() && chars.peek().is_some_and(|(_, next)| *next == '"') => {
                    cell.push('"');
                    chars.next();
                }
                '"' if quoted.is_some() => quoted = None,
                '"' if cell.trim().is_empty() => {
                    cell.clear();
                    quoted = Some(skipped + at + 1);
                }
                c if c == mark && quoted.is_none() => {
                    self.push(cell.trim(), begun)?;
                    cell.clear();
                    begun = skipped + at + 2;
                }
                c => cell.push(c),
            }
        }
        if let Some(column) = quoted {
            let mut place = self.place(self.rows.len() - 1, None);
            place.at.column = Some(column);
            return Err(ImportError::found(
                place,
                "the end of the line inside quotes",
                "a closing quote",
            ));
        }
        self.push(cell.trim(), begun)
    }

    /// This grid with other texts in some of its cells, which stay where they are.
    pub(crate) fn replaced(&self, new: impl Fn(usize, &str) -> Option<String>) -> Self {
        let mut grid = self.clone();
        for row in 0..self.rows() {
            for cell in self.range(row) {
                let Some(text) = new(row, self.cell_text(cell)) else { continue };
                let start = grid.text.len();
                grid.text.push_str(&text);
                (grid.cells[cell].0, grid.cells[cell].1) = (start, grid.text.len());
            }
        }
        grid
    }

    /// True for a sheet, where notes may stand beside a table.
    pub(crate) fn is_sheet(&self) -> bool {
        matches!(self.origin, Origin::Sheet(_))
    }

    /// Number of rows.
    pub(crate) fn rows(&self) -> usize {
        self.rows.len()
    }

    /// Number of cells of a row.
    pub(crate) fn width(&self, row: usize) -> usize {
        self.range(row).len()
    }

    /// True for a line behind a comment mark.
    pub(crate) fn is_comment(&self, row: usize) -> bool {
        self.rows[row].comment
    }

    /// True when a row holds nothing.
    pub(crate) fn is_blank(&self, row: usize) -> bool {
        self.cells_of(row).all(str::is_empty)
    }

    /// A cell; empty when the row is shorter.
    pub(crate) fn cell(&self, row: usize, column: usize) -> &str {
        let range = self.range(row);
        if range.len() <= column { "" } else { self.cell_text(range.start + column) }
    }

    /// Cells of a row.
    pub(crate) fn cells_of(&self, row: usize) -> impl Iterator<Item = &str> {
        self.range(row).map(|cell| self.cell_text(cell))
    }

    /// Cells of a row without the empty ones at its end.
    pub(crate) fn used_width(&self, row: usize) -> usize {
        let range = self.range(row);
        let last = range.clone().rev().find(|cell| !self.cell_text(*cell).is_empty());
        last.map_or(0, |last| last + 1 - range.start)
    }

    /// Where a row, or a cell of it, stands.
    pub(crate) fn place(&self, row: usize, column: Option<usize>) -> Place {
        let line = self.rows.get(row).map_or(0, |row| row.line);
        if line == 0 {
            // Names that no line of the file holds.
            return Place::file(&self.file);
        }
        let mut place = Place::line(&self.file, line);
        let range = self.range(row);
        place.at.column = column.map(|column| {
            let cell = self.cells.get(range.start + column).filter(|_| column < range.len());
            cell.or(self.cells.get(range.end.wrapping_sub(1))).map_or(1, |cell| cell.2)
        });
        if let Origin::Sheet(sheet) = &self.origin {
            place.sheet = Some(sheet.clone());
        }
        place
    }

    fn cell_text(&self, cell: usize) -> &str {
        let (start, end, _) = self.cells[cell];
        &self.text[start..end]
    }

    fn range(&self, row: usize) -> std::ops::Range<usize> {
        let start = self.rows.get(row).map_or(self.cells.len(), |row| row.first_cell);
        let end = self.rows.get(row + 1).map_or(self.cells.len(), |row| row.first_cell);
        start..end
    }
}
