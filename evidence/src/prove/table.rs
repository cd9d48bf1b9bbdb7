//! What is proven, as a table for people and for `docs/verification.md`.

use std::fmt::Write;

use super::tally::Tally;

/// What marks a row that does not hold.
pub const FAILS: &str = "**fails**: ";

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

impl Row {
    /// The row as a line of a Markdown table.
    #[must_use]
    pub fn line(&self) -> String {
        let mark = if self.good { "" } else { FAILS };
        format!("| {} | {} | {mark}{} |", self.what, self.how, self.outcome)
    }
}

/// What is said of one block.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Share {
    /// The block.
    pub block: String,
    /// Its lines of the table.
    pub lines: Vec<String>,
    /// Its mutants that nothing noticed, a line each.
    pub unnoticed: Vec<String>,
}

/// The campaign of all these blocks.
#[must_use]
pub fn total(shares: &[Share]) -> Tally {
    shares.iter().flat_map(|share| &share.lines).filter_map(|line| Tally::of_line(line)).sum()
}

/// Shares as a Markdown table, with the mutants that nothing noticed below it.
#[must_use]
pub fn markdown(shares: &[Share]) -> String {
    let mut text = String::from("| what | how | outcome |\n|---|---|---|\n");
    let total = total(shares).row("").line();
    let lines = shares.iter().flat_map(|share| &share.lines).chain([&total]);
    let unnoticed = shares.iter().flat_map(|share| &share.unnoticed);
    for line in lines {
        // Writing to a string cannot fail, here and below.
        let _ = writeln!(text, "{line}");
    }
    for line in unnoticed {
        let _ = write!(text, "\n{line}");
    }
    text
}

/// The shares of a table that was printed.
#[must_use]
pub fn shares(table: &str) -> Vec<Share> {
    let mut shares: Vec<Share> = Vec::new();
    for line in table.lines() {
        let Some(block) = block_of(line) else { continue };
        if !shares.iter().any(|share| share.block == block) {
            shares.push(Share { block: block.to_owned(), ..Share::default() });
        }
        for share in shares.iter_mut().filter(|share| share.block == block) {
            let lines = if line.starts_with('|') { &mut share.lines } else { &mut share.unnoticed };
            lines.push(line.to_owned());
        }
    }
    shares
}

/// Of which block a line speaks: "| `block`: …" or "- Survived: `block.v:12`, …".
fn block_of(line: &str) -> Option<&str> {
    let (before, rest) = line.split_once('`')?;
    match before {
        "| " => rest.split_once('`').map(|(block, _)| block),
        _ if before.starts_with("- ") => rest.split_once(".v:").map(|(block, _)| block),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_printed_table_is_read_back() {
        let tally = Tally { tried: 9, noticed: 6, survive: 2, equal: 1 };
        let lines = vec!["| `b`: a claim | so | true |".to_owned(), tally.row("b").line()];
        let unnoticed = vec!["- Survived: `b.v:7`, `x` as `~x`".to_owned()];
        let first = Share { block: "b".to_owned(), lines, unnoticed };
        let second =
            Share { block: "c".to_owned(), lines: vec![tally.row("c").line()], ..first.clone() };
        let second = Share { unnoticed: Vec::new(), ..second };
        let printed = markdown(&[first.clone(), second.clone()]);
        assert!(printed.contains("\n| 18 mutants, one mistake each |"), "{printed}");
        assert_eq!(shares(&printed), [first, second]);
    }
}
