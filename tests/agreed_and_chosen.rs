//! What is asked of effects once others are known: whether other values suit better, whether every reversal agrees,
//! and whether they stand clear of what nobody explains.

use std::f64::consts::TAU;

use helixlock_lab::{Diagnosis, Verdict};

use crate::support::diagnosed::{diagnosed, names};
use crate::support::passes::white;
use crate::support::seeds::seeds;

/// Columns with titles, of rows of time, s, place, mm, and direction, and an error, µm, with noise.
fn measured(
    rows: impl Iterator<Item = [f64; 3]>,
    mut noise: impl FnMut() -> f64,
    error_um: impl Fn(f64, f64, f64) -> f64,
) -> Vec<(&'static str, Vec<f64>)> {
    let mut columns =
        ["time_s", "position_mm", "direction", "error_um"].map(|name| (name, Vec::new()));
    for [time_s, mm, way] in rows {
        let cells = [time_s, mm, way, error_um(time_s, mm, way) + noise()];
        columns.iter_mut().zip(cells).for_each(|((_, column), cell)| column.push(cell));
    }
    columns.into()
}

/// Strokes there and back of so many rows, 5 mm and 5 s apart.
fn strokes(number: u16, rows: u16) -> impl Iterator<Item = [f64; 3]> {
    (0..number * rows).map(move |row| {
        let (stroke, gone) = (row / rows, row % rows);
        let forward = stroke % 2 == 0;
        let mm = 5.0 * f64::from(if forward { gone } else { rows - 1 - gone });
        let time_s = 5.0 * f64::from(row) + 60.0 * f64::from(stroke);
        [time_s, mm, if forward { 1.0 } else { -1.0 }]
    })
}

/// A bow of the screw on a day that grows colder and warm again: alone it is followed by a cube, which is kept no
/// longer than until the air is known.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn powers_of_a_curve_are_chosen_again_beside_what_joins_it() {
    let cooler = |time_s: f64| -2.352 * libm::sin(TAU * 1.3 * time_s / 2400.0 + 3.18);
    for seed in seeds(2, 8) {
        let rows = strokes(4, 120);
        let mut columns = measured(rows, white(seed, 0.2), |time_s, mm, _| {
            -5e-6 * mm * mm + 0.94e-3 * mm * cooler(time_s)
        });
        let air = columns[0].1.iter().map(|time_s| 20.0 + cooler(*time_s)).collect();
        let pass = columns[0].1.iter().map(|time_s| (time_s / 660.0).floor()).collect();
        columns.extend([("air_temperature_c", air), ("pass", pass)]);
        let found = diagnosed(columns);
        let mut named = names(&found);
        named.sort_unstable();
        assert_eq!(named, ["air-temperature", "screw-progressive"], "{seed}");
        assert_eq!(found.verdict, Verdict::Explained, "{seed}: {:?}", found.residual);
    }
}

/// Ten strokes at whose beginnings so much play each is taken up.
fn turned(play_um: [f64; 10]) -> Diagnosis {
    let level = |stroke: usize| -> f64 {
        let before = play_um[..=stroke].iter().zip([1.0, -1.0].into_iter().cycle());
        before.map(|(play, way)| play * way).sum()
    };
    let of = |time_s: f64, _: f64, _: f64| {
        let stroke = (0..10).rfind(|stroke| 360.0 * f64::from(*stroke) <= time_s).unwrap_or(0);
        level(usize::try_from(stroke).expect("one of ten"))
    };
    diagnosed(measured(strokes(10, 60), white(3, 0.2), of))
}

/// A nut that settles: the play of one reversal is half of another's.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn play_is_the_same_at_every_reversal() {
    let same = turned([1.0; 10]);
    assert_eq!((names(&same), same.verdict), (vec!["backlash"], Verdict::Explained));
    let other = turned([1.0, 1.0, 0.6, 1.3, 0.8, 1.2, 0.5, 0.9, 1.4, 0.8]);
    assert_eq!(other.verdict, Verdict::Unexplained, "{:?}", names(&other));
    let told = |one: &helixlock_lab::Structure| one.shape.ends_with("at some reversals");
    assert!(other.residual.iter().any(told), "{:?}", other.residual.len());
}

/// A logger whose clock is off by up to a sixth of its interval: a vibration above half of its rate and the alias
/// below it are not alike.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn an_uneven_clock_tells_a_vibration_from_its_alias() {
    let rows = strokes(4, 105).zip(1_u32..).map(|([time_s, mm, way], row)| {
        let off = f64::from(row * row % 97) / 96.0 - 0.5;
        [time_s + 1.6 * off, mm, way]
    });
    let shaken = |time_s: f64, _: f64, _: f64| 0.5 * libm::sin(TAU * 0.1303 * time_s);
    let found = diagnosed(measured(rows, white(5, 0.4), shaken));
    assert_eq!(names(&found), ["vibration"]);
    let last = &found.rounds[found.rounds.len() - 1].effects[0];
    let hertz = last.parameters.iter().find(|one| one.key == "frequency_hz").expect("a frequency");
    assert!((hertz.value - 0.1303).abs() < 2e-4, "{}", hertz.value);
}

/// A gear's wave of five standard errors in a record that switches between two levels: the noise that it stands
/// clear of was fitted to the switching too.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn what_is_faint_has_no_name_beside_what_nobody_explains() {
    let beside_switching = |size_um: f64| {
        let mut columns = ["pass", "position_mm", "error_um"].map(|name| (name, Vec::new()));
        let (mut noise, mut level) = (white(2, 0.3), 0.5);
        for row in 0..2000_u32 {
            if row * row % 997 < 14 {
                level = -level;
            }
            let mm = 0.6 * f64::from(row % 500);
            let error = size_um * libm::sin(TAU * 2.5 * mm / 8.0) + level + noise();
            let cells = [f64::from(row / 500), mm, error];
            columns.iter_mut().zip(cells).for_each(|((_, column), cell)| column.push(cell));
        }
        diagnosed(columns.into())
    };
    for (size_um, named) in [(0.15, &["gear-error"][..]), (0.055, &[][..])] {
        let found = beside_switching(size_um);
        assert_eq!((names(&found), found.verdict), (named.to_vec(), Verdict::Unexplained));
    }
}
