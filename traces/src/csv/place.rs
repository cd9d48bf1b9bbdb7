//! Where a record stands in the text.

use std::io;
use std::path::Path;

use ::csv::{ByteRecord, Reader};

use crate::error::{At, TraceError};

/// The text being read, to say where something stands.
pub(super) struct Source<'a> {
    pub(super) text: &'a [u8],
    pub(super) path: &'a Path,
    pub(super) separator: u8,
}

impl<'a> Source<'a> {
    /// Reads the next record that is not blank; `false` at the end.
    pub(super) fn next(
        &self,
        reader: &mut Reader<&[u8]>,
        record: &mut ByteRecord,
    ) -> Result<bool, TraceError> {
        loop {
            let more = reader.read_byte_record(record).map_err(|error| TraceError::Read {
                path: self.path.to_owned(),
                source: io::Error::other(error),
            })?;
            // A quoted empty cell is a row; a line of blanks is none.
            let blank =
                record.len() == 1 && !record[0].is_empty() && record[0].trim_ascii().is_empty();
            if !more || !blank {
                return Ok(more);
            }
        }
    }

    /// The record just read, as a line of the text.
    ///
    /// The reader's own position lies before the comments that precede a record, and before the
    /// line feed of a CRLF, so the line is worked out from where the record ended.
    pub(super) fn line(&self, reader: &Reader<&[u8]>) -> Line<'a> {
        let position = reader.position();
        let end = usize::try_from(position.byte()).map_or(self.text.len(), |end| end);
        let before_end = &self.text[..end.min(self.text.len())];
        let after_line_feed = before_end.ends_with(b"\n");
        let number = usize::try_from(position.line()).unwrap_or(usize::MAX);
        Line {
            number: if after_line_feed { number - 1 } else { number },
            before_end,
            last: end == self.text.len() && !after_line_feed,
            path: self.path,
            separator: char::from(self.separator),
        }
    }
}

/// A line of the text.
pub(super) struct Line<'a> {
    /// Its number, from 1.
    pub(super) number: usize,
    /// It is the last one, and no line end follows it.
    pub(super) last: bool,
    before_end: &'a [u8],
    path: &'a Path,
    separator: char,
}

impl Line<'_> {
    /// A quote in it is not closed.
    pub(super) fn is_open(&self) -> bool {
        let line = self.before_end.rsplit(|byte| matches!(byte, b'\n' | b'\r')).next();
        line.is_some_and(|line| line.split(|byte| *byte == b'"').count() % 2 == 0)
    }

    /// The line as a whole.
    pub(super) fn whole(&self) -> At {
        At::file(self.path).on_line(self.number)
    }

    /// The first character of a cell, counted from 0, that is no blank.
    pub(super) fn at(&self, cell: usize) -> At {
        let end = self.before_end.trim_ascii_end().len().max(1) - 1;
        let start = self.before_end[..end].iter().rposition(|byte| matches!(byte, b'\n' | b'\r'));
        let line = String::from_utf8_lossy(&self.before_end[start.map_or(0, |at| at + 1)..]);
        self.whole().at_column(1 + self.characters_before(&line, cell))
    }

    /// Characters of the line before the content of a cell; separators inside quotes separate
    /// nothing.
    fn characters_before(&self, line: &str, cell: usize) -> usize {
        let (mut quoted, mut separators) = (false, 0);
        for (index, character) in line.chars().enumerate() {
            match character {
                '"' => quoted = !quoted,
                c if c == self.separator && !quoted => separators += 1,
                ' ' | '\t' => {}
                _ if separators == cell => return index,
                _ => {}
            }
        }
        line.trim_end().chars().count()
    }
}
