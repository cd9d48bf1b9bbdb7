//! Differences that are meant, each with its reason.

use std::cell::Cell;
use std::path::Path;

use anyhow::{Context, bail};
use regex::Regex;

use crate::tools::read;

/// One difference that is meant.
#[derive(Debug)]
pub(super) struct Expected {
    /// Files that may differ, by their path.
    files: Regex,
    /// Text in them that may differ; without it, all of them.
    text: Option<Regex>,
    /// Why.
    pub(super) reason: String,
    /// Files in which it was met.
    pub(super) met: Cell<usize>,
}

/// What is left of two files when all that is meant is taken out of both.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Left {
    /// The whole file may differ.
    Nothing,
    /// Both texts without what may differ.
    Texts(String, String),
}

/// Reads a list: paragraphs of `files = …`, `text = …` (may be left out) and `reason = …`; the
/// first two are regular expressions, to the end of the line.
///
/// # Errors
///
/// File and line of what is not understood.
pub(super) fn read_list(path: &Path) -> anyhow::Result<Vec<Expected>> {
    let text = read(path)?;
    parse(&text).with_context(|| path.display().to_string())
}

/// What is left of a file that differs, and notes which differences were met.
#[must_use]
pub(super) fn without(list: &[Expected], file: &str, before: &[u8], after: &[u8]) -> Left {
    let mut texts = [before, after].map(|bytes| String::from_utf8_lossy(bytes).into_owned());
    for expected in list.iter().filter(|expected| expected.files.is_match(file)) {
        let Some(pattern) = &expected.text else {
            expected.met.update(|files| files + 1);
            return Left::Nothing;
        };
        if texts.iter().any(|text| pattern.is_match(text)) {
            expected.met.update(|files| files + 1);
        }
        texts = texts.map(|text| pattern.replace_all(&text, "").into_owned());
    }
    let [before, after] = texts;
    Left::Texts(before, after)
}

fn parse(text: &str) -> anyhow::Result<Vec<Expected>> {
    let mut list = Vec::new();
    let (mut files, mut pattern) = (None, None);
    for (row, line) in (1..).zip(text.lines()) {
        let line = line.trim();
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        let (key, value) = line.split_once(" = ").unwrap_or((line, ""));
        match key {
            "files" => files = Some(regex(row, value)?),
            "text" => pattern = Some(regex(row, value)?),
            "reason" => {
                let files = files.take().with_context(|| format!("{row}: no `files` before it"))?;
                let (text, reason) = (pattern.take(), value.to_owned());
                list.push(Expected { files, text, reason, met: Cell::new(0) });
            }
            _ => bail!("{row}: found `{line}`, expected `files = `, `text = ` or `reason = `"),
        }
    }
    if files.is_some() {
        bail!("the last `files` has no `reason`");
    }
    Ok(list)
}

fn regex(row: usize, pattern: &str) -> anyhow::Result<Regex> {
    Regex::new(pattern).with_context(|| format!("{row}: `{pattern}` is no regular expression"))
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIST: &str = "# a list\nfiles = ledger\\.json$\ntext = because .*\nreason = says why\n\n\
                        files = \\.html$\nreason = new page\n";

    #[test]
    fn only_the_text_named_may_differ() {
        let list = parse(LIST).unwrap();
        let left = without(&list, "seed/1/ledger.json", b"1 because a\n2", b"1 because b\n3");
        assert_eq!(left, Left::Texts("1 \n2".to_owned(), "1 \n3".to_owned()));
        assert_eq!((list[0].met.get(), list[1].met.get()), (1, 0));
    }

    #[test]
    fn a_file_named_without_text_may_differ_as_a_whole() {
        let list = parse(LIST).unwrap();
        assert_eq!(without(&list, "a.html", b"1", b"2"), Left::Nothing);
        let left = without(&list, "a.csv", b"1", b"2");
        assert_eq!(left, Left::Texts("1".to_owned(), "2".to_owned()));
    }

    #[test]
    fn a_list_that_is_not_understood_is_refused_with_its_line() {
        let error = |text: &str| parse(text).unwrap_err().to_string();
        let expected = "expected `files = `, `text = ` or `reason = `";
        assert_eq!(error("\nfile = a"), format!("2: found `file = a`, {expected}"));
        assert_eq!(error("reason = a"), "1: no `files` before it");
        assert_eq!(error("files = a"), "the last `files` has no `reason`");
        assert_eq!(error("files = ("), "1: `(` is no regular expression");
    }
}
