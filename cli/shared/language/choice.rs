//! The languages there are.

use clap::ValueEnum;

use super::line;

/// Language of reports.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Language {
    /// English
    #[default]
    En,
    /// Chinese
    Zh,
}

impl Language {
    /// Some lines of a report, in this language.
    pub(crate) fn of(self, lines: &str) -> String {
        match self {
            Self::En => lines.to_owned(),
            Self::Zh => lines.split('\n').map(line::translated).collect::<Vec<_>>().join("\n"),
        }
    }
}
