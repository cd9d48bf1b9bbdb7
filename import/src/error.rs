//! What was wrong with a file or a recipe, and where.

use crate::place::Place;
use crate::question::Question;

/// Why a file was not imported.
#[derive(Debug, Clone, thiserror::Error)]
#[non_exhaustive]
pub enum ImportError {
    /// Something in the file or the recipe cannot be used.
    #[error("{place}: found {found}, expected {expected}{}", hint_line(hint))]
    Found {
        /// Where.
        place: Box<Place>,
        /// What stands there.
        found: String,
        /// What was expected.
        expected: String,
        /// What probably helps; empty when nothing is known.
        hint: String,
    },
    /// Something can be read in more than one way.
    #[error("{0}")]
    Unanswered(Box<Question>),
}

fn hint_line(hint: &str) -> String {
    if hint.is_empty() { String::new() } else { format!("\n\nhint: {hint}") }
}

impl ImportError {
    /// Something found in place of something expected.
    pub(crate) fn found(
        place: Place,
        found: impl Into<String>,
        expected: impl Into<String>,
    ) -> Self {
        Self::Found {
            place: Box::new(place),
            found: found.into(),
            expected: expected.into(),
            hint: String::new(),
        }
    }

    /// The same with a hint.
    pub(crate) fn hinted(self, more: impl Into<String>) -> Self {
        match self {
            Self::Found { place, found, expected, .. } => {
                Self::Found { place, found, expected, hint: more.into() }
            }
            Self::Unanswered(question) => Self::Unanswered(question),
        }
    }
}

/// A cell or line as a message shows it: at most forty characters.
pub(crate) fn quoted(text: &str) -> String {
    const LONGEST: usize = 40;
    // As a whole: a bar above a letter stays there.
    let line = text.chars().take(LONGEST).collect::<String>().escape_debug().to_string();
    if text.chars().nth(LONGEST).is_some() { format!("`{line}…`") } else { format!("`{line}`") }
}
