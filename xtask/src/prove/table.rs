//! What is proven, as a table for people and for `docs/verification.md`.

use std::fmt::Write;

/// One row: what, how, with which bound, and the outcome.
#[derive(Clone, Debug)]
pub struct Row {
    /// The claim or the campaign.
    pub what: String,
    /// The method.
    pub how: String,
    /// What was found.
    pub outcome: String,
    /// It holds.
    pub good: bool,
}

/// Rows as a Markdown table.
#[must_use]
pub fn markdown(rows: &[Row]) -> String {
    let mut text = String::from("| what | how | outcome |\n|---|---|---|\n");
    for row in rows {
        let mark = if row.good { "" } else { "**fails**: " };
        // Writing to a string cannot fail.
        let _ = writeln!(text, "| {} | {} | {mark}{} |", row.what, row.how, row.outcome);
    }
    text
}
