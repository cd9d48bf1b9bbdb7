//! The declarations of a dump, from any producer.

use std::collections::BTreeMap;
use std::io::BufRead;
use std::path::Path;

use ::vcd::{Command, IdCode, Parser, VarType};

use crate::error::{At, TraceError};
use crate::vcd::Tick;
use crate::vcd::plain::{plain, with_blanks};
use crate::vcd::reader::{Signal, dump_error, line_number};

/// Deepest nesting of scopes; designs have some ten.
const MOST_SCOPES: usize = 256;
/// Most signals; an analyser has some sixteen, a large design some ten thousand.
const MOST_SIGNALS: usize = 200_000;
/// Most bytes of all their paths.
const MOST_LETTERS: usize = 64 << 20;

/// What stands before `$enddefinitions`.
pub(super) struct Header {
    pub(super) tick: Tick,
    pub(super) signals: Vec<Signal>,
    /// The channel that a code stands for; two names with one code share a channel.
    pub(super) channels: BTreeMap<IdCode, usize>,
    /// Lines of the header, and what follows its end on the last of them.
    pub(super) lines: usize,
    pub(super) rest: Vec<u8>,
}

/// Reads the declarations and leaves the reader behind them.
pub(super) fn read_header(reader: &mut impl BufRead, file: &Path) -> Result<Header, TraceError> {
    let HeaderText { text, rest, lines } = header_text(reader, file)?;
    let mut header = Header {
        tick: Tick::NANOSECOND,
        signals: Vec::new(),
        channels: BTreeMap::new(),
        lines,
        rest,
    };
    let (mut scopes, mut has_tick, mut letters) = (Vec::new(), false, 0);
    let mut plain = plain(&text);
    plain.push(b'\n'); // the parser wants every word ended
    let mut parser = Parser::new(plain.as_slice());
    while let Some(command) = parser.next() {
        match command.map_err(|error| dump_error(&error, file, line_number(parser.line())))? {
            Command::ScopeDef(..) if scopes.len() == MOST_SCOPES => {
                return Err(too_many(
                    file,
                    line_number(parser.line()),
                    MOST_SCOPES,
                    "scopes inside one another",
                ));
            }
            Command::ScopeDef(_, name) => scopes.push(name),
            Command::Upscope => drop(scopes.pop()),
            Command::Timescale(count, unit) => {
                header.tick = Tick { count, unit };
                has_tick = count > 0;
            }
            Command::VarDef(kind, width, code, name, index) => {
                let name = match index {
                    Some(index) if width == 1 => format!("{name}{index}"),
                    _ => without_range(name),
                };
                let next = header.channels.len();
                let channel = *header.channels.entry(code).or_insert(next);
                let path = scopes.iter().chain([&name]).cloned().collect::<Vec<_>>().join(".");
                let path = with_blanks(&path);
                letters += path.len();
                if MOST_SIGNALS == header.signals.len() || MOST_LETTERS < letters {
                    return Err(too_many(
                        file,
                        line_number(parser.line()),
                        MOST_SIGNALS,
                        "signals",
                    ));
                }
                header.signals.push(Signal { path, width, real: kind == VarType::Real, channel });
            }
            _ => {}
        }
    }
    if has_tick { Ok(header) } else { Err(no_tick(file, lines)) }
}

fn too_many(path: &Path, line: usize, most: usize, what: &'static str) -> TraceError {
    TraceError::TooMany { at: At::file(path).on_line(line), most, what }
}

fn no_tick(path: &Path, lines: usize) -> TraceError {
    TraceError::Dump {
        at: At::file(path).on_line(lines),
        found: "the end of the declarations without a unit of time".into(),
        expected: "`$timescale` before it",
    }
}

/// `data[7:0]` is called `data`, as by those who set the range apart; `data[3]` keeps its index.
fn without_range(mut name: String) -> String {
    let range = name.rfind('[').filter(|at| *at > 0 && name[*at..].contains(':'));
    name.truncate(range.unwrap_or(name.len()));
    name
}

struct HeaderText {
    /// Up to the end of `$enddefinitions $end`.
    text: Vec<u8>,
    /// What follows on the last line.
    rest: Vec<u8>,
    /// Number of the last line.
    lines: usize,
}

/// Cuts the declarations off, which the end of a line need not do.
fn header_text(reader: &mut impl BufRead, path: &Path) -> Result<HeaderText, TraceError> {
    const LAST: &[u8] = b"$enddefinitions";
    let (mut text, mut lines, mut searched, mut begun) = (Vec::new(), 0, 0, false);
    loop {
        let read = reader
            .read_until(b'\n', &mut text)
            .map_err(|source| TraceError::Read { path: path.to_owned(), source })?;
        lines += 1;
        if lines == 1 && text.starts_with(b"META ") {
            // sigrok-cli puts this before a dump that it made from another one.
            text = b"\n".to_vec();
        }
        let first = if begun { None } else { text[searched..].trim_ascii_start().first() };
        begun |= first.is_some();
        if first.is_some_and(|first| *first != b'$') {
            return Err(TraceError::Dump {
                at: At::file(path).on_line(lines),
                found: "text".into(),
                expected: "a value change dump, which begins with `$`",
            });
        }
        if read == 0 {
            return Err(TraceError::Dump {
                at: At::file(path).on_line(lines),
                found: "the end of the file".into(),
                expected: "`$enddefinitions` before it",
            });
        }
        if let Some(last) = find(&text[searched..], LAST) {
            searched += last;
            let behind = searched + LAST.len();
            if let Some(end) = find(&text[behind..], b"$end") {
                let rest = text.split_off(behind + end + b"$end".len());
                return Ok(HeaderText { text, rest, lines });
            }
        } else {
            searched = text.len().saturating_sub(LAST.len());
        }
    }
}

fn find(text: &[u8], word: &[u8]) -> Option<usize> {
    text.windows(word.len()).position(|window| window == word)
}
