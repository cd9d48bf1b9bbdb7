//! The three leads of the report give its headline, and their pages say what really comes out.

use std::fs;

use serde_json::Value;

use crate::support::command::{helixlock, repository, scratch, word};

const EXAMPLES: [&str; 3] = ["sg7430-6mm", "sg7430-sixth-inch", "sg7430-half-pi-module"];

/// "3 µm periodic, 30–40 µm cumulative, both within 1 µm": document 1, introduction.
#[test]
fn both_errors_come_within_a_micrometre() {
    for example in EXAMPLES {
        let folder = scratch();
        let (out, out_word) = word(&folder, "out");
        let run = helixlock(&["sim", &format!("examples/{example}/machine.toml"), "-o", &out_word]);
        assert_eq!((run.status, run.stderr.as_str()), (0, ""), "{example}");
        let text = fs::read_to_string(out.join("summary.json")).unwrap();
        let summary: Value = serde_json::from_str(&text).unwrap();
        let number = |path: &str| summary.pointer(path).and_then(Value::as_f64).unwrap();

        let periodic_um = number("/without_correction/periodic_error_um");
        assert!((periodic_um - 3.0).abs() < 0.05, "{example}: {periodic_um}");
        let cumulative_um = number("/without_correction/cumulative_error_um");
        assert!((30.0..40.0).contains(&cumulative_um), "{example}: {cumulative_um}");
        for kind in ["periodic_error_um", "cumulative_error_um", "lead_error_peak_to_peak_um"] {
            let with_um = number(&format!("/with_correction/{kind}"));
            assert!(with_um < 1.0, "{example}: {kind} {with_um}");
        }
        let ratio = number("/hunting/ratio");
        assert!((ratio - 0.5).abs() < 0.01, "{example}: hunting at {ratio} of the comparisons");
        assert_eq!(summary.pointer("/slew/limited"), Some(&Value::Bool(false)), "{example}");
        assert!(number("/playback/steps_left").abs() < 0.5, "{example}");

        let page = repository().join(format!("examples/{example}/README.md"));
        let page = fs::read_to_string(page).unwrap();
        let shown = run.stdout.replace(&out_word, "out");
        assert!(page.contains(&shown), "{example}: the page is stale, expected in it:\n{shown}");
    }
}

#[test]
fn a_step_clock_too_slow_is_said_so() {
    let folder = scratch();
    let (out, out_word) = word(&folder, "out");
    let run = helixlock(&["sim", "examples/sg7430-6mm/too-slow.toml", "-o", &out_word]);
    assert_eq!(run.status, 0, "{}", run.stderr);
    assert!(run.stdout.contains("note: slew limit: the motor moves 0.750 um/s"), "{}", run.stdout);
    let report = fs::read_to_string(out.join("report.html")).unwrap();
    assert!(report.contains("slew limit: the motor moves 0.750 um/s"));
    let page = fs::read_to_string(repository().join("examples/sg7430-6mm/README.md")).unwrap();
    let shown = run.stdout.replace(&out_word, "out-slow");
    assert!(page.contains(&shown), "the page is stale, expected in it:\n{shown}");
}
