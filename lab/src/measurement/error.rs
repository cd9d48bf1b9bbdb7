//! What can be wrong with a measurement or an analysis.

use helixlock_traces::{At, TraceError};

/// Why a measurement cannot be analysed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LabError {
    /// The file itself cannot be read.
    #[error(transparent)]
    Trace(#[from] TraceError),
    /// No column holds an observation.
    #[error("{path}: found columns {found}, expected at least one of {expected}")]
    NoObservation {
        /// The file.
        path: String,
        /// Names of the columns there are.
        found: String,
        /// Names of the columns that would do.
        expected: &'static str,
    },
    /// No column says where or when a sample was taken.
    #[error("{path}: found columns {found}, expected one of `position_mm`, `time_s`, `angle_rev`")]
    NoCoordinate {
        /// The file.
        path: String,
        /// Names of the columns there are.
        found: String,
    },
    /// A column in a unit of length moves as far as the axis, and has no name that says what it is.
    #[error(
        "{path}: found `{found}`, which moves as far as the axis, expected `position_mm` for where that is"
    )]
    NoPosition {
        /// The file.
        path: String,
        /// The column.
        found: String,
    },
    /// The file measures another kind of machine than the machine file describes.
    #[error("{path}: found `{found}`, expected {expected}\n\nhint: {hint}")]
    OtherKind {
        /// The data file.
        path: String,
        /// The column found.
        found: &'static str,
        /// The column that fits the machine file.
        expected: &'static str,
        /// What to change.
        hint: &'static str,
    },
    /// A cell holds a value its column cannot have.
    #[error(
        "{at}{}: column `{column}`: found `{found}`, expected {expected}{hint}",
        row_of(at, *row)
    )]
    Cell {
        /// File and line.
        at: Box<At>,
        /// The row, from 1, by which a file without lines is told.
        row: usize,
        /// Name of the column.
        column: String,
        /// The value.
        found: f64,
        /// What it should be.
        expected: &'static str,
        /// What the likely reason is; empty, or a line of its own.
        hint: &'static str,
    },
    /// Too few usable samples.
    #[error("{path}: found {found} usable samples, expected at least {expected}")]
    TooFew {
        /// The file.
        path: String,
        /// Samples with a coordinate and an observation.
        found: usize,
        /// Fewest that can be analysed.
        expected: usize,
    },
    /// Passes that say nothing, as each has a zero of its own.
    #[error(
        "{path}: column `pass`: found {passes} passes of which {lone} have a single sample, \
         expected passes of two samples or more\n\nhint: a column that counts rows is no pass; \
         take it out, or call it something else"
    )]
    LonePasses {
        /// The file.
        path: String,
        /// Passes there are.
        passes: usize,
        /// Those of one sample.
        lone: usize,
    },
    /// A captured pulse train is too short.
    #[error("{path}: found {found} {train} pulses, expected at least {expected}")]
    FewPulses {
        /// The capture.
        path: String,
        /// `grating` or `laser`.
        train: &'static str,
        /// Rising edges of it.
        found: usize,
        /// Fewest that can be used.
        expected: usize,
    },
    /// Two captured trains are not those of the machine.
    #[error(
        "{path}: found {found:.4} laser pulses a grating pulse, expected {expected:.4} by the \
         machine's dividers\n\nhint: exchange `--grating-signal` and `--laser-signal`, or check A and B"
    )]
    PulseRatio {
        /// The capture.
        path: String,
        /// Laser pulses over grating pulses.
        found: f64,
        /// B/A, or 1 behind the dividers.
        expected: f64,
    },
}

impl LabError {
    /// Where in which file.
    #[must_use]
    pub fn at(&self) -> At {
        match self {
            Self::Trace(error) => error.at(),
            Self::Cell { at, .. } => At::clone(at),
            Self::NoObservation { path, .. }
            | Self::NoCoordinate { path, .. }
            | Self::NoPosition { path, .. }
            | Self::OtherKind { path, .. }
            | Self::TooFew { path, .. }
            | Self::LonePasses { path, .. }
            | Self::FewPulses { path, .. }
            | Self::PulseRatio { path, .. } => At::file(path),
        }
    }

    /// The column it is about.
    #[must_use]
    pub fn column(&self) -> Option<&str> {
        match self {
            Self::Trace(error) => error.column(),
            Self::Cell { column, .. } => Some(column),
            Self::LonePasses { .. } => Some("pass"),
            Self::NoPosition { found, .. } => Some(found),
            _ => None,
        }
    }
}

fn row_of(at: &At, row: usize) -> String {
    if at.line.is_some() { String::new() } else { format!(": row {row}") }
}
