//! What is no number a machine could follow is refused by its name and place, never answered.

use crate::support::command::{helixlock, put, repository, scratch, word};

fn machine(formula: &str, entry: &str) -> String {
    let path = repository().join("examples/sg7430-6mm/machine.toml");
    let text = std::fs::read_to_string(path).expect("the example is there");
    format!(
        "{text}\n[[effect]]\nkind = \"custom\"\nname = \"odd\"\nentry = \"{entry}\"\n\
         formula = \"{formula}\"\n"
    )
}

#[test]
fn an_effect_without_a_value_is_refused_by_name_and_place() {
    let folder = scratch();
    let (path, machine_word) = word(&folder, "machine.toml");
    let (out, out_word) = word(&folder, "out");
    for (formula, entry, found) in [
        ("0/0", "motion", "`odd` gives NaN µm at 0.000000 s, 0.000000 mm"),
        ("0/0", "workpiece", "`odd` gives NaN µm at 0.000000 s, 0.000000 mm"),
        ("sqrt(position_mm-3)", "length-reference", "`odd` gives NaN µm at 0.000000 s"),
        ("sqrt(3-position_mm)", "motion", "`odd` gives NaN µm at 5.0"),
        ("sqrt(3-position_mm)", "workpiece", "`odd` gives NaN µm at 5."),
        ("1/(time_s-time_s)", "angle-reference", "`odd` gives inf µm at 0.000000 s"),
        ("exp(1000*time_s)", "motion", "`odd` gives 1000"),
        ("1000000*floor(position_mm)", "motion", "move the table by more than 20000 pulses"),
        ("0/0+error_um", "electronics", "`odd` gives NaN µm at 0.000000 s"),
    ] {
        put(&path, &machine(formula, entry));
        for words in [
            &["sim", &machine_word, "--length", "5 mm", "-o", &out_word][..],
            &["certify", &machine_word, "--length", "5 mm"],
        ] {
            let run = helixlock(words);
            assert_eq!(run.status, 2, "{formula} {entry}: {run:?}");
            assert!(run.stderr.contains(found), "{formula} {entry}: {}", run.stderr);
            assert!(run.stdout.is_empty() && !out.exists(), "{formula} {entry}: {run:?}");
        }
    }
    // What it does after the pass is nobody's business.
    put(&path, &machine("sqrt(5.001-position_mm)", "motion"));
    let run = helixlock(&["sim", &machine_word, "--length", "5 mm", "-o", &out_word]);
    assert_eq!(run.status, 0, "{run:?}");
}

/// Compared with data the same effects are refused: what is left of them is no number either.
#[test]
fn an_effect_without_a_value_at_a_sample_is_no_noise() {
    let folder = scratch();
    let (path, machine_word) = word(&folder, "machine.toml");
    let (data, data_word) = word(&folder, "data.csv");
    let (out, out_word) = word(&folder, "out");
    let row = |i: i32| format!("{},{:.4}\n", 2 * i, 0.3 * libm::sin(0.5 * f64::from(i)));
    put(&data, &format!("position_mm,error_um\n{}", (0..200).map(row).collect::<String>()));
    for (formula, found) in [
        ("1/position_mm", "effect `odd` gives inf µm at 0.000000 s, 0.000000 mm"),
        ("sqrt(position_mm-100)", "effect `odd` gives NaN µm at 0.000000 s, 0.000000 mm"),
        ("sqrt(100-position_mm)", "effect `odd` gives NaN µm at 16"),
        ("exp(exp(position_mm))", "effect `odd` gives"),
    ] {
        put(&path, &machine(formula, "motion").replace("closed = true", "closed = false"));
        for words in [
            &["diagnose", &machine_word, &data_word][..],
            &["compare", &machine_word, &data_word],
            &["discover", &machine_word, &data_word],
            &["learn", &machine_word, &data_word, "-o", &out_word],
        ] {
            let run = helixlock(words);
            assert_eq!(run.status, 2, "{formula}: {run:?}");
            assert!(run.stderr.contains(found), "{formula}: {}", run.stderr);
            assert!(run.stdout.is_empty() && !out.join("machine.toml").exists(), "{run:?}");
        }
    }
    // Nor is such an effect fitted.
    let plain = machine("0", "motion").split("\n[[effect]]").next().unwrap_or_default().to_owned();
    put(&path, &plain);
    let run = helixlock(&[
        "add",
        &machine_word,
        "--formula",
        "a/position_mm",
        "--fit",
        &data_word,
        "-o",
        &out_word,
    ]);
    assert_eq!(run.status, 2, "{run:?}");
    assert!(run.stderr.contains("NaN µm at 0.000000 s"), "{}", run.stderr);
}

#[test]
fn a_pass_without_a_comparison_is_no_result() {
    let folder = scratch();
    let (_, out_word) = word(&folder, "out");
    let machine = "examples/sg7430-6mm/machine.toml";
    for words in [
        &["sim", machine, "--length", "0.01 mm", "-o", &out_word][..],
        &["certify", machine, "--length", "0.01 mm"],
    ] {
        let run = helixlock(words);
        assert_eq!(run.status, 2, "{run:?}");
        assert!(run.stderr.contains("before the first comparison"), "{run:?}");
    }
}

#[test]
fn numbers_that_no_quantity_reaches_are_refused_by_every_reader() {
    let folder = scratch();
    let (path, data) = word(&folder, "data.csv");
    let rows: Vec<_> = (0..50).map(|i| format!("{i},{}e170\n", i % 3)).collect();
    put(&path, &format!("position_mm,error_um\n{}", rows.concat()));
    let machine = "examples/sg7430-6mm/machine.toml";
    let found = "e170`, expected a number or an empty cell";
    for (words, found) in [
        (&["compare", machine, &data][..], found),
        (&["diagnose", machine, &data], found),
        (&["scale", "iso230", &data], found),
        (&["import", &data], "found the columns `position_mm`, expected one of `error_um`"),
    ] {
        let run = helixlock(words);
        assert_eq!(run.status, 2, "{words:?}: {run:?}");
        assert!(run.stderr.contains(found), "{words:?}: {run:?}");
    }
}

#[test]
fn a_sweep_of_too_many_cases_says_their_number() {
    let folder = scratch();
    let (_, out) = word(&folder, "out.csv");
    let machine = "examples/sg7430-6mm/machine.toml";
    for (range, axes, found) in [
        ("1..65536:65536", 4, "18446744073709551615 or more cases, expected at most 1000000"),
        ("1..1000:1000", 3, "1000000000 cases, expected at most 1000000"),
    ] {
        let keys = ["dividers.a", "dividers.b", "drive.frequency", "spindle.speed"];
        let axes: Vec<_> = keys[..axes].iter().map(|key| format!("{key}={range}")).collect();
        let mut words = vec!["sweep", machine, "-o", &out];
        for axis in &axes {
            words.extend(["--set", axis]);
        }
        let run = helixlock(&words);
        assert_eq!(run.status, 2, "{run:?}");
        assert!(run.stderr.contains(found), "{run:?}");
    }
}
