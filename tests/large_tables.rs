//! Memory that a large table takes: what is held a row, held to account.

use std::fmt::Write as _;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

use helixlock_lab::Verdict;
use serde_json::Value;

use crate::support::command::{helixlock, put, repository, scratch, word};
use crate::support::diagnosed::diagnosed;
use crate::support::passes::white;
use crate::support::seeds::cases;

/// Something like noise between 0 and 1.
fn scatter(row: i32) -> f64 {
    let noise = libm::sin(12.9898 * f64::from(row)) * 43_758.545_3;
    noise - libm::floor(noise)
}

/// A wave over 100 m of travel and something like noise.
fn table() -> String {
    let mut text = "position_mm,error_um\n".to_owned();
    for row in 0..1_000_000 {
        let wave = 0.5 * libm::sin(std::f64::consts::TAU * f64::from(row) / 60_000.0);
        let error_um = wave + 0.2 * scatter(row);
        writeln!(text, "{:.4},{error_um:.4}", f64::from(row) / 10_000.0).expect("text takes text");
    }
    text
}

/// The most memory that a process held so far, MB; nothing of one that has ended.
fn held_mb(child: &Child) -> Option<f64> {
    let status = std::fs::read_to_string(format!("/proc/{}/status", child.id())).ok()?;
    let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kib: f64 = peak.trim().trim_end_matches(" kB").parse().ok()?;
    Some(kib * 1.024e-3)
}

/// The most memory that a command on the table ever held, MB.
fn most_mb(command: &str, data: &str) -> f64 {
    let mut child = Command::new(env!("CARGO_BIN_EXE_helixlock"))
        .args([command, "templates/screw-axis.toml", data])
        .current_dir(repository())
        .stdout(Stdio::null())
        .spawn()
        .expect("the command starts");
    let mut most: f64 = 0.0;
    while child.try_wait().expect("it can be waited for").is_none() {
        most = most.max(held_mb(&child).unwrap_or(0.0));
        sleep(Duration::from_millis(2));
    }
    most
}

/// Five million rows take five times as much; docs/performance.md states that.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_million_rows_are_held_in_a_third_of_a_gigabyte() {
    let folder = scratch();
    let (path, data) = word(&folder, "large.csv");
    put(&path, &table());
    for (command, bound_mb) in cases(1, &[("compare", 330.0), ("diagnose", 360.0)]) {
        let most = most_mb(command, &data);
        assert!(0.0 < most && most < *bound_mb, "{command}: {most} MB");
    }
}

/// A motor that shakes a long log by a seventh of its noise, three rows a wave, is not in means of neighbours, and in
/// one row of three not beyond chance.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_swift_wave_in_many_rows_gets_no_all_clear() {
    let mut noise = white(8, 0.5);
    let mut columns = [const { Vec::new() }; 3];
    for row in 0..20_000 {
        let time_s = 0.0187 * f64::from(row);
        let error_um = 0.07 * libm::sin(std::f64::consts::TAU * 17.6 * time_s) + noise();
        let cells = [time_s, 4.0 * time_s, error_um];
        columns.iter_mut().zip(cells).for_each(|(column, cell)| column.push(cell));
    }
    let names = ["time_s", "position_mm", "error_um"];
    let found = diagnosed(names.into_iter().zip(columns).collect());
    assert_eq!(found.verdict, Verdict::Unexplained, "{:?}", found.residual);
}

/// Means of neighbours, which are searched, scatter less than the samples of which a user reads.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn what_was_tried_is_told_with_the_scatter_of_the_samples() {
    let folder = scratch();
    let (path, data) = word(&folder, "waves.csv");
    let mut text = "position_mm,error_um\n".to_owned();
    for row in 0..30_000 {
        let position_mm = 0.01 * f64::from(row);
        let wave_um = 0.5 * libm::sin(std::f64::consts::TAU * position_mm / 5.0);
        let error_um = wave_um + 0.4 * scatter(row);
        writeln!(text, "{position_mm:.2},{error_um:.4}").expect("text takes text");
    }
    put(&path, &text);
    let run = helixlock(&["diagnose", "templates/screw-axis.toml", &data, "--json"]);
    let answer: Value = serde_json::from_str(&run.stdout).expect("JSON");
    let noise_um = answer["noise_um"].as_f64().expect("a number");
    let best = &answer["candidates"][0];
    assert_eq!((&best["effect"], &best["accepted"]), (&"screw-periodic".into(), &true.into()));
    let rms_um = best["rms_um"].as_f64().expect("a number");
    assert!((rms_um / noise_um - 1.0).abs() < 0.01, "{rms_um} of {noise_um} µm");
}
