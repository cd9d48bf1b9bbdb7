//! What was wrong with a file, and where.

use std::fmt;
use std::path::PathBuf;

use crate::number::LARGEST;

/// A place in a file; what is not known is left out of the message.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct At {
    /// The file.
    pub path: PathBuf,
    /// Line, from 1.
    pub line: Option<usize>,
    /// Column, from 1, in characters.
    pub column: Option<usize>,
}

impl At {
    /// The file as a whole.
    pub fn file(path: impl Into<PathBuf>) -> Self {
        Self { path: path.into(), line: None, column: None }
    }

    /// A whole line of it, counted from 1.
    #[must_use]
    pub fn on_line(mut self, line: usize) -> Self {
        self.line = Some(line);
        self
    }

    /// A place in that line, counted from 1 in characters.
    #[must_use]
    pub fn at_column(mut self, column: usize) -> Self {
        self.column = Some(column);
        self
    }
}

impl fmt::Display for At {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.path.display())?;
        for number in [self.line, self.column].into_iter().flatten() {
            write!(f, ":{number}")?;
        }
        Ok(())
    }
}

/// Why a file of samples or waveforms was refused: where, what was found, what was expected.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TraceError {
    /// The file could not be opened or read.
    #[error("{}: cannot be read", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// The file is longer than any that is taken, or does not end.
    #[error("{}: found more than {most} bytes, expected a shorter file", path.display())]
    TooLong {
        /// The file.
        path: PathBuf,
        /// Most bytes.
        most: u64,
    },
    /// The file is of another kind.
    #[error("{}: found {found}, expected {expected}", path.display())]
    Kind {
        /// The file.
        path: PathBuf,
        /// What it looks like.
        found: &'static str,
        /// What would have been read.
        expected: &'static str,
    },
    /// Nothing is in it: no header, or no row below it.
    #[error("{at}: found {found}, expected a header with units in the names and rows below it")]
    Empty {
        /// The file.
        at: At,
        /// What there is.
        found: &'static str,
    },
    /// More of something than memory and patience hold.
    #[error("{at}: found more {what}, expected at most {most}")]
    TooMany {
        /// Where they become too many.
        at: At,
        /// How many may be.
        most: usize,
        /// What there is.
        what: &'static str,
    },
    /// The first line holds numbers or names that cannot be used.
    #[error("{at}: found {found}, expected {expected}")]
    Header {
        /// Where in the header.
        at: At,
        /// The cell, or what is wrong with the line.
        found: String,
        /// What belongs there.
        expected: &'static str,
    },
    /// Two columns have one name.
    #[error("{at}: column `{name}` comes twice, expected every name once")]
    DuplicateColumn {
        /// The second of them.
        at: At,
        /// The name.
        name: String,
    },
    /// A row that is longer or shorter than the header.
    #[error("{at}: found {}, expected {expected} as in the header{hint}", cells(*found))]
    Ragged {
        /// The row.
        at: At,
        /// Its cells.
        found: usize,
        /// The header's cells.
        expected: usize,
        /// What the likely reason is; empty, or a line of its own.
        hint: &'static str,
    },
    /// The text ends inside quotes.
    #[error("{at}: found the end of the file inside quotes, expected a closing quote")]
    OpenQuote {
        /// The last line.
        at: At,
    },
    /// A cell that is not a finite number.
    #[error("{at}: column `{name}`: found `{found}`, expected a number or an empty cell{hint}")]
    Cell {
        /// The cell.
        at: At,
        /// Its column.
        name: String,
        /// What stands in it.
        found: String,
        /// What the likely reason is; empty, or a line of its own.
        hint: &'static str,
    },
    /// A column of a binary file whose type is not a number.
    #[error("{}: column `{name}`: found {found}, expected numbers", path.display())]
    ColumnType {
        /// The file.
        path: PathBuf,
        /// The column.
        name: String,
        /// Its type.
        found: String,
    },
    /// A number of a binary file that no quantity reaches.
    #[error(
        "{}: column `{name}`: found {found:e} in row {row}, expected a finite number up to {LARGEST:e}",
        path.display()
    )]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// The row, from 1.
        row: usize,
        /// The column.
        name: String,
        /// The number.
        found: f64,
    },
    /// A column of a binary file that is packed in a way we do not read.
    #[error(
        "{}: column `{name}`: found compression {found}, expected none, snappy, gzip, zstd or lz4",
        path.display()
    )]
    Compression {
        /// The file.
        path: PathBuf,
        /// The column.
        name: String,
        /// The compression.
        found: &'static str,
    },
    /// A binary file that contradicts itself.
    #[error("{}: cannot be read as Parquet: {message}", path.display())]
    Parquet {
        /// The file.
        path: PathBuf,
        /// What the library said.
        message: String,
    },
    /// A column someone asked for is not there.
    #[error("{}: column `{name}` is missing, found {found}", path.display())]
    NoColumn {
        /// The file.
        path: PathBuf,
        /// The column wanted.
        name: String,
        /// The columns there are.
        found: String,
    },
    /// A dump that breaks its own format.
    #[error("{at}: found {found}, expected {expected}")]
    Dump {
        /// The line.
        at: At,
        /// What stands there.
        found: String,
        /// What the format wants.
        expected: &'static str,
    },
    /// A signal someone asked for is not there, or more than one is meant.
    #[error("{}: signal `{name}` {problem}, found {found}", path.display())]
    NoSignal {
        /// The file.
        path: PathBuf,
        /// The signal wanted.
        name: String,
        /// Whether it is missing or ambiguous.
        problem: &'static str,
        /// The signals there are, or those meant.
        found: String,
    },
}

impl TraceError {
    /// Where in which file.
    #[must_use]
    pub fn at(&self) -> At {
        match self {
            Self::Read { path, .. }
            | Self::TooLong { path, .. }
            | Self::Kind { path, .. }
            | Self::ColumnType { path, .. }
            | Self::TooLarge { path, .. }
            | Self::Compression { path, .. }
            | Self::Parquet { path, .. }
            | Self::NoColumn { path, .. }
            | Self::NoSignal { path, .. } => At::file(path),
            Self::Empty { at, .. }
            | Self::TooMany { at, .. }
            | Self::Header { at, .. }
            | Self::DuplicateColumn { at, .. }
            | Self::Ragged { at, .. }
            | Self::OpenQuote { at }
            | Self::Cell { at, .. }
            | Self::Dump { at, .. } => at.clone(),
        }
    }

    /// The column or signal it is about.
    #[must_use]
    pub fn column(&self) -> Option<&str> {
        match self {
            Self::DuplicateColumn { name, .. }
            | Self::Cell { name, .. }
            | Self::ColumnType { name, .. }
            | Self::TooLarge { name, .. }
            | Self::Compression { name, .. }
            | Self::NoColumn { name, .. }
            | Self::NoSignal { name, .. } => Some(name),
            _ => None,
        }
    }
}

fn cells(count: usize) -> String {
    if count == 1 { "1 cell".into() } else { format!("{count} cells") }
}
