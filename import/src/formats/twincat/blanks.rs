//! Names with blanks in an export whose cells are parted by blanks.
//!
//! Where every channel has a column of times, each line of the header has its key before every channel, so
//! that what stands between two keys is one cell. Where channels share their times nothing tells where a name
//! ends, and such a file stays refused.

use super::layout;
use crate::grid::Delimiter;

/// The lines with quotes about such cells; `None` where no name has a blank, or nothing tells the cells.
pub(super) fn quoted(lines: &[&str]) -> Option<Vec<String>> {
    let (_, line) = layout::delimiter(lines).filter(|found| found.0 == Delimiter::Char(' '))?;
    let names = words(lines[line - 1]);
    let channels = names.iter().filter(|word| **word == names[0]).count();
    let is_row = |line: &&str| line.starts_with(|c: char| c.is_ascii_digit());
    let first = line + lines[line..].iter().position(is_row)?;
    if words(lines[first]).len() != 2 * channels || names.len() == 2 * channels {
        return None;
    }
    let head = |line: &&str| by_keys(line, channels).unwrap_or_else(|| (*line).to_owned());
    by_keys(lines[line - 1], channels)?;
    let rows = lines[first..].iter().map(|line| (*line).to_owned());
    Some(lines[..first].iter().map(head).chain(rows).collect())
}

fn words(line: &str) -> Vec<&str> {
    line.split_whitespace().collect()
}

/// A line whose first word stands before every channel, with all that follows it in quotes.
fn by_keys(line: &str, channels: usize) -> Option<String> {
    let words = words(line);
    let (key, rest) = words.split_first()?;
    let cells: Vec<String> = rest.split(|word| word == key).map(|cell| cell.join(" ")).collect();
    let is_told =
        cells.len() == channels && cells.iter().all(|cell| !cell.is_empty() && !cell.contains('"'));
    let pair = |cell: &String| format!("{key} \"{cell}\"");
    is_told.then(|| cells.iter().map(pair).collect::<Vec<_>>().join(" "))
}
