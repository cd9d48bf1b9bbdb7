//! Two folders held against each other, byte by byte.

use std::collections::BTreeSet;
use std::fmt;
use std::path::Path;

use anyhow::Context;

use super::expected::{Expected, Left, without};

/// How much of a line is shown on either side.
const SHOWN_CHARACTERS: usize = 80;

/// A file that is not the same in both folders.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Difference {
    /// The file, below both folders.
    pub(super) file: String,
    /// What differs first.
    pub(super) what: What,
}

/// What differs first in a file.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum What {
    /// The first place.
    Place {
        /// Line, from 1.
        line: usize,
        /// Byte in that line, from 1.
        column: usize,
        /// That line before.
        before: String,
        /// And after.
        after: String,
    },
    /// There was no such file before.
    New,
    /// There is no such file any more.
    Gone,
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.what {
            What::Place { line, column, before, after } => {
                writeln!(f, "{}:{line}:{column}:", self.file)?;
                write!(f, "  before `{before}`\n  after  `{after}`")
            }
            What::New => write!(f, "{}: only after", self.file),
            What::Gone => write!(f, "{}: only before", self.file),
        }
    }
}

/// All files of both folders, how many there are, and those that differ beyond what is expected.
///
/// # Errors
///
/// When a file cannot be read.
pub(super) fn differences(
    before: &Path,
    after: &Path,
    expected: &[Expected],
) -> anyhow::Result<(usize, Vec<Difference>)> {
    let mut files = BTreeSet::new();
    collect(before, "", &mut files)?;
    collect(after, "", &mut files)?;
    let mut found = Vec::new();
    for file in &files {
        let sides = (bytes(&before.join(file))?, bytes(&after.join(file))?);
        let what = compare(file, (sides.0.as_deref(), sides.1.as_deref()), expected);
        found.extend(what.map(|what| Difference { file: file.clone(), what }));
    }
    Ok((files.len(), found))
}

/// The paths of all files below a folder, `/` between their parts.
fn collect(root: &Path, below: &str, files: &mut BTreeSet<String>) -> anyhow::Result<()> {
    let folder = root.join(below);
    for entry in folder.read_dir().with_context(|| folder.display().to_string())? {
        let entry = entry?;
        let name = entry.file_name().to_string_lossy().into_owned();
        let path = if below.is_empty() { name } else { format!("{below}/{name}") };
        if entry.file_type()?.is_dir() {
            collect(root, &path, files)?;
        } else {
            files.insert(path);
        }
    }
    Ok(())
}

/// The bytes of a file that may be missing.
fn bytes(path: &Path) -> anyhow::Result<Option<Vec<u8>>> {
    match std::fs::read(path) {
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(None),
        read => read.map(Some).with_context(|| path.display().to_string()),
    }
}

/// A file before and after; none where it is missing.
type Sides<'a> = (Option<&'a [u8]>, Option<&'a [u8]>);

fn compare(file: &str, (before, after): Sides<'_>, expected: &[Expected]) -> Option<What> {
    if before == after {
        return None;
    }
    let left = without(expected, file, before.unwrap_or_default(), after.unwrap_or_default());
    match (before, after, left) {
        (_, _, Left::Nothing) => None,
        (Some(_), None, _) => Some(What::Gone),
        (None, ..) => Some(What::New),
        (Some(before), Some(after), Left::Texts(..)) if !text(before) || !text(after) => {
            first(before, after)
        }
        (.., Left::Texts(before, after)) => first(before.as_bytes(), after.as_bytes()),
    }
}

/// Whether bytes are text; others are compared as they are.
fn text(bytes: &[u8]) -> bool {
    std::str::from_utf8(bytes).is_ok()
}

fn first(before: &[u8], after: &[u8]) -> Option<What> {
    if before == after {
        return None;
    }
    let same = before.iter().zip(after).take_while(|(before, after)| before == after).count();
    let start = before[..same].iter().rposition(|byte| *byte == b'\n').map_or(0, |at| at + 1);
    let line = before[..same].split(|byte| *byte == b'\n').count();
    let shown = |bytes: &[u8]| shown(&bytes[start..], same - start);
    Some(What::Place { line, column: same - start + 1, before: shown(before), after: shown(after) })
}

/// What stands about a place of the first line.
fn shown(bytes: &[u8], place: usize) -> String {
    let end = bytes.iter().position(|byte| *byte == b'\n').unwrap_or(bytes.len());
    let from = place.saturating_sub(SHOWN_CHARACTERS / 2);
    let to = end.min(from + SHOWN_CHARACTERS);
    String::from_utf8_lossy(&bytes[from.min(end)..to]).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The place of the first difference in text, `line:column`, and both lines.
    fn found(before: &str, after: &str) -> Option<(String, String, String)> {
        match first(before.as_bytes(), after.as_bytes())? {
            What::Place { line, column, before, after } => {
                Some((format!("{line}:{column}"), before, after))
            }
            What::New | What::Gone => None,
        }
    }

    #[test]
    fn the_first_difference_has_its_place() {
        let place = |place: &str, before: &str, after: &str| {
            Some((place.to_owned(), before.to_owned(), after.to_owned()))
        };
        assert_eq!(found("a\nbcd\n", "a\nbce\n"), place("2:3", "bcd", "bce"));
        assert_eq!(found("a\n", "a\nb\n"), place("2:1", "", "b"));
        assert_eq!(found("a", "a"), None);
        let (long, tail) = ("x".repeat(200), "x".repeat(SHOWN_CHARACTERS / 2));
        let (before, after) = (format!("{tail}1"), format!("{tail}2"));
        let expected = place("1:201", &before, &after);
        assert_eq!(found(&format!("{long}1"), &format!("{long}2")), expected);
    }

    #[test]
    fn bytes_that_are_no_text_are_compared_as_they_are() {
        let found = compare("a.bin", (Some(b"\xff\x00"), Some(b"\xfe\x00")), &[]);
        assert!(matches!(found, Some(What::Place { line: 1, column: 1, .. })), "{found:?}");
    }

    #[test]
    fn a_file_on_one_side_only_differs() {
        assert_eq!(compare("a", (None, Some(b"")), &[]), Some(What::New));
        assert_eq!(compare("a", (Some(b""), None), &[]), Some(What::Gone));
        assert_eq!(compare("a", (Some(b"1"), Some(b"1")), &[]), None);
    }
}
