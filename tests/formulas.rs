//! `discover` and `add --formula` on files: what is proposed, what is not, what can be added.

use std::fmt::Write;
use std::fs;

use serde_json::Value;

use crate::support::command::{Run, few_samples, helixlock, put, scratch, word};

const EXAMPLE: [&str; 2] =
    ["examples/outside-the-catalogue/machine.toml", "examples/outside-the-catalogue/data.csv"];

fn json(run: &Run) -> Value {
    assert_eq!((run.status, run.stderr.as_str()), (0, ""));
    serde_json::from_str(&run.stdout).expect("JSON")
}

fn number(value: &Value) -> (f64, f64) {
    let of = |key: &str| value[key].as_f64().expect("a number");
    (of("value"), of("stderr"))
}

/// A rack of 41 mm and ±0.4 µm is proposed as such; with the proposal in the machine file nothing
/// is missing.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_rack_is_proposed_as_a_sawtooth() {
    let folder = scratch();
    let (_, new) = word(&folder, "new.toml");
    let found = json(&helixlock(&["discover", EXAMPLE[0], EXAMPLE[1], "--json", "-o", &new]));
    assert_eq!(found["verdict"], "explained-by-a-formula", "{found}");
    let proposal = &found["proposals"][0];
    assert_eq!(proposal["shape"], "sawtooth", "{proposal}");
    let (period, error) = number(&proposal["parameters"]["period_mm"]);
    assert!((period - 41.0).abs() < 2.0 * error + 0.005 * 41.0, "{period} ± {error}");
    let (size, error) = number(&proposal["parameters"]["size"]);
    assert!((size.abs() - 0.8).abs() < 2.0 * error + 0.005 * 0.8, "{size} ± {error}");
    let after = json(&helixlock(&["diagnose", &new, EXAMPLE[1], "--json"]));
    assert_eq!(after["verdict"], "nothing-missing", "{after}");
}

/// What is explained by a name stays so, and nothing is written.
#[test]
fn where_a_name_explains_no_formula_is_proposed() {
    let folder = scratch();
    let (path, new) = word(&folder, "new.toml");
    let data = few_samples(folder.path(), "hidden-gear", 4);
    let files = ["examples/hidden-gear/machine.toml", &data];
    let run = helixlock(&["discover", files[0], files[1], "-o", &new]);
    assert_eq!((run.status, run.stderr.as_str()), (1, ""));
    assert!(run.stdout.starts_with("verdict: explained-by-name\n"), "{}", run.stdout);
    let next = format!("\nnext: helixlock diagnose {} {}\n", files[0], files[1]);
    assert!(run.stdout.ends_with(&next), "{}", run.stdout);
    assert!(!path.exists());
}

/// A formula of the command line is fitted; its nonlinear number needs a beginning, and finds its
/// way from a wrong one.
#[test]
fn a_formula_is_added_from_the_command_line() {
    let folder = scratch();
    let (path, new) = word(&folder, "new.toml");
    let formula = "height*(2*fract(position_mm/pitch) - 1)";
    let words = ["add", EXAMPLE[0], "--formula", formula, "--fit", EXAMPLE[1], "-o", &new];
    let refused = helixlock(&words);
    assert_eq!(refused.status, 2);
    assert!(
        refused.stderr.contains("hint: say where its search begins: --set pitch="),
        "{refused:?}"
    );
    assert!(!path.exists());
    let added = json(&helixlock(&[&words[..], &["--set", "pitch=36", "--json"]].concat()));
    let (pitch, error) = number(&added["effects"][0]["parameters"]["pitch"]);
    assert!((pitch - 41.0).abs() < 2.0 * error + 0.005 * 41.0, "{pitch} ± {error}");
    let text = fs::read_to_string(&path).expect("a machine file");
    assert!(text.contains("kind = \"custom\"") && text.contains(formula), "{text}");

    let set = ["add", EXAMPLE[0], "--formula", "k*bed_load_n", "--set", "k=1", "-o", &new];
    let refused = helixlock(&set);
    assert_eq!(refused.status, 2);
    assert!(refused.stderr.contains("found `bed_load_n`, expected a known column"), "{refused:?}");
}

/// A column that is felt late, and a switch with hysteresis, are formulas, too.
#[test]
fn a_formula_remembers() {
    let folder = scratch();
    let mut data = "time_s,position_mm,pass,oil_c,error_um\n".to_owned();
    let mut late = 20.0;
    for row in 0..400_u32 {
        let oil = 20.0 + if row % 200 < 100 { 0.0 } else { 4.0 };
        late += (oil - late) * (1.0 - libm::exp(-1.0 / 30.0));
        let noise = 0.01 * libm::sin(f64::from(row * row));
        let error = -0.25 * (late - 20.0) + noise;
        writeln!(data, "{row},{},1,{oil},{error}", 0.5 * f64::from(row)).expect("a string");
    }
    let (_, new) = word(&folder, "new.toml");
    let (csv, csv_word) = word(&folder, "data.csv");
    put(&csv, &data);
    let formula = ["--formula", "k*lag(oil_c, tau_s)", "--set", "tau_s=10"];
    let words = ["add", EXAMPLE[0], "--fit", &csv_word, "-o", &new, "--json"];
    let added = json(&helixlock(&[&words[..], &formula].concat()));
    let parameters = &added["effects"][0]["parameters"];
    for (name, truth) in [("tau_s", 30.0), ("k", 0.25)] {
        let (value, error) = number(&parameters[name]);
        assert!((value - truth).abs() < 3.0 * error + 0.02 * truth, "{name} {value} ± {error}");
    }
}

/// Strokes of a sine, sampled every 10 ms: an axis that is 8 ms late, rounded to 20 µm. What its
/// speed at each sample tells is proposed, and neither play nor waves.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_follower_is_late_by_the_speed_of_every_sample() {
    let folder = scratch();
    let machine = "title = 'axis'\n[spindle]\nspeed = '300 rpm'\n[lead_screw]\nlead = '5 mm'\n";
    let (path, file) = word(&folder, "machine.toml");
    put(&path, machine);
    let mut text = "time_s,position_mm,error_um\n".to_owned();
    for row in 0..600_u32 {
        let time_s = f64::from(row) / 100.0;
        // From half a stroke a second to one.
        let turns = 0.5 * time_s + 0.04 * time_s * time_s;
        let phase = std::f64::consts::TAU * turns;
        let velocity_mm_s = 5.0 * libm::cos(phase) * std::f64::consts::TAU * (0.5 + 0.08 * time_s);
        let error_um = (8.0 * velocity_mm_s / 20.0).round() * 20.0;
        writeln!(text, "{time_s},{:.2},{error_um}", 5.0 * libm::sin(phase)).expect("memory");
    }
    let (path, data) = word(&folder, "data.csv");
    put(&path, &text);
    let found = json(&helixlock(&["discover", &file, &data, "--json"]));
    assert_eq!(found["verdict"], "explained-by-a-formula", "{found}");
    let proposals = found["proposals"].as_array().expect("a list");
    assert_eq!(proposals.len(), 1, "{found}");
    assert_eq!(proposals[0]["shape"], "late by a time", "{found}");
    let (size, error) = number(&proposals[0]["parameters"]["size"]);
    // A turn a minute is a twelfth of a millimetre a second; a table ahead is no error behind.
    assert!((size + 8.0 / 12.0).abs() < 2.0 * error + 0.005, "{size} ± {error}");
    let diagnosed = json(&helixlock(&["diagnose", &file, &data, "--json"]));
    assert_eq!(diagnosed["verdict"], "unexplained", "{diagnosed}");
    assert_eq!(diagnosed["residual"][0]["along"], "velocity_rpm", "{diagnosed}");
}
