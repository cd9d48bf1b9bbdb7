//! Odd values in good machine files: whatever a value is, the command ends, and never by a panic.
//!
//! Each value of an example in turn is left out, or made zero, negative, enormous, minute, empty or
//! of another kind: every twelfth of these for one example, and with `HELIXLOCK_ODD_MACHINES=all`
//! each of them for every example.

use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use crate::support::command::{put, repository, scratch};

/// The longest that a run of a millimetre may take; one takes a tenth of a second.
const LONGEST: Duration = Duration::from_secs(60);

/// What a number with a unit becomes.
const NUMBERS: [&str; 7] = ["0", "-1", "1e300", "-1e300", "1e-300", "nan", "9007199254740993"];

/// What a whole value becomes.
const VALUES: [&str; 8] = ["\"\"", "0", "-1", "1e300", "nan", "[]", "true", "9223372036854775807"];

/// The machine files to change, and one in how many of their changes is tried.
fn machines() -> (Vec<PathBuf>, usize) {
    let folder = repository().join("examples");
    if std::env::var("HELIXLOCK_ODD_MACHINES").is_err() {
        return (vec![folder.join("sg7430-6mm/machine.toml")], 12);
    }
    let entries = std::fs::read_dir(folder).expect("the examples are there");
    let paths = entries.map(|entry| entry.expect("it can be listed").path().join("machine.toml"));
    let mut machines: Vec<_> = paths.filter(|path| path.exists()).collect();
    machines.sort();
    (machines, 1)
}

/// The text with one line changed in every way.
fn variants(text: &str) -> Vec<String> {
    let lines: Vec<_> = text.lines().collect();
    let with = |index: usize, line: &str| {
        let mut lines = lines.clone();
        lines[index] = line;
        lines.join("\n") + "\n"
    };
    let mut variants = Vec::new();
    for (index, line) in lines.iter().enumerate() {
        let Some((key, value)) = line.split_once(" = ").filter(|_| !line.starts_with('#')) else {
            continue;
        };
        variants.push(with(index, ""));
        variants.extend(VALUES.iter().map(|odd| with(index, &format!("{key} = {odd}"))));
        let unit = value.trim_start_matches('"').split_once(' ');
        if let Some((_, unit)) = unit.filter(|_| value.starts_with('"')) {
            let odd = NUMBERS.iter().map(|number| format!("{key} = \"{number} {unit}"));
            variants.extend(odd.map(|line| with(index, &line)));
        }
    }
    variants
}

/// Exit status; none when it had to be stopped.
fn status(mut child: Child) -> Option<i32> {
    let begun = Instant::now();
    while begun.elapsed() < LONGEST {
        if let Some(status) = child.try_wait().expect("it can be asked") {
            return status.code();
        }
        std::thread::sleep(Duration::from_millis(2));
    }
    child.kill().expect("it can be stopped");
    child.wait().expect("it ends");
    None
}

/// Runs the command on a machine file in a folder of its own.
fn run(folder: &Path, words: &[&str]) -> (Option<i32>, String) {
    let said = folder.join("said.txt");
    let errors = std::fs::File::options().create(true).write(true).truncate(true).open(&said);
    let child = Command::new(env!("CARGO_BIN_EXE_helixlock"))
        .args(words)
        .current_dir(folder)
        .stdout(Stdio::null())
        .stderr(errors.expect("the folder takes a file"))
        .spawn()
        .expect("the command starts");
    let status = status(child);
    (status, std::fs::read_to_string(said).expect("it is text"))
}

#[test]
fn no_value_makes_the_command_panic_or_hang() {
    let mut runs = 0;
    let (machines, one_in) = machines();
    for machine in machines {
        let text = std::fs::read_to_string(&machine).expect("the example is there");
        for variant in variants(&text).into_iter().step_by(one_in) {
            let folder = scratch();
            put(&folder.path().join("machine.toml"), &variant);
            for words in [
                ["sim", "machine.toml", "--length", "1 mm", "-o", "out"].as_slice(),
                &["gen", "machine.toml", "-o", "gen"],
            ] {
                let (status, said) = run(folder.path(), words);
                let place = machine.display();
                let answered = matches!(status, Some(0..=2)) && !said.contains("panicked");
                assert!(answered, "{words:?} {status:?} {said}\n{place}:\n{variant}");
                assert_eq!(status == Some(0), said.is_empty(), "{words:?} {said}\n{variant}");
                runs += 1;
            }
        }
    }
    assert!(runs * one_in > 400, "{runs} runs, one in {one_in}");
}
