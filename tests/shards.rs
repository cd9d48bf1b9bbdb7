//! Scores, faults and drawn delays in parts: joined, they are what one process writes and prints.

use std::fs;
use std::path::Path;

use crate::support::command::{Run, helixlock, scratch, word};

/// Runs the words whole and in three parts, one of them twice; compares files and what is printed.
///
/// `says` is the line from which a single run says what the table says.
fn parts_are_the_whole(words: &[&str], ending: &str, says: &str) {
    let folder = scratch();
    let place = |name: &str| word(&folder, name).1;
    let run = |more: &[&str]| -> Run {
        let run = helixlock(&[words, more].concat());
        assert!(run.status == 0, "{words:?} {more:?}: {}", run.stderr);
        run
    };
    let whole = place(&format!("whole{ending}"));
    let alone = run(&["-o", &whole]);
    let parts = place("parts");
    for shard in ["3/3", "1/3", "2/3", "1/3"] {
        run(&["--shard", shard, "-o", &parts]);
    }
    let merged = place(&format!("merged{ending}"));
    let joined = helixlock(&["merge", &parts, "-o", &merged]);
    assert_eq!(joined.status, 0, "{}", joined.stderr);
    let [merged, whole_bytes] = [&merged, &whole].map(|path| fs::read(path).expect("it is there"));
    assert_eq!(merged, whole_bytes, "{words:?}");
    assert_eq!(from(&joined.stdout, says), from(&alone.stdout, says), "{words:?}");
    let again = run(&["-o", &whole]);
    assert!(again.stdout.contains(", 0 of them run now"), "{}", again.stdout);
    assert!(Path::new(&format!("{whole}.journal")).exists(), "what goes on after an interruption");
}

/// The lines of a table from the one that begins so, to an empty line or the command that is next,
/// which only a run that has read the machine file can say.
fn from<'a>(text: &'a str, begin: &str) -> Vec<&'a str> {
    let lines = text.lines().skip_while(|line| !line.trim_start().starts_with(begin));
    let ends = |line: &&str| line.is_empty() || line.starts_with("next: ");
    let lines: Vec<&str> = lines.take_while(|line| !ends(line)).collect();
    assert!(2 < lines.len(), "{text}");
    lines
}

#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_score_in_parts_is_the_score() {
    let words = ["challenge", "--score", "3", "--seed", "38"];
    parts_are_the_whole(&words, ".parquet", "one effect");
}

#[test]
fn faults_in_parts_are_the_faults() {
    let folder = scratch();
    let machine = folder.path().join("machine.toml");
    let text = fs::read_to_string("examples/sg7430-6mm/machine.toml").unwrap();
    // Faster than the example, so that the test is short.
    let quick = text.replace("speed = \"6 rpm\"", "speed = \"15 rpm\"");
    assert_ne!(quick, text);
    crate::support::command::put(&machine, &quick);
    let words = ["faults", machine.to_str().unwrap(), "--instants", "1"];
    parts_are_the_whole(&words, ".csv", "+--");
}

#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn drawn_delays_in_parts_are_the_drawn_delays() {
    let machine = "examples/sg7430-6mm/machine.toml";
    let words = ["certify", machine, "--length", "1 mm", "--pulses", "200", "--spread", "4"];
    parts_are_the_whole(&words, ".csv", "figure ");
}

/// A part without a folder, more parts than cases, parts without a score.
#[test]
fn words_that_make_no_part_are_refused() {
    let folder = scratch();
    let parts = folder.path().join("parts");
    let parts = parts.to_str().unwrap();
    let machine = "examples/sg7430-6mm/machine.toml";
    for (words, said) in [
        (&["challenge", "--shard", "1/2", "-o", parts][..], "--score"),
        (&["challenge", "--score", "2", "--shard", "1/2"], "expected `-o DIR`"),
        (&["challenge", "--score", "2", "--shard", "1/3", "-o", parts], "3 parts of 2 challenges"),
        (&["challenge", "--score", "2", "--seed", "18446744073709551615"], "expected seeds up to"),
        (
            &["certify", machine, "--spread", "1", "--shard", "1/3", "-o", parts],
            "3 parts of 2 sets",
        ),
        (&["faults", machine, "--shard", "1/2"], "--output"),
    ] {
        let run = helixlock(words);
        assert!(run.status == 2 && run.stderr.contains(said), "{words:?}: {}", run.stderr);
        assert!(!Path::new(parts).exists(), "{words:?}");
    }
}
