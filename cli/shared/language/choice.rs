//! The languages there are.

use std::ffi::OsString;

use clap::error::ErrorKind;
use clap::{Command, ValueEnum};

use helixlock_report::{Page, translated};

use super::help;
use super::line::{self, said};
use crate::shared::terminal::shown;

/// Language of reports and pages.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Language {
    /// English
    #[default]
    En,
    /// Chinese
    Zh,
}

impl Language {
    /// The language that the words of a command line ask for, whatever else is wrong with them.
    pub(crate) fn asked(words: impl Iterator<Item = OsString>) -> Self {
        let words: Vec<_> = words.take_while(|word| word != "--").collect();
        let joined = words.iter().filter_map(|word| word.to_str()?.strip_prefix("--language="));
        let apart = words.windows(2).filter(|pair| pair[0] == "--language");
        let apart = apart.filter_map(|pair| pair[1].to_str());
        let mut known = joined.chain(apart).filter_map(|name| Self::from_str(name, false).ok());
        known.next().unwrap_or_default()
    }

    /// A command that helps in this language.
    pub(crate) fn help(self, command: Command) -> Command {
        match self {
            Self::En => command,
            Self::Zh => help::in_chinese(command),
        }
    }

    /// What is wrong with words, in this language.
    pub(crate) fn error(self, error: &clap::Error) -> String {
        let said = shown(&error.render().to_string());
        match error.kind() {
            ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => said, // by a command that helps
            _ => self.of(&said),
        }
    }

    /// A page as HTML, in this language.
    pub(crate) fn page(self, page: &Page) -> String {
        match self {
            Self::En => page.html(),
            Self::Zh => page.html_in("zh", said),
        }
    }

    /// A picture as SVG, in this language.
    pub(crate) fn picture(self, svg: String) -> String {
        match self {
            Self::En => svg,
            Self::Zh => translated(&svg, said),
        }
    }

    /// Some lines of a report, in this language.
    pub(crate) fn of(self, lines: &str) -> String {
        match self {
            Self::En => lines.to_owned(),
            Self::Zh => lines.split('\n').map(line::translated).collect::<Vec<_>>().join("\n"),
        }
    }
}
