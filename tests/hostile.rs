//! Hostile inputs, made by a program: whatever comes, the command ends with an answer or a refusal.
//!
//! Every case runs in a folder of its own with 10 s of processor time and 3 GB of addresses. It fails
//! with a panic (101), an abort (134), a signal, a limit that is hit, an error without a message, a
//! message without end, an escape sequence on the terminal, or an answer where there is none.
//! The test runs every eleventh case; `HELIXLOCK_HOSTILE=all` runs them all, and prints what each
//! took: `HELIXLOCK_HOSTILE=all cargo test --test integration hostile -- --nocapture`.

mod binaries;
mod dumps;
mod machines;
mod tables;
mod words;

use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{Command, Output};
use std::time::Instant;

use crate::support::command::{repository, scratch};

/// Processor time of a run, s.
const LONGEST_S: u32 = 10;
/// Addresses of a run, kB; 2 GB of memory and what threads and libraries reserve.
const MOST_KB: u32 = 3_000_000;
/// Longest message, bytes.
const LONGEST_MESSAGE: usize = 20_000;

/// What a run must come to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Wanted {
    /// Exit status 2 with a message, and nothing on standard output.
    Refused,
    /// That, or an answer.
    Anything,
}

/// One hostile input.
struct Case {
    name: String,
    /// Files to make, `machine.toml` of the example beside them.
    files: Vec<(&'static str, Vec<u8>)>,
    /// Words of the command.
    words: Vec<String>,
    wanted: Wanted,
}

impl Case {
    fn new(
        name: impl Into<String>,
        files: Vec<(&'static str, Vec<u8>)>,
        words: &[&str],
        wanted: Wanted,
    ) -> Self {
        let words = words.iter().map(|word| (*word).to_owned()).collect();
        Self { name: name.into(), files, words, wanted }
    }
}

fn cases() -> Vec<Case> {
    [tables::cases(), dumps::cases(), machines::cases(), binaries::cases(), words::cases()]
        .into_iter()
        .flatten()
        .collect()
}

/// Pieces of a text in a row.
fn text(pieces: impl Iterator<Item = String>) -> String {
    pieces.collect::<Vec<_>>().concat()
}

/// A table of a screw with an error, for commands whose other input is hostile.
fn good_table() -> Vec<u8> {
    let rows = text((0..400).map(|i| format!("{i},{}\n", f64::from(i % 7) / 8.0)));
    format!("position_mm,error_um\n{rows}").into_bytes()
}

/// Two trains at 2 : 1.
fn good_pulses() -> Vec<u8> {
    let row = |i| format!("{},{}\n", 0.001 * f64::from(i), 0.002 * f64::from(i));
    let rows = text((0..4000).map(row));
    format!("input_s,output_s\n{rows}").into_bytes()
}

fn good_machine() -> String {
    let path = repository().join("examples/sg7430-6mm/machine.toml");
    std::fs::read_to_string(path).expect("the example is there")
}

/// Writes bytes for a case.
#[expect(clippy::disallowed_methods, reason = "a test makes its own input, in its own folder")]
fn put(path: &Path, bytes: &[u8]) {
    std::fs::write(path, bytes).expect("the folder of the test takes files");
}

fn run(case: &Case) -> Output {
    let folder = scratch();
    put(&folder.path().join("machine.toml"), good_machine().as_bytes());
    put(&folder.path().join("good.csv"), &good_table());
    put(&folder.path().join("pulses.csv"), &good_pulses());
    for (name, bytes) in &case.files {
        put(&folder.path().join(name), bytes);
    }
    let limited = format!("ulimit -c 0 -t {LONGEST_S} -v {MOST_KB}; exec \"$0\" \"$@\"");
    let mut command = Command::new("bash");
    command.args(["-c", &limited, env!("CARGO_BIN_EXE_helixlock")]).args(&case.words);
    command.current_dir(folder.path()).output().expect("bash is there")
}

/// What is wrong with the end of a run, if anything.
fn fault(case: &Case, run: &Output) -> Option<String> {
    let (out, error) = (&run.stdout, String::from_utf8_lossy(&run.stderr));
    let beginning: String = error.chars().take(300).collect();
    let at_fault = match (run.status.code(), run.status.signal()) {
        (_, Some(signal)) => Some(format!("ended by signal {signal}")),
        (Some(0 | 1), _) if case.wanted == Wanted::Refused => Some("answered".into()),
        (Some(2), _) if error.is_empty() => Some("refused without a word".into()),
        (Some(2), _) if !out.is_empty() => Some("refused with an answer".into()),
        (Some(0..=2), _) => None,
        (code, _) => Some(format!("exit status {code:?}")),
    };
    let escapes = |bytes: &[u8]| {
        bytes.contains(&0x1b)
            || bytes.windows(2).any(|w| w[0] == 0xc2 && (0x80..0xa0).contains(&w[1]))
    };
    let shown = if LONGEST_MESSAGE < run.stderr.len() {
        Some("a message without end")
    } else if escapes(&run.stderr) || escapes(out) {
        Some("an escape sequence for the terminal")
    } else if error.contains("panicked") {
        Some("a panic")
    } else {
        None
    };
    at_fault
        .or_else(|| shown.map(Into::into))
        .map(|fault| format!("{}: {fault}: {beginning}", case.name))
}

#[test]
#[expect(clippy::print_stdout, reason = "asked for all, it says what each took")]
fn whatever_comes_the_command_ends_with_an_answer_or_a_refusal() {
    let all = std::env::var("HELIXLOCK_HOSTILE").is_ok();
    let cases = cases();
    assert!(300 <= cases.len(), "{} cases", cases.len());
    let mut faults = Vec::new();
    for case in cases.iter().step_by(if all { 1 } else { 11 }) {
        let begun = Instant::now();
        let run = run(case);
        if all {
            println!(
                "{:?} {:.1} s {}",
                run.status.code(),
                begun.elapsed().as_secs_f64(),
                case.name
            );
        }
        faults.extend(fault(case, &run));
    }
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}
