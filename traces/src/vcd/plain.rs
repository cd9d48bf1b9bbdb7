//! Declarations from any producer, in the words of IEEE 1364.
//!
//! SystemVerilog and VHDL bring other kinds of scopes and variables, GTKWave commands of its
//! own, sigrok names with blanks. The kinds matter little here; the lines stay where they are.

use ::vcd::VarType;

/// Stands for a blank inside a name, which the parser would take for its end.
const BLANK: char = '\u{a0}';

const SCOPES: &[&[u8]] = &[b"module", b"task", b"function", b"begin", b"fork"];
const REAL: &[&[u8]] = &[b"shortreal", b"realtime", b"real_parameter"];
const COMMANDS: &[&[u8]] = &[
    b"$comment",
    b"$date",
    b"$version",
    b"$timescale",
    b"$scope",
    b"$upscope",
    b"$var",
    b"$enddefinitions",
];

/// A name as the producer wrote it.
pub(super) fn with_blanks(name: &str) -> String {
    name.replace(BLANK, " ")
}

/// The declarations in standard words.
pub(super) fn plain(text: &[u8]) -> Vec<u8> {
    let mut rewriting = Rewriting::default();
    rewriting.plain.reserve(text.len());
    for word in text.split_inclusive(u8::is_ascii_whitespace) {
        let (bare, space) = word.split_at(word.trim_ascii_end().len());
        if !bare.is_empty() {
            rewriting.take(bare);
        }
        rewriting.space.extend_from_slice(space);
    }
    rewriting.plain.extend_from_slice(&rewriting.space);
    rewriting.plain
}

/// Where the rewriting stands.
#[derive(Default)]
struct Rewriting<'a> {
    plain: Vec<u8>,
    /// The command whose words come, up to its `$end`; empty between commands.
    command: &'a [u8],
    /// Words since then.
    words: usize,
    /// White space not written yet.
    space: Vec<u8>,
    /// Line ends inside a name, to be made good after it.
    lines_owed: usize,
    /// The words of a range have begun.
    in_range: bool,
}

impl<'a> Rewriting<'a> {
    fn take(&mut self, word: &'a [u8]) {
        if self.command.is_empty() {
            let known = COMMANDS.contains(&word) || !word.starts_with(b"$");
            self.write(if known { word } else { b"$comment" });
            if word.starts_with(b"$") {
                (self.command, self.words, self.in_range) = (word, 0, false);
            }
            return;
        }
        self.words += 1;
        if word.ends_with(b"$end") {
            self.write(word);
            self.plain.extend(std::iter::repeat_n(b'\n', self.lines_owed));
            (self.command, self.lines_owed) = (b"", 0);
            return;
        }
        match (self.command, self.words) {
            (b"$scope", 1) if !SCOPES.contains(&word) => self.write(b"module"),
            (b"$scope", 3..) => self.join(word, true),
            (b"$var", 1) => self.write(standard_variable(word)),
            (b"$var", 5..) => self.take_later_name(word),
            _ => self.write(word),
        }
    }

    /// More words of a variable's name, or its range.
    fn take_later_name(&mut self, word: &'a [u8]) {
        if self.in_range {
            self.join(word, false);
        } else if word.starts_with(b"[") {
            self.in_range = true;
            self.write(word);
        } else {
            self.join(word, true);
        }
    }

    fn write(&mut self, word: &[u8]) {
        self.plain.append(&mut self.space);
        self.plain.extend_from_slice(word);
    }

    /// Ties a word to the one before.
    fn join(&mut self, word: &[u8], blank: bool) {
        self.lines_owed += self.space.split(|byte| *byte == b'\n').count() - 1;
        self.space.clear();
        if blank {
            self.plain.extend_from_slice(BLANK.encode_utf8(&mut [0; 4]).as_bytes());
        }
        self.plain.extend_from_slice(word);
    }
}

fn standard_variable(kind: &[u8]) -> &[u8] {
    let known = std::str::from_utf8(kind).is_ok_and(|kind| kind.parse::<VarType>().is_ok());
    if REAL.contains(&kind) {
        b"real"
    } else if known {
        kind
    } else {
        b"wire"
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rewritten(text: &str) -> String {
        with_blanks(&String::from_utf8(plain(text.as_bytes())).unwrap())
    }

    #[test]
    fn standard_declarations_stay_as_they_are() {
        let text = "$date\n  today, 1 $ $end\n$timescale 1ns $end\n$scope module top $end\n\
                    $var wire 1 $ a $end\n$var wire 8 $x b [7:0] $end\n$upscope $end\n";
        assert_eq!(rewritten(text), text);
    }

    #[test]
    fn other_words_are_replaced_and_lines_stay() {
        assert_eq!(
            rewritten(
                "$attrbegin misc \"\" 1 $end\n$scope interface bus $end\n$var logic 1 $ STEP\n(Y axis) $end\n"
            ),
            "$comment misc \"\" 1 $end\n$scope module bus $end\n$var wire 1 $ STEP (Y axis) $end\n\n"
        );
        assert_eq!(rewritten("$var reg 8 ! b [ 7 : 0 ] $end"), "$var reg 8 ! b [7:0] $end");
    }
}
