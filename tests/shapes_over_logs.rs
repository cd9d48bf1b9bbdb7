//! What follows a logged column by no straight line, and what stands along an angle, is nobody's.
#![expect(clippy::cast_precision_loss, reason = "some hundred rows")]

use std::f64::consts::TAU;

use helixlock_lab::{Diagnosis, Verdict};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::support::diagnosed::{MACHINE, diagnosed_on, is_nobodys};
use crate::support::seeds::seeds;

const ROTARY: &str = r#"
output.rotary = true
spindle.speed = "0.1 rpm"
gear = [{ name = "worm", order = 90.0 }]
"#;

const PASSES: usize = 3;
/// Rows of a pass.
const ROWS: usize = 250;

/// A row: pass and its way, share of the travel, load and coolant about their means.
struct Row {
    pass: f64,
    forward: bool,
    time_s: f64,
    share: f64,
    load: f64,
    coolant: f64,
}

type Column<'a> = (&'static str, &'a dyn Fn(&Row) -> f64);

/// Rows of passes there and back by turns, with logs that repeat with neither travel nor pass.
fn rows() -> Vec<Row> {
    let of_pass = |pass: usize| {
        (0..ROWS).map(move |row| {
            let (pass, run) = (pass as f64, row as f64 / ROWS as f64);
            let forward = pass % 2.0 < 1.0;
            let time = pass + run;
            Row {
                pass,
                forward,
                time_s: 200.0 * pass + 160.0 * run,
                share: if forward { run } else { 1.0 - run },
                load: libm::sin(TAU * 1.3 * time) + libm::sin(TAU * 0.7 * time + 1.0),
                coolant: libm::sin(TAU * 1.7 * time + 2.0) + libm::sin(TAU * 0.4 * time),
            }
        })
    };
    (0..PASSES).flat_map(of_pass).collect()
}

/// The diagnosis of some columns and of an error: a shape in units of the deviation of its noise.
fn diagnosed(
    machine: &str,
    columns: &[Column<'_>],
    (error, deviation): (&'static str, f64),
    (seed, shape): (u64, &dyn Fn(&Row) -> f64),
) -> Diagnosis {
    let mut chance = ChaCha8Rng::seed_from_u64(seed);
    let rows = rows();
    let noisy = |row: &Row| {
        let noise: f64 = StandardNormal.sample(&mut chance);
        deviation * (noise + shape(row))
    };
    let error = (error, rows.iter().map(noisy).collect());
    let told = columns.iter().map(|(name, value)| (*name, rows.iter().map(value).collect()));
    diagnosed_on(machine, told.chain([error]).collect())
}

fn on_a_slide(seed: u64, shape: &dyn Fn(&Row) -> f64) -> Diagnosis {
    let columns: [Column<'_>; 5] = [
        ("pass", &|row| row.pass),
        ("time_s", &|row| row.time_s),
        ("position_mm", &|row| 640.0 * row.share),
        ("load_pct", &|row| 40.0 + 12.0 * row.load),
        ("coolant_c", &|row| 22.0 + row.coolant),
    ];
    diagnosed(MACHINE, &columns, ("error_um", 0.05), (seed, shape))
}

fn on_a_table(seed: u64, shape: &dyn Fn(&Row) -> f64) -> Diagnosis {
    let columns: [Column<'_>; 3] = [
        ("pass", &|row| row.pass),
        ("time_s", &|row| row.time_s),
        ("angle_rev", &|row| 0.27 * row.share),
    ];
    diagnosed(ROTARY, &columns, ("error_arcsec", 0.5), (seed, shape))
}

/// Dissipation grows with the square of the load.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn the_square_of_a_column_is_seen() {
    is_nobodys(|seed| on_a_slide(seed, &|row| 0.6 * row.load * row.load));
}

/// Neither column says anything alone.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn the_product_of_two_columns_is_seen() {
    is_nobodys(|seed| on_a_slide(seed, &|row| 0.8 * row.load * row.coolant));
}

/// A sensor whose reading wavers three times over its range.
#[test]
fn a_wave_over_a_column_is_seen() {
    is_nobodys(|seed| on_a_slide(seed, &|row| libm::sin(TAU * 0.75 * row.load)));
}

/// Two arcs of a ring that meet at an angle, on a table that turns by a quarter.
#[test]
fn a_kink_along_an_angle_is_seen() {
    is_nobodys(|seed| on_a_table(seed, &|row| 6.0 * (row.share - 0.45).max(0.0)));
}

/// The room warms until a door is opened.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_drift_that_turns_is_seen() {
    is_nobodys(|seed| on_a_slide(seed, &|row| -0.02 * (row.time_s - 290.0).abs()));
}

/// A wave of the screw on the way forward, and none on the way back.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_wave_of_one_way_is_no_wave_of_the_screw() {
    for seed in seeds(1, 6) {
        let wave = |row: &Row| {
            let size = if row.forward { 1.2 } else { 0.0 };
            size * libm::sin(TAU * 64.0 * row.share)
        };
        assert_ne!(on_a_slide(seed, &wave).verdict, Verdict::Explained, "{seed}");
    }
}
