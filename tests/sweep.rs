//! A sweep that is interrupted goes on where it stopped.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

fn sweep(output: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_helixlock"));
    command
        .args(["sweep", "examples/sg7430-6mm/machine.toml", "--length", "0.5", "--seed", "3"])
        .args(["--set", "drive.frequency=50..150:6 Hz", "--samples", "4"])
        .args(["--draw", "effect.0.amplitude=0.5..2 um", "--output"])
        .arg(output)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    command
}

/// Killed after a few cases and started again, it leaves the same bytes as one that ran through.
#[test]
fn an_interrupted_sweep_repeats_and_loses_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let [whole, resumed] = ["whole.csv", "resumed.csv"].map(|name| folder.path().join(name));
    assert!(sweep(&whole).status().unwrap().success());
    let mut running = sweep(&resumed).spawn().unwrap();
    let journal = folder.path().join("resumed.csv.journal");
    while running.try_wait().unwrap().is_none() {
        if fs::read_to_string(&journal).is_ok_and(|text| 4 < text.lines().count()) {
            running.kill().unwrap();
            running.wait().unwrap();
        }
    }
    assert!(sweep(&resumed).status().unwrap().success());
    let text = fs::read_to_string(&whole).unwrap();
    assert_eq!(fs::read_to_string(&resumed).unwrap(), text);
    assert_eq!(text.lines().count(), 25, "a header and 24 cases");
    assert!(text.starts_with("case,drive.frequency_hz,effect.0.amplitude_um,open_periodic_um"));
    // A finished sweep is not run again, and the same command writes the same file.
    let again = sweep(&resumed).output().unwrap();
    let said = String::from_utf8(again.stdout).unwrap();
    assert!(said.contains("24 cases, 0 of them run now"), "{said}");
    assert_eq!(fs::read_to_string(&resumed).unwrap(), text);
}

/// Two sweeps of one output do not do the work twice.
#[test]
fn another_sweep_of_the_same_output_waits_for_nobody() {
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path().join("out.csv");
    let mut first = sweep(&output).spawn().unwrap();
    let journal = folder.path().join("out.csv.journal");
    while !fs::read_to_string(&journal).is_ok_and(|text| !text.is_empty()) {
        assert!(first.try_wait().unwrap().is_none(), "it ended without a journal");
    }
    let second = sweep(&output).output().unwrap();
    let said = String::from_utf8(second.stderr).unwrap();
    assert!(first.wait().unwrap().success());
    assert!(
        second.status.code() == Some(2) && said.contains("another sweep is writing it"),
        "{said}"
    );
}

/// A value that makes no machine is told with its case; the others are there.
#[test]
fn a_case_that_cannot_be_run_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path().join("out.parquet");
    let failing = || {
        Command::new(env!("CARGO_BIN_EXE_helixlock"))
            .args(["sweep", "examples/sg7430-6mm/machine.toml", "--length", "0.5"])
            .args(["--set", "dividers.b=150,1000", "--output"])
            .arg(&output)
            .output()
            .unwrap()
    };
    let run = failing();
    assert_eq!(run.status.code(), Some(1));
    let again = failing();
    assert_eq!((again.status.code(), again.stderr), (Some(1), run.stderr));
    assert!(
        String::from_utf8(again.stdout).unwrap().contains("case 1:"),
        "told again, not run again"
    );
    let text = String::from_utf8(run.stdout).unwrap();
    assert!(text.contains("case 1:") && text.contains("999"), "{text}");
    let table = helixlock_traces::read_table(&output).unwrap();
    assert_eq!(table.column("dividers.b"), Some(&[150.0, 1000.0][..]));
    let total = table.column("closed_total_um").unwrap();
    assert!(total[0].is_finite() && total[1].is_nan());
}
