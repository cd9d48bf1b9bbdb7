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
        second.status.code() == Some(2) && said.contains("another run is writing it"),
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

/// A key that is misspelt leaves nothing in the way of the right one.
#[test]
fn a_key_that_no_machine_has_is_refused_before_anything_is_written() {
    let folder = tempfile::tempdir().unwrap();
    for (key, expected) in [
        ("drive.frequenzy=80,160 Hz", "unknown key `frequenzy` in `drive`"),
        ("effect.9.amplitude=1,2 um", "there is no place `9`"),
        ("dividers.b=150", "`dividers.b` is varied twice"),
    ] {
        let run = Command::new(env!("CARGO_BIN_EXE_helixlock"))
            .args(["sweep", "examples/sg7430-6mm/machine.toml", "--length", "0.5"])
            .args(["--set", "dividers.b=1000,150", "--set", key, "--output"])
            .arg(folder.path().join("out.csv"))
            .output()
            .unwrap();
        let said = String::from_utf8(run.stderr).unwrap();
        assert!(run.status.code() == Some(2) && said.contains(expected), "{said}");
        assert!(run.stdout.is_empty(), "{key}");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0, "{key}");
    }
}

/// The sweep of `sweep`, part by part into a folder.
fn part(folder: &Path, number: usize) -> Command {
    let mut command = sweep(folder);
    command.arg("--shard").arg(format!("{number}/3"));
    command
}

fn merge(folder: &Path, output: &Path) -> std::process::Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_helixlock"));
    command.arg("merge").arg(folder).arg("-o").arg(output).output().expect("the command starts")
}

/// Workers side by side, one of them killed and begun anew by the Makefile of the example: the same
/// bytes as one process alone.
#[test]
fn parts_of_many_machines_make_the_file_of_one() {
    let folder = tempfile::tempdir().unwrap();
    let parts = folder.path().join("parts");
    let mut killed = part(&parts, 2).spawn().unwrap();
    while killed.try_wait().unwrap().is_none() {
        let journals =
            fs::read_dir(&parts).into_iter().flatten().map(|entry| entry.unwrap().path());
        let mut texts = journals.filter_map(|path| fs::read_to_string(path).ok());
        if texts.any(|text| 2 < text.lines().count()) {
            killed.kill().unwrap();
        }
    }
    let made = Command::new("make")
        .args(["-j", "3", "-C", "examples/many-machines", "PARTS=3"])
        .arg(format!("HELIXLOCK={}", env!("CARGO_BIN_EXE_helixlock")))
        .arg(format!("OUT={}", parts.display()))
        .output()
        .unwrap();
    assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));
    for name in ["whole.csv", "whole.parquet"] {
        let [whole, merged] =
            [name.to_owned(), format!("merged-{name}")].map(|name| folder.path().join(name));
        assert!(sweep(&whole).status().unwrap().success());
        assert_eq!(merge(&parts, &merged).status.code(), Some(0));
        assert_eq!(fs::read(&merged).unwrap(), fs::read(&whole).unwrap(), "{name}");
    }
    assert_eq!(
        fs::read(parts.join("cases.parquet")).unwrap(),
        fs::read(folder.path().join("whole.parquet")).unwrap()
    );
}

/// What is no whole sweep is told and leaves no file.
#[test]
fn parts_that_do_not_belong_together_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let (parts, output) = (folder.path().join("parts"), folder.path().join("all.csv"));
    let refused = |wanted: &str| {
        let run = merge(&parts, &output);
        let said = String::from_utf8(run.stderr).unwrap();
        assert!(run.status.code() == Some(2) && said.contains(wanted), "{said}");
        assert!(!output.exists(), "{wanted}");
    };
    assert!(part(&parts, 1).status().unwrap().success());
    refused("2 of 3 parts are missing: 2, 3");
    assert!(part(&parts, 3).status().unwrap().success());
    let other = part(&parts, 2).args(["--draw", "spindle.speed=5..6 rpm"]).status().unwrap();
    assert!(other.success());
    refused("are of two runs, expected one");
    let names: Vec<_> = fs::read_dir(&parts).unwrap().map(|entry| entry.unwrap().path()).collect();
    let part_of = |number: &str| {
        names.iter().find(|path| {
            let name = path.file_name().unwrap().to_str().unwrap();
            name.starts_with(number) && name.ends_with(".parquet")
        })
    };
    let (first, second) = (part_of("part-1-").unwrap(), part_of("part-2-").unwrap());
    fs::remove_file(second).unwrap();
    let name = first.file_name().unwrap().to_str().unwrap().replace("part-1-", "part-2-");
    fs::copy(first, parts.join(name)).unwrap();
    refused("does not hold the cases of part 2 of 3, expected 8 to 15");
}
