//! A writer that passes reports on in another language, line by line.

use std::io::{self, Write};

use super::choice::Language;

/// What a command prints its report to, and what knows the language of its pages.
pub(crate) trait Reporter: Write {
    /// Language of the pages.
    fn language(&self) -> Language;
}

/// Passes whole lines on in a language; the rest of a line waits for its end or for a `flush`.
pub(crate) struct Translated<W: Write> {
    out: W,
    language: Language,
    /// Lines are no report: they are passed on as they come, though pages have the language.
    is_data: bool,
    begun: Vec<u8>,
}

impl<W: Write> Translated<W> {
    pub(crate) fn new(out: W, language: Language) -> Self {
        Self { out, language, is_data: false, begun: Vec::new() }
    }

    /// The same for a command that prints data.
    pub(crate) fn of_data(out: W, language: Language) -> Self {
        Self { is_data: true, ..Self::new(out, language) }
    }

    fn pass_on(&mut self, bytes: usize) -> io::Result<()> {
        let lines: Vec<u8> = self.begun.drain(..bytes).collect();
        match str::from_utf8(&lines) {
            Ok(text) => self.out.write_all(self.language.of(text).as_bytes()),
            Err(_) => self.out.write_all(&lines),
        }
    }
}

impl<W: Write> Reporter for Translated<W> {
    fn language(&self) -> Language {
        self.language
    }
}

impl<W: Write> Write for Translated<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.is_data || self.language == Language::En {
            return self.out.write(bytes);
        }
        self.begun.extend_from_slice(bytes);
        if let Some(end) = self.begun.iter().rposition(|byte| *byte == b'\n') {
            self.pass_on(end + 1)?;
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.pass_on(self.begun.len())?;
        self.out.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_that_come_in_pieces_are_whole_and_a_question_does_not_wait() {
        let mut out = Vec::new();
        let mut translated = Translated::new(&mut out, Language::Zh);
        write!(translated, "left as ").unwrap();
        write!(translated, "noise: {:.4} µm rms\n\nwhich one [1 to {}]? ", 0.5, 2).unwrap();
        translated.flush().unwrap();
        assert_eq!(
            String::from_utf8(out).unwrap(),
            "剩余噪声：0.5000 µm 均方根\n\n选哪一个 [1 至 2]？"
        );
    }

    #[test]
    fn english_is_passed_on_byte_by_byte() {
        let mut out = Vec::new();
        let mut same = Translated::new(&mut out, Language::En);
        same.write_all(b"verdict: \xff").unwrap();
        assert_eq!(out, b"verdict: \xff");
    }
}
