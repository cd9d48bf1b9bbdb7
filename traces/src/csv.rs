//! Comma-separated text: a header with units in the names, `#` comments, a number a cell.
//!
//! Semicolons or tabs may stand for the commas, and a column may hold ISO 8601 instants. An empty
//! cell is a missing value. Text such as `NaN`, `inf`, `1,5` or `5 mm` is refused with its line and
//! column, because what it stands for would have to be guessed. A column of words, such as the
//! operator's name, is left out and remembered.

use std::io::{self, Write};
use std::path::Path;

use ::csv::{ByteRecord, QuoteStyle, ReaderBuilder};

use crate::error::{At, TraceError};
use crate::number::write_number;
use crate::table::{LONGEST_NAME, MOST_CELLS, MOST_COLUMNS, Table};

mod cells;
mod place;
mod stamp;

/// What may separate cells instead of the comma.
const SEPARATORS: [u8; 2] = [b';', b'\t'];

use cells::{CUT_OFF, DECIMAL_COMMA, Reading};
use place::{Line, Source};

/// Reads comma-separated text; `path` is for messages only.
///
/// A byte-order mark, CRLF, comment lines, blank lines and quoted cells are taken; the header
/// comes first, and a semicolon or tab in it separates cells instead of the comma. Cells are finite
/// decimal numbers or empty; a column of instants becomes seconds since 1970, and `time_s` when it
/// is called `timestamp` or alike.
///
/// # Errors
///
/// Everything else: no header, numbers for a header, a name twice, a decimal comma, a row too long
/// or too short, a cell that is no finite number.
pub fn read_csv(bytes: &[u8], path: &Path) -> Result<Table, TraceError> {
    let text = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    let separator = separator(text);
    let mut reader = ReaderBuilder::new()
        .delimiter(separator)
        .has_headers(false)
        .flexible(true)
        .comment(Some(b'#'))
        .buffer_capacity(1 << 20)
        .from_reader(text);
    let source = Source { text, path, separator };
    let mut record = ByteRecord::new();
    if !source.next(&mut reader, &mut record)? {
        return Err(TraceError::Empty { at: At::file(path), found: "an empty file" });
    }
    let names = header(&record, &source.line(&reader))?;
    let most_rows = MOST_CELLS / names.len();
    let mut columns: Vec<Reading> = names.into_iter().map(Reading::new).collect();
    let mut line_jumps = Vec::new();
    let (mut rows, mut next_line) = (0, 0);
    while source.next(&mut reader, &mut record)? {
        let line = source.line(&reader);
        if line.number != next_line {
            line_jumps.push((rows, line.number));
        }
        next_line = line.number + 1;
        if rows == most_rows {
            return Err(TraceError::TooMany { at: line.whole(), most: MOST_CELLS, what: "cells" });
        }
        push_row(&mut columns, &record, &line)?;
        rows += 1;
    }
    if rows == 0 {
        return Err(TraceError::Empty { at: At::file(path), found: "a header only" });
    }
    let (columns, text) = cells::told_apart(columns)?;
    let table = Table { path: path.to_owned(), columns, text, line_jumps };
    match twice(&table) {
        Some(name) => Err(TraceError::DuplicateColumn { at: At::file(path), name }),
        None => Ok(table),
    }
}

/// What separates the cells of the first line that is no comment; quoted names do not count.
fn separator(text: &[u8]) -> u8 {
    let mut lines = text.split(|byte| matches!(byte, b'\n' | b'\r'));
    let header = lines.find(|line| !line.starts_with(b"#") && !line.trim_ascii().is_empty());
    let between_quotes = header.unwrap_or_default().split(|byte| *byte == b'"').step_by(2);
    let bare: Vec<u8> = between_quotes.flatten().copied().collect();
    SEPARATORS.into_iter().find(|separator| bare.contains(separator)).unwrap_or(b',')
}

/// A name that two columns have.
fn twice(table: &Table) -> Option<String> {
    let names: Vec<&str> = table.names().collect();
    let known = |(index, name): &(usize, &&str)| names[..*index].contains(*name);
    names.iter().enumerate().find(known).map(|(_, name)| (*name).to_owned())
}

/// Writes a table as comma-separated text; numbers read back to the same bits, NaN is an empty
/// cell.
///
/// # Errors
///
/// Those of `out`.
pub fn write_csv(table: &Table, out: &mut impl Write) -> io::Result<()> {
    let names: Vec<_> = table.names().collect();
    let mut rows = RowWriter::new(out, &names)?;
    let mut cells = vec![0.0; table.columns.len()];
    for row in 0..table.rows() {
        for (cell, column) in cells.iter_mut().zip(&table.columns) {
            *cell = column.values[row];
        }
        rows.row(&cells)?;
    }
    Ok(())
}

/// Comma-separated text, written row by row.
#[derive(Debug)]
pub struct RowWriter<W: Write> {
    out: W,
}

impl<W: Write> RowWriter<W> {
    /// Begins with the header.
    ///
    /// # Errors
    ///
    /// Those of `out`.
    pub fn new(mut out: W, names: &[&str]) -> io::Result<Self> {
        let doubtful = |name: &&str| name.bytes().any(|byte| SEPARATORS.contains(&byte));
        let quotes =
            if names.iter().any(doubtful) { QuoteStyle::Always } else { QuoteStyle::Necessary };
        ::csv::WriterBuilder::new()
            .comment(Some(b'#'))
            .quote_style(quotes)
            .from_writer(&mut out)
            .write_record(names)?;
        Ok(Self { out })
    }

    /// Adds a row, one cell a column; NaN is written as an empty cell.
    ///
    /// # Errors
    ///
    /// Those of `out`.
    pub fn row(&mut self, cells: &[f64]) -> io::Result<()> {
        if let [cell] = cells
            && cell.is_nan()
        {
            return self.out.write_all(b"\"\"\n"); // an empty line would be no row
        }
        for (index, cell) in cells.iter().enumerate() {
            if index > 0 {
                self.out.write_all(b",")?;
            }
            if !cell.is_nan() {
                write_number(&mut self.out, *cell)?;
            }
        }
        self.out.write_all(b"\n")
    }
}

/// Names of the columns, from the first record.
fn header(record: &ByteRecord, line: &Line) -> Result<Vec<String>, TraceError> {
    let refuse = |cell: usize, found: String, expected: &'static str| {
        Err(TraceError::Header { at: line.at(cell), found, expected })
    };
    if MOST_COLUMNS < record.len() {
        return Err(TraceError::TooMany { at: line.whole(), most: MOST_COLUMNS, what: "columns" });
    }
    let mut names: Vec<String> = Vec::with_capacity(record.len());
    for (index, cell) in record.iter().enumerate() {
        let name = text_of(cell.trim_ascii());
        if LONGEST_NAME < name.len() {
            let (at, what) = (line.at(index), "bytes in the name of a column");
            return Err(TraceError::TooMany { at, most: LONGEST_NAME, what });
        }
        if name.contains(|c: char| c.is_control() || c == '\u{feff}') {
            return refuse(
                index,
                format!("`{}`", name.escape_debug()),
                "a name that can be printed",
            );
        }
        if name.is_empty() {
            return refuse(index, "no name".into(), "a name for every column");
        }
        if names.contains(&name) {
            return Err(TraceError::DuplicateColumn { at: line.at(index), name });
        }
        names.push(name);
    }
    match names.iter().position(|name| name.parse::<f64>().is_err()) {
        Some(_) => Ok(names),
        None => refuse(0, format!("`{}`", names[0]), "a header with names such as `position_mm`"),
    }
}

/// A name in UTF-8, or in Latin-1 as older loggers write `µ` and `°`.
fn text_of(cell: &[u8]) -> String {
    std::str::from_utf8(cell)
        .map_or_else(|_| cell.iter().map(|byte| char::from(*byte)).collect(), ToOwned::to_owned)
}

/// Adds a row.
fn push_row(columns: &mut [Reading], record: &ByteRecord, line: &Line) -> Result<(), TraceError> {
    let (found, expected) = (record.len(), columns.len());
    if found != expected {
        let hint = ragged_hint(record, expected, line);
        return Err(TraceError::Ragged { at: line.whole(), found, expected, hint });
    }
    if line.last && line.is_open() {
        return Err(TraceError::OpenQuote { at: line.whole() });
    }
    for (index, (cell, column)) in record.iter().zip(columns).enumerate() {
        column.push(cell, line, index)?;
    }
    Ok(())
}

fn ragged_hint(record: &ByteRecord, expected: usize, line: &Line) -> &'static str {
    let digits = |cell: &[u8]| cell.trim_ascii().last().is_some_and(u8::is_ascii_digit);
    if line.last && record.len() < expected {
        CUT_OFF
    } else if record.len() == 2 * expected && record.iter().all(digits) {
        DECIMAL_COMMA
    } else if expected == 1 {
        "\n\nhint: put `#` before the lines above the header"
    } else {
        ""
    }
}

#[cfg(test)]
mod tests;
