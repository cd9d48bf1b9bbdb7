//! What goes to a terminal: nothing in it that a terminal obeys, and nothing quoted without end.

use std::fmt::Write as _;
use std::io::{self, Write};

/// Longest fragment in backticks that an error quotes, characters.
const LONGEST_QUOTE: usize = 200;
/// Longest error, characters: some fifty lines.
const LONGEST_ERROR: usize = 4000;

/// Passes text on with [`is_obeyed`] characters as `\u001b`, which JSON reads as well.
pub(crate) struct Terminal<W: Write>(pub(crate) W);

impl<W: Write> Write for Terminal<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match std::str::from_utf8(bytes) {
            Ok(text) if text.contains(is_obeyed) => self.0.write_all(escaped(text).as_bytes())?,
            _ => self.0.write_all(bytes)?,
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush()
    }
}

/// An error as it is shown: escaped, with its quotes and itself cut where they are too long.
pub(crate) fn shown(error: &str) -> String {
    let mut shown = String::new();
    for (index, part) in error.split('`').enumerate() {
        if 0 < index {
            shown.push('`');
        }
        // Between an odd backtick and the next one is what was found in a file.
        let quoted = index % 2 == 1;
        shown.push_str(&if quoted {
            cut(part, LONGEST_QUOTE).replace('\n', "\\n")
        } else {
            part.into()
        });
    }
    escaped(&cut(&shown, LONGEST_ERROR))
}

/// The beginning of a text that is too long, and a mark.
fn cut(text: &str, longest: usize) -> String {
    match text.char_indices().nth(longest) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}

fn escaped(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    for character in text.chars() {
        if is_obeyed(character) {
            // Writing to a string cannot fail.
            let _ = write!(plain, "\\u{:04x}", u32::from(character));
        } else {
            plain.push(character);
        }
    }
    plain
}

/// Control characters but line ends and tabs, and marks that turn the direction of writing.
fn is_obeyed(character: char) -> bool {
    let turns = matches!(
        character,
        '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}'
    );
    turns || (character.is_control() && !matches!(character, '\n' | '\t'))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_obeyed() {
        let mut out = Vec::new();
        write!(Terminal(&mut out), "a\x1b[2J\u{9b}31m\u{202e}ü\t\n\r").unwrap();
        let text = String::from_utf8(out).unwrap();
        assert_eq!(text, "a\\u001b[2J\\u009b31m\\u202eü\t\n\\u000d");
    }

    #[test]
    fn json_reads_back() {
        let value = "\x1b \u{202e} \u{9b} \u{7f}";
        let mut out = Vec::new();
        write!(Terminal(&mut out), "{}", serde_json::to_string(value).unwrap()).unwrap();
        assert!(out.is_ascii());
        assert_eq!(serde_json::from_slice::<String>(&out).unwrap(), value);
    }

    #[test]
    fn quotes_and_errors_end() {
        let long = "x".repeat(1_000_000);
        let error =
            shown(&format!("data.csv:1: column `{long}`: found `\x1b`, expected one of {long}"));
        assert!(
            error.starts_with(&format!("data.csv:1: column `{}…`: found `\\u001b`,", &long[..200]))
        );
        assert!(error.chars().count() < 4100);
    }
}
