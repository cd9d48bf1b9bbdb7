//! What can be wrong with a machine file, and where.

use std::path::{Path, PathBuf};

use helixlock_traces::{At, TraceError};

use crate::units::LARGEST_UM;

/// The place of byte `offset` of `text`.
pub(crate) fn place(path: &Path, text: &str, offset: usize) -> At {
    let before = text.get(..offset).unwrap_or(text);
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    At::file(path)
        .on_line(before.matches('\n').count() + 1)
        .at_column(before[line_start..].chars().count() + 1)
}

/// Why a machine file was refused; each message says where, what was found, what was expected.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MachineError {
    /// The file could not be read at all.
    #[error(transparent)]
    Read(#[from] TraceError),
    /// The file is not UTF-8 text.
    #[error("{}:{line}: found bytes that are not UTF-8, expected text", path.display())]
    Encoding {
        /// The file.
        path: PathBuf,
        /// Line of the first such byte.
        line: usize,
    },
    /// The file is not TOML.
    #[error("{at}: {message}")]
    Syntax {
        /// Where reading stopped.
        at: At,
        /// What the TOML reader found and expected.
        message: Box<str>,
    },
    /// A key no table has.
    #[error("{at}: unknown key `{found}` in `{table}`, expected {expected}")]
    UnknownKey {
        /// Where the key stands.
        at: At,
        /// The table.
        table: Box<str>,
        /// The key.
        found: Box<str>,
        /// The keys this table takes.
        expected: Box<str>,
    },
    /// A table or key that has no default.
    #[error("{at}: `{key}` is missing, expected for example `{example}`")]
    Missing {
        /// The table it belongs into, or the first line for a table.
        at: At,
        /// The key, with its table.
        key: Box<str>,
        /// A line that would do.
        example: Box<str>,
    },
    /// A value of another kind or with another unit.
    #[error("{at}: `{key}` is {found}, expected {expected}")]
    Value {
        /// Where the value stands.
        at: At,
        /// The key, with its table.
        key: Box<str>,
        /// The value as written.
        found: Box<str>,
        /// What would do.
        expected: Box<str>,
    },
    /// Two lines that cannot both hold.
    #[error("{at}: `{key}` is {found}, but {conflict}")]
    Conflict {
        /// Where the value stands.
        at: At,
        /// The key, with its table.
        key: Box<str>,
        /// The value as written.
        found: Box<str>,
        /// What speaks against it.
        conflict: Box<str>,
    },
    /// An effect that the machine or its surroundings cannot carry.
    #[error("{at}: {reason}")]
    Effect {
        /// The `[[effect]]`.
        at: At,
        /// Why.
        reason: Box<EffectError>,
    },
    /// A file the machine file names.
    #[error("{at}: `{key}` names `{found}`: {message}")]
    Companion {
        /// Where it is named.
        at: At,
        /// The key, with its table.
        key: Box<str>,
        /// The file.
        found: Box<str>,
        /// What is wrong with it.
        message: Box<str>,
    },
    /// Several things at once, in the order of the file.
    #[error("{}", lines(.0))]
    Several(Vec<Self>),
    /// A key that leads nowhere, such as through a value or past the end of an array.
    #[error("{}: key `{key}`: there is no place `{word}`, expected for example `spindle.speed` or `effect.0.amplitude`", path.display())]
    NoSuchKey {
        /// The file.
        path: PathBuf,
        /// The key asked for.
        key: Box<str>,
        /// The part of it that leads nowhere.
        word: Box<str>,
    },
    /// A position in the list of effects that does not exist.
    #[error("{}: effect {index} does not exist, there are {count}", path.display())]
    NoSuchEffect {
        /// The file.
        path: PathBuf,
        /// The position asked for, from 1.
        index: usize,
        /// How many there are.
        count: usize,
    },
}

impl MachineError {
    /// One error of all that is wrong with a file.
    pub(crate) fn all(mut errors: Vec<Self>) -> Self {
        errors.sort_by_key(|error| {
            let at = error.at();
            (at.line, at.column)
        });
        match errors.pop() {
            Some(only) if errors.is_empty() => only,
            last => Self::Several(errors.into_iter().chain(last).collect()),
        }
    }

    /// Where in which file; of several, the first.
    #[must_use]
    pub fn at(&self) -> At {
        match self {
            Self::Syntax { at, .. }
            | Self::UnknownKey { at, .. }
            | Self::Missing { at, .. }
            | Self::Value { at, .. }
            | Self::Conflict { at, .. }
            | Self::Effect { at, .. }
            | Self::Companion { at, .. } => at.clone(),
            Self::Read(error) => error.at(),
            Self::Encoding { path, line } => At::file(path).on_line(*line),
            Self::NoSuchKey { path, .. } | Self::NoSuchEffect { path, .. } => At::file(path),
            Self::Several(all) => all.first().map_or_else(At::default, Self::at),
        }
    }

    /// The key it is about; of several, the first's.
    #[must_use]
    pub fn key(&self) -> Option<&str> {
        match self {
            Self::UnknownKey { found: key, .. }
            | Self::Missing { key, .. }
            | Self::Value { key, .. }
            | Self::Conflict { key, .. }
            | Self::Companion { key, .. }
            | Self::NoSuchKey { key, .. } => Some(key),
            Self::Several(all) => all.first().and_then(Self::key),
            _ => None,
        }
    }

    /// The file, when it is no machine file at all, so that another one may have been meant.
    #[must_use]
    pub fn other_kind_of_file(&self) -> Option<&Path> {
        match self {
            Self::Syntax { at, .. } => Some(&at.path),
            Self::Encoding { path, .. } => Some(path),
            _ => None,
        }
    }
}

/// A line for each.
fn lines(errors: &[MachineError]) -> String {
    errors.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
}

/// Why an effect cannot be worked out.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum EffectError {
    /// It is driven by a column that is not there.
    #[error("effect `{effect}` needs the column `{column}`, which is not there{}", meant(*near))]
    MissingColumn {
        /// The effect.
        effect: String,
        /// The column.
        column: String,
        /// One that is called nearly so.
        near: Option<&'static str>,
    },
    /// It is driven by a part of the machine that the file does not describe.
    #[error("effect `{effect}` needs {part}")]
    MissingPart {
        /// The effect.
        effect: String,
        /// The part.
        part: crate::machine::Part,
    },
    /// Its value is nothing a machine could follow.
    #[error("{effect} gives {found} µm {place}, expected a finite number up to ±{LARGEST_UM:e} µm")]
    OutOfReach {
        /// The effect, by its number and name.
        effect: String,
        /// Its value.
        found: String,
        /// When and where.
        place: String,
    },
    /// All together move a reading on without end.
    #[error(
        "the effects move the {reading} by more than {most} pulses at once {place}, expected a machine that goes on smoothly"
    )]
    TooFast {
        /// What is read.
        reading: &'static str,
        /// Most pulses at once.
        most: u32,
        /// When and where.
        place: String,
    },
    /// The number of values is not the number of parameters.
    #[error("effect `{effect}` got {found} values, expected {expected}")]
    ValueCount {
        /// The effect.
        effect: String,
        /// How many were given.
        found: usize,
        /// How many it takes.
        expected: usize,
    },
    /// A formula of the user that is not one.
    #[error("formula `{formula}` of effect `{effect}`: {message}")]
    Formula {
        /// The effect.
        effect: String,
        /// The formula.
        formula: String,
        /// What is wrong.
        message: String,
    },
}

/// When and where, for a message.
pub(crate) fn moment(time_s: f64, position_mm: f64) -> String {
    format!("at {time_s:.6} s, {position_mm:.6} mm")
}

/// What a misspelt column may have been meant to be.
fn meant(near: Option<&'static str>) -> String {
    near.map_or_else(String::new, |near| format!("; is `{near}` meant?"))
}
