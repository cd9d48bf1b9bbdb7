//! Reads dumps change by change, however long they are.

use std::collections::BTreeMap;
use std::io::{self, BufRead, Cursor, Read};
use std::path::{Path, PathBuf};

use ::vcd::{Command, IdCode, ParseError, ParseErrorKind, Parser};

use crate::error::{At, TraceError};
use crate::vcd::header::{Header, read_header};
use crate::vcd::{Bit, Tick};

/// A variable of a dump.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Signal {
    /// Scopes and name joined by dots.
    pub path: String,
    /// Number of bits.
    pub width: u32,
    /// It is a real number.
    pub real: bool,
    /// What its changes are filed under; names for one and the same net share it.
    pub channel: usize,
}

/// A value as it stands in the dump.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// One bit.
    Bit(Bit),
    /// Several bits, the most significant first, without those the producer left out.
    Vector(Vec<Bit>),
    /// A real number.
    Real(f64),
    /// Text, as some producers write for states.
    Text(String),
}

/// A channel takes a value.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// When, in ticks.
    pub ticks: u64,
    /// Which, see [`Signal::channel`].
    pub channel: usize,
    /// What it is from then on.
    pub value: Value,
}

type Body<R> = io::Chain<io::Chain<Cursor<Vec<u8>>, R>, &'static [u8]>;

/// The changes of a dump, in the order of the file.
///
/// Takes what sigrok, Icarus, Verilator and other producers write: kinds of scopes and variables
/// beyond the standard, aliases, a last line without its end.
pub struct VcdReader<R> {
    path: PathBuf,
    tick: Tick,
    signals: Vec<Signal>,
    channels: BTreeMap<IdCode, usize>,
    parser: Parser<Body<R>>,
    header_lines: usize,
    ticks: u64,
    finished: bool,
}

impl<R: BufRead> VcdReader<R> {
    /// Reads the declarations; `path` is for messages only.
    ///
    /// # Errors
    ///
    /// Declarations that break the format, or end before `$enddefinitions`, or lack a unit of
    /// time, with their line.
    pub fn new(mut reader: R, path: &Path) -> Result<Self, TraceError> {
        let Header { tick, signals, channels, lines, rest } = read_header(&mut reader, path)?;
        // Some producers leave out the last line end, which the parser needs.
        let body = Cursor::new(rest).chain(reader).chain(b"\n".as_slice());
        Ok(Self {
            path: path.to_owned(),
            tick,
            signals,
            channels,
            parser: Parser::new(body),
            header_lines: lines,
            ticks: 0,
            finished: false,
        })
    }

    /// Unit of time.
    pub fn tick(&self) -> Tick {
        self.tick
    }

    /// Variables, in the order of their declarations.
    pub fn signals(&self) -> &[Signal] {
        &self.signals
    }

    /// Time of the last `#` line read, in ticks; the end of the record once all is read.
    pub fn ticks(&self) -> u64 {
        self.ticks
    }

    fn refuse(&self, found: String, expected: &'static str) -> TraceError {
        TraceError::Dump { at: At::file(&self.path).on_line(self.line()), found, expected }
    }

    fn line(&self) -> usize {
        // Line 1 of the body is the last line of the header.
        self.header_lines.saturating_add(line_number(self.parser.line())).saturating_sub(1)
    }

    fn change(&self, code: IdCode, value: Value) -> Result<Change, TraceError> {
        match self.channels.get(&code) {
            Some(channel) => Ok(Change { ticks: self.ticks, channel: *channel, value }),
            None => Err(self.refuse(format!("code `{code}`"), "a code that `$var` declares")),
        }
    }

    /// What one command says: a change, or nothing to pass on.
    fn take(&mut self, command: Command) -> Result<Option<Change>, TraceError> {
        match command {
            Command::Timestamp(ticks) if ticks < self.ticks => {
                let found = format!("time {ticks} after {}", self.ticks);
                Err(self.refuse(found, "times that do not go back"))
            }
            Command::Timestamp(ticks) => {
                self.ticks = ticks;
                Ok(None)
            }
            Command::ChangeScalar(code, bit) => self.change(code, Value::Bit(bit)).map(Some),
            Command::ChangeVector(code, bits) => {
                self.change(code, Value::Vector(bits.iter().collect())).map(Some)
            }
            Command::ChangeReal(code, number) => self.change(code, Value::Real(number)).map(Some),
            Command::ChangeString(code, text) => self.change(code, Value::Text(text)).map(Some),
            Command::Begin(_) | Command::End(_) | Command::Comment(_) => Ok(None),
            other => Err(self.refuse(declaration(&other), "changes after `$enddefinitions`")),
        }
    }
}

impl<R: BufRead> Iterator for VcdReader<R> {
    type Item = Result<Change, TraceError>;

    /// The next change; after an error there is none.
    fn next(&mut self) -> Option<Self::Item> {
        while !self.finished {
            let change = match self.parser.next() {
                None => break,
                Some(Ok(command)) => self.take(command),
                Some(Err(error)) => Err(dump_error(&error, &self.path, self.line())),
            };
            self.finished = change.is_err();
            if let Some(change) = change.transpose() {
                return Some(change);
            }
        }
        None
    }
}

impl<R> std::fmt::Debug for VcdReader<R> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("VcdReader").field("path", &self.path).finish_non_exhaustive()
    }
}

/// A declaration by its first word.
fn declaration(command: &Command) -> String {
    let word = match command {
        Command::Date(_) => "date",
        Command::Version(_) => "version",
        Command::Timescale(..) => "timescale",
        Command::ScopeDef(..) => "scope",
        Command::Upscope => "upscope",
        Command::VarDef(..) => "var",
        _ => "enddefinitions",
    };
    format!("`${word}`")
}

/// What the parser said, as an error of ours.
pub(super) fn dump_error(error: &io::Error, path: &Path, line: usize) -> TraceError {
    match error.get_ref().and_then(|inner| inner.downcast_ref::<ParseError>()) {
        Some(parse) => {
            let (found, expected) = broken(parse.kind());
            TraceError::Dump { at: At::file(path).on_line(line), found: found.into(), expected }
        }
        None if error.kind() == io::ErrorKind::UnexpectedEof => TraceError::Dump {
            at: At::file(path),
            found: "the end of the file".into(),
            expected: "the rest of its last line",
        },
        None => TraceError::Read {
            path: path.to_owned(),
            source: io::Error::new(error.kind(), error.to_string()),
        },
    }
}

/// What the parser found, and what belongs there.
fn broken(kind: &ParseErrorKind) -> (&'static str, &'static str) {
    use ParseErrorKind as Kind;
    match kind {
        Kind::InvalidUtf8 => ("bytes that are no text", "UTF-8"),
        Kind::TokenTooLong => ("a word that is too long", "a word of IEEE 1364"),
        Kind::ExpectedEndCommand => ("a word too many", "`$end`"),
        Kind::UnmatchedEnd => ("`$end`", "a command before it"),
        Kind::UnknownCommand => ("an unknown command", "a command of IEEE 1364"),
        Kind::UnexpectedHeaderCommand => ("a change", "declarations"),
        Kind::ParseIntError(_) => ("something else", "a whole number of at most 64 bits"),
        Kind::ParseFloatError(_) => ("something else", "a real number after `r`"),
        Kind::InvalidTimescaleUnit(_) => ("an unknown unit of time", "s, ms, us, ns, ps or fs"),
        Kind::InvalidScopeType(_) => ("something else", "a kind of scope such as `module`"),
        Kind::InvalidVarType(_) => ("something else", "a kind of variable such as `wire`"),
        Kind::InvalidReferenceIndex(_) => ("a broken range", "a range such as `[7:0]`"),
        Kind::InvalidValueChar(_) => ("an unknown level", "0, 1, x or z"),
        Kind::InvalidIdCode(_) => ("a broken code", "a code of a few printable characters"),
        _ => ("an unexpected character", "a time, a change, or a command"),
    }
}

pub(super) fn line_number(line: u64) -> usize {
    usize::try_from(line).unwrap_or(usize::MAX)
}

#[cfg(test)]
mod tests;
