//! Captured pulse trains as measurements: from our own simulation and from a logic analyser.

use std::fmt::Write;

use serde_json::Value;

use crate::support::command::{helixlock, put, repository, scratch, word};

/// The 6 mm screw without its periodic error.
fn lacking_machine() -> String {
    let path = repository().join("examples/sg7430-6mm/machine.toml");
    let text = std::fs::read_to_string(path).expect("the example is there");
    let (before, after) = text.split_once("[[effect]]").expect("an effect");
    let (_, progressive) = after.split_once("[[effect]]").expect("two effects");
    format!("{before}[[effect]]{progressive}")
}

/// The closed loop's own waveform holds fringes, lines and steps; the machine's error of 1.5 µm
/// and 30° comes out of them, the hunting does not.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_simulated_capture_names_the_machines_error() {
    let folder = scratch();
    let (out, out_word) = word(&folder, "out");
    let mut words =
        vec!["sim", "examples/sg7430-6mm/machine.toml", "--length", "60", "-o", &out_word];
    words.extend(["--from", "0", "--to", "100"]);
    for scope in ["grating", "laser", "step", "forward"] {
        words.extend(["--scope", scope]);
    }
    let simulated = helixlock(&words);
    assert_eq!((simulated.status, simulated.stderr.as_str()), (0, ""));

    let (machine, machine_word) = word(&folder, "machine.toml");
    put(&machine, &lacking_machine());
    let capture = out.join("wave.vcd").to_str().expect("a path of text").to_owned();
    let learned = helixlock(&["learn", &machine_word, &capture, "--json"]);
    assert_eq!(learned.status, 0, "{}", learned.stderr);
    let answer: Value = serde_json::from_str(&learned.stdout).expect("JSON");
    // At one speed, a vibration of that very frequency looks the same.
    let ranked = answer["candidates"].as_array().expect("candidates");
    let rivals = ranked[0]["confounded_with"].as_array().expect("names");
    assert!(rivals.iter().all(|rival| rival == "vibration"), "{rivals:?}");
    let expected = if rivals.is_empty() { "explained" } else { "ambiguous" };
    assert_eq!(answer["verdict"], expected, "{}", learned.stdout);
    let effects = answer["effects"].as_array().expect("effects");
    assert_eq!(effects.len(), 1, "{}", learned.stdout);
    assert_eq!(effects[0]["effect"], "screw-periodic");
    let value = |key: &str| effects[0]["parameters"][key]["value"].as_f64().expect(key);
    assert!((value("amplitude_um") - 1.5).abs() < 0.005, "{}", value("amplitude_um"));
    assert!((value("phase_deg") - 30.0).abs() < 0.2, "{}", value("phase_deg"));
    // A clock of 12 MHz is 0.05 nm of travel; a fringe is interpolated far below that.
    assert!(answer["noise_um"].as_f64().expect("noise") < 0.002);
}

/// A dump of two trains with these names, `rates` in pulses a millisecond.
fn dump(names: [&str; 2], rates: [u64; 2]) -> String {
    let mut text = format!(
        "$timescale 1 ns $end\n$scope module libsigrok $end\n$var wire 1 ! {} $end\n\
         $var wire 1 \" {} $end\n$upscope $end\n$enddefinitions $end\n#0 0! 0\"\n",
        names[0], names[1]
    );
    let mut changes = Vec::new();
    for (code, rate) in ['!', '"'].into_iter().zip(rates) {
        for pulse in 1..20_000 * rate {
            let at = pulse * 1_000_000 / rate;
            changes.extend([(at, '1', code), (at + 100_000, '0', code)]);
        }
    }
    changes.sort_unstable();
    for (at, level, code) in changes {
        writeln!(text, "#{at} {level}{code}").expect("memory takes it");
    }
    text
}

fn compare_capture(
    names: [&str; 2],
    rates: [u64; 2],
    more: &[&str],
) -> crate::support::command::Run {
    let folder = scratch();
    let (capture, capture_word) = word(&folder, "capture.vcd");
    put(&capture, &dump(names, rates));
    let (machine, machine_word) = word(&folder, "machine.toml");
    put(
        &machine,
        "workpiece.lead = '6 mm'\nspindle.speed = '12 rpm'\ngrating.lines = 10000\n\
         laser.wavelength = '0.6 um'\ndrive = { step = '0.0125 um', frequency = '100 Hz' }\n\
         dividers = { a = 20, b = 30 }\n",
    );
    let words = ["compare", &machine_word, &capture_word].into_iter().chain(more.iter().copied());
    let mut run = helixlock(&words.collect::<Vec<_>>());
    run.stderr = run.stderr.replace(&capture_word, "capture.vcd");
    run
}

/// 12 rpm of 10000 lines are 2 lines a millisecond, and B/A asks for 3 fringes in that time.
#[test]
fn unnamed_trains_are_told_apart_by_their_rates() {
    for (names, rates) in [(["D0", "D1"], [2, 3]), (["D0", "D1"], [3, 2])] {
        let run = compare_capture(names, rates, &[]);
        assert_eq!((run.status, run.stderr.as_str()), (0, ""), "{rates:?}");
        assert!(run.stdout.contains("captured before the dividers"), "{}", run.stdout);
    }
}

#[test]
fn trains_that_cannot_be_meant_are_refused_with_their_place() {
    for (names, rates, more, message) in [
        (
            ["D0", "D1"],
            [2, 4],
            &[][..],
            "capture.vcd: found one-bit signals `libsigrok.D0`, `libsigrok.D1`, expected one of \
             grating lines and one of laser fringes\nhint: name them with `--grating-signal` and \
             `--laser-signal`",
        ),
        (
            ["grating", "laser"],
            [3, 2],
            &[],
            "capture.vcd: found 0.6667 laser pulses a grating pulse, expected 1.5000 by the \
             machine's dividers",
        ),
        (
            ["laser_a", "laser_b"],
            [2, 3],
            &[],
            "capture.vcd: found `libsigrok.laser_a`, `libsigrok.laser_b`, expected one signal",
        ),
        (
            ["D0", "D1"],
            [2, 3],
            &["--grating-signal", "D7"],
            "capture.vcd: signal `D7` is missing, found `libsigrok.D0`, `libsigrok.D1`",
        ),
    ] {
        let run = compare_capture(names, rates, more);
        assert_eq!((run.status, run.stdout.as_str()), (2, ""), "{names:?} {rates:?}");
        assert!(run.stderr.contains(message), "{}", run.stderr);
    }
}

#[test]
fn signals_of_a_table_are_refused() {
    let run = helixlock(&[
        "compare",
        "examples/hidden-gear/machine.toml",
        "examples/hidden-gear/data.csv",
        "--laser-signal",
        "D1",
    ]);
    assert_eq!(run.status, 2);
    assert!(run.stderr.contains("found a table, expected a VCD capture"), "{}", run.stderr);
}
