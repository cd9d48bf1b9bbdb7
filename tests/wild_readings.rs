//! Readings that are far off now and then: they hide nothing, show nothing, and are told of.

use std::fs;
use std::path::Path;

use helixlock_lab::{Diagnosis, Verdict, compare, diagnose};
use serde_json::Value;

use crate::support::command::{few_samples, helixlock, put, scratch};
use crate::support::diagnosed::{diagnosed, names as effects_of, problem_of};
use crate::support::passes::{MACHINE, white};
use crate::support::seeds::seeds;

/// Rows of a pass.
const ROWS: usize = 212;

/// Columns of three passes there, errors by pass and row.
fn three_passes(mut error_um: impl FnMut(usize, usize) -> f64) -> Vec<(&'static str, Vec<f64>)> {
    let mut columns = [const { Vec::new() }; 4];
    for (nth, pass) in (0..3).zip([1.0, 2.0, 3.0]) {
        for (row, place) in (0..ROWS).zip(0_u16..) {
            let mm = 1.4 * f64::from(place);
            let cells = [pass, 400.0 * pass + mm / 1.7, mm, error_um(nth, row)];
            columns.iter_mut().zip(cells).for_each(|(column, cell)| column.push(cell));
        }
    }
    ["pass", "time_s", "position_mm", "error_um"].into_iter().zip(columns).collect()
}

/// Noise of 0.15 µm on a display of 0.1 µm, in which half the rows of many a stretch are what their neighbours
/// are, and six wild readings.
fn coarse(seed: u64) -> Diagnosis {
    let mut noise = white(seed, 0.15);
    let wild = |nth, row| match (nth, row) {
        (0, 97) => -3.0,
        (0, 150) | (2, 123) => -8.4,
        (1, 21) => 4.3,
        (1, 29) => 3.1,
        (1, 114) => 6.6,
        _ => 0.0,
    };
    diagnosed(three_passes(|nth, row| (10.0 * (noise() + wild(nth, row))).round() / 10.0))
}

#[test]
fn readings_of_a_coarse_display_that_are_wild_are_noise_and_told_of() {
    for seed in seeds(1, 4) {
        let found = coarse(seed);
        assert_eq!(found.verdict, Verdict::NothingMissing, "{seed}: {:?}", found.residual);
        let far = found.far_readings.expect("wild readings");
        assert_eq!((far.readings, far.of), (6, 3 * ROWS), "{seed}");
        assert!((far.rest_um - 0.153).abs() < 0.015, "{seed}: {far:?}");
        assert!((far.first.off_um + 3.0).abs() < 0.5 && far.first.pass < 1.5, "{far:?}");
    }
}

/// A tooth that is broken out, a reading wide, once each turn of 5 mm: wild readings come at no such places.
#[test]
fn what_is_far_off_at_even_distances_is_not_wild() {
    let machine = "spindle.speed = \"60 rpm\"\nlead_screw.lead = \"5 mm\"\n";
    for seed in seeds(1, 3) {
        let mut noise = white(seed, 0.15);
        let mm = |row: u16| 0.0523 * f64::from(row);
        let tooth = |mm: f64| {
            let off = (mm / 5.0).fract() - 0.317;
            1.8 * libm::exp(-0.5 * (off / 0.004) * (off / 0.004))
        };
        let columns = vec![
            ("time_s", (0..1600).map(|row| mm(row) / 5.0).collect()),
            ("position_mm", (0..1600).map(mm).collect()),
            ("error_um", (0..1600).map(|row| tooth(mm(row)) + noise()).collect()),
        ];
        let found = diagnose(&problem_of(machine, columns));
        assert_eq!(found.verdict, Verdict::Unexplained, "{seed}");
    }
}

/// Oil that is pumped each 150 mm of the way, whichever way it goes, and seeps off: after each stroke slow noise
/// follows it.
#[test]
fn what_comes_again_with_the_way_is_no_slow_noise() {
    for seed in seeds(1, 3) {
        let mut noise = white(seed, 0.18);
        let (mut slow, mut columns) = (0.0, [const { Vec::new() }; 4]);
        for row in 0..160_u16 {
            let (pass, nth) = (row / 40, f64::from(row % 40));
            let mm = 16.4 * if pass % 2 == 0 { nth } else { 39.0 - nth };
            let pumped = (16.4 * f64::from(row) / 262.0 + 0.3).fract();
            slow = 0.7 * slow + noise();
            let error_um = 2.6 * libm::exp(-pumped / 0.15) + slow;
            let cells =
                [f64::from(pass), 6.2 * f64::from(row) + 40.0 * f64::from(pass), mm, error_um];
            columns.iter_mut().zip(cells).for_each(|(column, cell)| column.push(cell));
        }
        let titles = ["pass", "time_s", "position_mm", "error_um"];
        let problem = problem_of(MACHINE, titles.into_iter().zip(columns).collect());
        assert_eq!(diagnose(&problem).verdict, Verdict::Unexplained, "{seed}");
    }
}

/// Noise that forgets within a few rows, and one wild reading of eighteen deviations: beside the noise of that one
/// row anything that meets it would still be worth nine of twice the log likelihood.
#[test]
fn one_wild_reading_in_slow_noise_is_no_knock() {
    for seed in seeds(2, 6) {
        let (mut noise, mut last) = (white(seed, 0.6), 0.0);
        let found = diagnosed(three_passes(|nth, row| {
            last = 0.66 * last + noise();
            let wild = if (nth, row) == (1, 60) { 14.6 } else { 0.0 };
            (2.0 * (last + wild)).round() / 2.0
        }));
        assert_eq!(found.verdict, Verdict::NothingMissing, "{seed}: {:?}", found.residual);
    }
}

/// A pass that wanders among others that do not, and two wild readings: it is no larger for these.
#[test]
fn a_shape_is_no_larger_for_readings_that_are_wild() {
    let size_um = |wild_um: f64| {
        let (mut noise, mut wandered) = (white(3, 0.2), 0.0);
        let columns = three_passes(|nth, row| {
            wandered = 0.95 * wandered + if nth == 1 { 0.9 * noise() } else { 0.0 };
            wandered + noise() + if row == 70 && nth != 1 { wild_um } else { 0.0 }
        });
        let found = compare(&problem_of(MACHINE, columns));
        let slow = found.along.into_iter().find(|one| one.shape.starts_with("slow in some passes"));
        slow.expect("it is looked for").rms_um
    };
    let [without, with] = [size_um(0.0), size_um(40.0)];
    assert!((with / without - 1.0).abs() < 0.2, "{without} {with}");
}

/// Two ways with a wild reading in the same part of the travel: they have nothing in common.
#[test]
fn ways_are_not_alike_for_their_wild_readings() {
    for seed in 0..4 {
        let mut noise = white(seed, 0.15);
        let wild =
            |nth, row| if (nth, row) == (0, 60) || (nth, row) == (2, 63) { 14.0 } else { 0.0 };
        let columns = three_passes(|nth, row| noise() + wild(nth, row));
        let found = compare(&problem_of(MACHINE, columns));
        let alike = found.along.iter().find(|one| one.shape.starts_with("curve that passes have"));
        let alike = alike.expect("it is looked for");
        assert!(0.01 < alike.p_value && alike.rms_um < 0.1, "{seed}: {alike:?}");
    }
}

/// Few of the example's data, with 40 µm more in one row, which is the 31st.
fn with_a_wild_row(folder: &Path) -> String {
    let data = few_samples(folder, "hidden-gear", 4);
    let own = fs::read_to_string(&data).expect("it is there");
    let mut lines: Vec<String> = own.lines().map(str::to_owned).collect();
    let mut cells: Vec<String> = lines[31].split(',').map(str::to_owned).collect();
    cells[2] = format!("{}", cells[2].parse::<f64>().expect("an error") + 40.0);
    lines[31] = cells.join(",");
    put(Path::new(&data), &(lines.join("\n") + "\n"));
    data
}

#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn reports_say_which_readings_weigh_little() {
    let folder = scratch();
    let data_word = with_a_wild_row(folder.path());
    let machine = "examples/hidden-gear/machine.toml";
    for command in ["compare", "diagnose", "discover"] {
        let told = helixlock(&[command, machine, &data_word]).stdout;
        let note = "note: 1 of 238 readings lies far from the rest and weighs little (pass 1, ";
        assert!(told.contains(note), "{command}: {told}");
        let run = helixlock(&[command, machine, &data_word, "--json"]);
        let answer: Value = serde_json::from_str(&run.stdout).expect("JSON");
        let far = &answer["far_readings"];
        let off = far["first"]["off_um"].as_f64().expect("a number");
        assert!((off - 40.0).abs() < 3.0 && far["readings"] == 1, "{command}: {far}");
        assert!(answer["notes"].to_string().contains(&note[6..]), "{command}: {answer}");
        let told = helixlock(&[command, machine, &data_word, "--language", "zh"]).stdout;
        assert!(told.contains("238 个读数中有 1 个远离其余"), "{command}: {told}");
    }
}

/// Six readings on end that are off by eight deviations, in a single pass: a worn spot would be round.
#[test]
fn readings_on_end_that_are_off_are_no_wear() {
    for seed in seeds(1, 3) {
        let mut noise = white(seed, 0.05);
        let mut columns = [const { Vec::new() }; 3];
        for row in 0_u16..300 {
            let time_s = 0.0836 * f64::from(row);
            let off_um = if (64..70).contains(&row) { 0.4 } else { 0.0 };
            let cells = [time_s, 20.0 * time_s, off_um + noise()];
            columns.iter_mut().zip(cells).for_each(|(column, cell)| column.push(cell));
        }
        let names = ["time_s", "position_mm", "error_um"];
        let found = diagnosed(names.into_iter().zip(columns).collect());
        assert_eq!(found.verdict, Verdict::Unexplained, "{seed}");
        let effects = effects_of(&found);
        assert!(effects.is_empty(), "{seed}: {effects:?}");
    }
}
