//! Why a command refused its input, with the place as values: for programs that want to go there.

use std::error::Error;
use std::path::{Path, PathBuf};

use clap::error::{ContextKind, ContextValue};
use helixlock_lab::LabError;
use helixlock_plant::{At, MachineError};
use helixlock_traces::TraceError;

use super::terminal::shown;

/// A refusal and its place, as far as there is one.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Refused {
    /// What the command says: place, what was found, what was expected.
    pub message: String,
    /// The file.
    pub file: Option<PathBuf>,
    /// Line in it, from 1.
    pub line: Option<usize>,
    /// Column in that line, from 1, in characters.
    pub column: Option<usize>,
    /// Key of the machine file, column of the data, or word of the command.
    pub key: Option<String>,
}

/// What a library says of the contents of a file, with that file.
pub(crate) fn in_file<E: Error + Send + Sync + 'static>(
    path: &Path,
) -> impl Fn(E) -> anyhow::Error + Copy {
    move |error| anyhow::Error::new(error).context(At::file(path))
}

impl From<anyhow::Error> for Refused {
    fn from(error: anyhow::Error) -> Self {
        let told = || Some((error.downcast_ref::<At>()?.clone(), None));
        let (at, key) = error.chain().find_map(place).or_else(told).unwrap_or_default();
        let At { path, line, column } = at;
        Self {
            message: shown(&format!("{error:#}")),
            file: Some(path).filter(|path| !path.as_os_str().is_empty()),
            line,
            column,
            key,
        }
    }
}

impl From<clap::Error> for Refused {
    fn from(error: clap::Error) -> Self {
        let key = match error.get(ContextKind::InvalidArg) {
            Some(ContextValue::String(word)) => word.split([' ', '=']).next().map(str::to_owned),
            _ => None,
        };
        let text = error.render().to_string();
        let message = text.strip_prefix("error: ").unwrap_or(&text);
        let message = message.split("\n\nUsage:").next().unwrap_or(message).trim_end();
        let message = message.split("\n\nFor more information").next().unwrap_or(message);
        Self { message: shown(message), key, ..Self::default() }
    }
}

/// Place and key of a library's error.
fn place(cause: &(dyn Error + 'static)) -> Option<(At, Option<String>)> {
    let (at, key) = if let Some(error) = cause.downcast_ref::<MachineError>() {
        (error.at(), error.key())
    } else if let Some(error) = cause.downcast_ref::<TraceError>() {
        (error.at(), error.column())
    } else {
        let error = cause.downcast_ref::<LabError>()?;
        (error.at(), error.column())
    };
    Some((at, key.map(str::to_owned)))
}
