//! The languages there are.

use clap::ValueEnum;

use helixlock_report::{Page, translated};

use super::line::{self, said};

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
