//! Why something was not done, as a page is told it.

use helixlock_workbench::{Answer, Kind};
use serde::Serialize;

/// Not done, and why.
#[derive(Debug)]
pub(crate) enum Refusal {
    /// What was asked is wrong, or the files are.
    Wrong(anyhow::Error),
    /// The files are no longer those that the page was shown.
    Changed,
    /// There is nothing of that name.
    Unknown(String),
}

impl<E: Into<anyhow::Error>> From<E> for Refusal {
    fn from(error: E) -> Self {
        Self::Wrong(error.into())
    }
}

/// How an ask was answered.
pub(crate) type Answered = Result<Answer, Refusal>;

#[derive(Serialize)]
struct RefusalJson {
    error: String,
}

impl From<Refusal> for Answer {
    fn from(refusal: Refusal) -> Self {
        let (status, error) = match refusal {
            Refusal::Wrong(error) => (400, format!("{error:#}")),
            Refusal::Changed => (409, "the files have changed since they were shown".to_owned()),
            Refusal::Unknown(name) => (404, format!("`{name}` is not here")),
        };
        let body = serde_json::to_vec(&RefusalJson { error }).unwrap_or_default();
        Self { status, kind: Kind::Json, body }
    }
}

/// A result as JSON.
pub(crate) fn json(value: &impl Serialize) -> Answered {
    Ok(Answer { status: 200, kind: Kind::Json, body: serde_json::to_vec(value)? })
}
