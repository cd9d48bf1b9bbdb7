//! `helixlock certify` keeps its bound on the examples, and says so.

use std::collections::BTreeSet;
use std::process::{Command, Output};

use serde_json::json;

use crate::support::command::scratch;

fn certify(words: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_helixlock"))
        .arg("certify")
        .args(words)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .expect("the command starts")
}

/// One clock at 12 MHz is 83.3 ns; the table moves 0.6 mm/s or less in all three.
#[test]
fn examples_keep_the_bound() {
    for example in ["sg7430-6mm", "sg7430-sixth-inch", "sg7430-half-pi-module"] {
        let machine = format!("examples/{example}/machine.toml");
        let output = certify(&[&machine, "--length", "20 mm", "--json"]);
        assert_eq!(output.status.code(), Some(0), "{example}: {output:?}");
        let certificate: serde_json::Value =
            serde_json::from_slice(&output.stdout).expect("JSON alone");
        assert_eq!(certificate["holds"], true, "{example}: {certificate}");
        let largest_s = certificate["largest_difference_s"].as_f64().expect("a number");
        assert!((40e-9..83.4e-9).contains(&largest_s), "{example}: {certificate}");
        let largest_um = certificate["largest_difference_um"].as_f64().expect("a number");
        assert!(largest_um < 1e-4, "{example}: {certificate}");
        for provoked in certificate["provoked_coincidences"].as_array().expect("two") {
            assert!(provoked.as_u64().expect("a count") > 100, "{example}: {certificate}");
        }
        let alike = certificate["closed_alike"].as_u64().expect("a count");
        let closed = certificate["closed_comparisons"].as_u64().expect("a count");
        assert!(closed / 2 < alike, "{example}: {certificate}");
    }
}

/// Every figure is there, alike with typical delays, and the hazards with it.
#[test]
fn figures_are_certified_gate_by_gate() {
    let words = ["examples/sg7430-6mm/machine.toml", "--length", "1 mm", "--json"];
    let output = certify(&[&words[..], &["--pulses", "300", "--spread", "2"]].concat());
    let certificate: serde_json::Value =
        serde_json::from_slice(&output.stdout).expect("JSON alone");
    let blocks = certificate["blocks"].as_array().expect("a list");
    assert_eq!(blocks.len(), 14, "{certificate}");
    for block in blocks {
        assert_eq!(block["different"], 0, "{block}");
        assert_eq!(block["pulses"], 300 + 2 * 30, "{block}");
    }
    assert_eq!(certificate["hazards"].as_array().map(Vec::len), Some(9), "{certificate}");
}

/// All figures joined keep their bound on a machine, loop open and loop closed, and their reset
/// counter knows where the motor is.
#[test]
fn the_whole_original_is_certified_gate_by_gate() {
    let words = ["examples/sg7430-6mm/machine.toml", "--length", "10 mm", "--gates", "--json"];
    let output = certify(&[&words[..], &["--pulses", "1", "--spread", "0"]].concat());
    let certificate: serde_json::Value =
        serde_json::from_slice(&output.stdout).expect("JSON alone");
    let whole = &certificate["whole_original"];
    assert_eq!(whole["holds"], true, "{whole}");
    assert_eq!(whole["reset_counter_off_by_steps"], 0, "{whole}");
    let number = |key: &str| whole[key].as_f64().expect("a number");
    // 63 comparisons a turn, less those of the phase selection; a closed loop that never steps shows
    // nothing.
    assert!(90.0 < number("comparisons") && 90.0 < number("closed_comparisons"), "{whole}");
    assert!(500.0 < number("closed_steps"), "{whole}");
    let largest_s = number("largest_difference_s");
    assert!(1e-9 < largest_s && largest_s < number("bound_s"), "{whole}");
}

/// So they do whatever the delays within the data sheets: at both limits and with those of the seeds
/// at which clock inputs of a 7472 lost directions.
#[test]
fn the_whole_original_keeps_its_bounds_whatever_the_delays() {
    let words = ["examples/sg7430-6mm/machine.toml", "--length", "10 mm", "--gates", "--json"];
    let spread = ["--pulses", "1", "--spread", "0", "--gates-spread", "4", "--seed", "1"];
    let output = certify(&[&words[..], &spread].concat());
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let certificate: serde_json::Value =
        serde_json::from_slice(&output.stdout).expect("JSON alone");
    let sets = certificate["whole_original_sets"].as_array().expect("a list");
    let names: Vec<_> = sets.iter().map(|set| (&set["delays"], &set["seed"])).collect();
    let drawn = (1..=4).map(|seed| (json!("drawn"), json!(seed)));
    let limits = ["shortest", "longest"].map(|delays| (json!(delays), json!(null)));
    let expected: Vec<_> = limits.into_iter().chain(drawn).collect();
    assert!(names.into_iter().eq(expected.iter().map(|(delays, seed)| (delays, seed))), "{sets:?}");
    let largest = |set: &serde_json::Value| set["largest_difference_s"].to_string();
    let different: BTreeSet<_> = sets.iter().map(largest).collect();
    assert_eq!(different.len(), sets.len(), "other delays differ otherwise: {sets:?}");
}

/// Every gate is in the waveform, and the motor's phases are among what moves.
#[test]
fn every_gate_has_its_waveform() {
    let folder = scratch();
    let path = folder.path().join("gates.vcd");
    let wave = path.to_str().expect("a path of letters");
    let words = ["examples/sg7430-6mm/machine.toml", "--length", "1 mm", "--gates"];
    let few = ["--pulses", "1", "--spread", "0", "--wave", wave];
    let output = certify(&[&words[..], &few].concat());
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let text = std::fs::read(&path).expect("the waveform");
    let mut reader = vcd::Parser::new(&text[..]);
    let header = reader.parse_header().expect("a head");
    let code = |wire: &str| header.find_var(&["device", wire]).expect(wire).code;
    let [phase, clear] = ["ring_a", "a_clear_bar"].map(code);
    let changes = reader.filter_map(|command| match command.expect("a command") {
        vcd::Command::ChangeScalar(code, _) => Some(code),
        _ => None,
    });
    let changes: Vec<_> = changes.collect();
    for wire in [phase, clear] {
        assert!(10 < changes.iter().filter(|code| **code == wire).count(), "{wire:?}");
    }
    assert!(50_000 < changes.len(), "{}", changes.len());
}

/// What is given of the flip-flops counts, and is said to be given. By hand: 80.3 ns of settling over
/// 10 ns is e^8.03 = 10^3.5; 0.2 ns · 12 MHz · 1900 fringes/s are 10^8.2 upsets a year.
#[test]
fn flip_flops_may_be_described() {
    let words = ["examples/sg7430-6mm/machine.toml", "--length", "1 mm", "--settling", "10"];
    let output = certify(&words);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(said.contains("10^-5 years (settling 10 ns given, window 0.2 ns assumed,"), "{said}");
    for wrong in ["0", "-1", "nan", "1e300", "x"] {
        let output = certify(&[words[0], "--settling", wrong]);
        assert_eq!(output.status.code(), Some(2), "{wrong}: {output:?}");
    }
}

#[test]
fn a_missing_file_is_said_by_name() {
    let output = certify(&["nowhere.toml"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("nowhere.toml"));
}
