//! Machines to begin with: each runs at once, and its data hold what they are said to hold.

use std::process::Command;

use crate::support::command::{helixlock, put, repository, scratch};

/// Template, effect that its data hold and its machine file does not, parameter, value.
const TEMPLATES: &[(&str, &str, &str, f64)] = &[
    ("lead-screw-grinder", "screw-periodic", "amplitude_um", 1.5),
    ("screw-axis", "backlash", "width_um", 8.0),
    ("laser-axis", "screw-periodic", "amplitude_um", 2.0),
    ("rotary-table", "gear-error", "amplitude_arcsec", 4.0),
    ("telescope", "gear-error", "amplitude_arcsec", 5.0),
    ("robot-joint", "gear-error", "amplitude_arcsec", 25.0),
    ("gear-tester", "gear-error", "amplitude_arcsec", 12.0),
];

fn run(words: &[&str]) -> String {
    let run = helixlock(words);
    assert_eq!(run.status, 0, "{words:?}: {}", run.stderr);
    run.stdout
}

#[test]
fn every_template_names_what_its_data_hold() {
    let overview = run(&["init"]);
    for (name, effect, parameter, expected) in TEMPLATES {
        assert!(overview.contains(name), "{overview}");
        let scratch = scratch();
        let folder = scratch.path().join(name);
        let path = |file: &str| folder.join(file).to_str().expect("plain").to_owned();
        let told = run(&["init", "--template", name, "-o", folder.to_str().expect("plain")]);
        let (machine, data) = (path("machine.toml"), path("data.csv"));
        let next = match *name {
            "lead-screw-grinder" => format!("next: helixlock sim {machine} -o {}", path("sim")),
            _ => format!("next: helixlock diagnose {machine} {data}"),
        };
        assert!(told.contains(&next), "{told}");
        let found = run(&["diagnose", &machine, &data, "--json"]);
        let found: serde_json::Value = serde_json::from_str(&found).expect("JSON");
        let named = &found["effects"];
        assert_eq!(named.as_array().map(Vec::len), Some(1), "{name}: {named}");
        assert_eq!(named[0]["effect"], *effect, "{name}: {named}");
        let value = named[0]["parameters"][parameter]["value"].as_f64().expect("a number");
        assert!((value.abs() - expected).abs() < 0.05 * expected, "{name}: {value}");
        // Whatever names it can put it into the file, in the unit of the chain.
        let better = path("better.toml");
        run(&["add", &machine, effect, "--fit", &data, "-o", &better]);
        let left = run(&["compare", &better, &data, "--json"]);
        let left: serde_json::Value = serde_json::from_str(&left).expect("JSON");
        assert_eq!(left["noise_only"], true, "{name}: {left}");
        let unit = left["unit"].as_str().expect("a unit");
        assert!(left["sensors"][0][format!("rms_{unit}")].is_number(), "{name}: {left}");
    }
}

#[test]
fn the_grinder_is_simulated_and_an_axis_is_not() {
    let scratch = scratch();
    let word = |file: &str| scratch.path().join(file).to_str().expect("plain").to_owned();
    run(&["init", "--template", "lead-screw-grinder", "-o", &word("grinder")]);
    run(&["sim", &word("grinder/machine.toml"), "--length", "1 mm", "-o", &word("sim")]);
    run(&["init", "--template", "screw-axis", "-o", &word("axis")]);
    let refused = helixlock(&["sim", &word("axis/machine.toml"), "-o", &word("none")]);
    assert_eq!(refused.status, 2);
    assert!(refused.stderr.contains("the device needs `[workpiece]`"), "{}", refused.stderr);
    assert!(!scratch.path().join("none").exists());
}

#[test]
fn nothing_is_written_over() {
    let scratch = scratch();
    put(&scratch.path().join("data.csv"), "mine");
    let folder = scratch.path().to_str().expect("plain");
    let refused = helixlock(&["init", "--template", "telescope", "-o", folder]);
    assert_eq!(refused.status, 2);
    assert!(refused.stderr.contains("data.csv: is there already"), "{}", refused.stderr);
    assert!(!scratch.path().join("machine.toml").exists());
    assert_eq!(std::fs::read_to_string(scratch.path().join("data.csv")).expect("kept"), "mine");
    let unknown = helixlock(&["init", "--template", "robot_joint", "-o", folder]);
    assert!(
        unknown.stderr.contains("expected `robot-joint`, or another one of"),
        "{}",
        unknown.stderr
    );
}

#[test]
fn the_data_are_what_their_script_makes() {
    let folder = repository().join("templates");
    for (name, ..) in TEMPLATES {
        let output = Command::new("awk")
            .args(["-v", &format!("what={name}"), "-f", "make.awk"])
            .current_dir(&folder)
            .output()
            .expect("`awk` starts");
        let kept = std::fs::read(folder.join(name).with_extension("csv")).expect("the data");
        assert!(output.stdout == kept, "{name}: data are stale");
    }
}
