//! Noise of another kind than the model of the noise knows is nobody's effect.

use std::f64::consts::TAU;

use helixlock_lab::{Diagnosis, Verdict};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::support::diagnosed::{self, names};
use crate::support::seeds::{cases, seeds};

const ROWS: usize = 320;
const SPACING_MM: f64 = 2.0;
/// Deviation, µm.
const NOISE_UM: f64 = 0.05;

fn diagnosed(error_um: Vec<f64>) -> Diagnosis {
    let places =
        (0..ROWS).scan(0.0, |place, _| Some(std::mem::replace(place, *place + SPACING_MM)));
    diagnosed::diagnosed(vec![("position_mm", places.collect()), ("error_um", error_um)])
}

fn white(chance: &mut ChaCha8Rng, rows: usize) -> Vec<f64> {
    let drawn = StandardNormal.sample_iter(chance).take(rows);
    drawn.map(|value: f64| NOISE_UM * value).collect()
}

/// A wave of the machine's screw, ten standard errors.
fn wave(row: usize) -> f64 {
    let turns = SPACING_MM * f64::from(u32::try_from(row).expect("few rows")) / 10.0;
    0.04 * libm::sin(TAU * turns)
}

/// Forty readings beside a motor that runs.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_louder_stretch_is_no_wear() {
    for seed in seeds(2, 8) {
        let mut chance = ChaCha8Rng::seed_from_u64(seed);
        let mut noise = white(&mut chance, ROWS);
        let start = chance.random_range(20..ROWS - 60);
        noise[start..start + 40].iter_mut().for_each(|value| *value *= 4.0);
        let found = diagnosed(noise.clone());
        assert!(names(&found).is_empty(), "{seed}: {:?}", names(&found));
        noise.iter_mut().enumerate().for_each(|(row, value)| *value += 2.0 * wave(row));
        assert_eq!(names(&diagnosed(noise)), ["screw-periodic"], "{seed}");
    }
}

/// Passes on a day with more and less traffic.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn passes_of_unequal_noise_hold_no_band() {
    for seed in seeds(2, 8) {
        let mut chance = ChaCha8Rng::seed_from_u64(seed);
        let rows =
            || (0..6).flat_map(|pass| (0..300).map(move |row| (f64::from(pass), f64::from(row))));
        let mut error_um = Vec::new();
        for _ in 0..6 {
            let louder: f64 = StandardNormal.sample(&mut chance);
            let mut slow = 0.0;
            error_um.extend(white(&mut chance, 600).chunks(2).map(|drawn| {
                slow = 0.8 * slow + 0.6 * drawn[0];
                libm::exp(0.7 * louder) * (slow + 0.5 * drawn[1])
            }));
        }
        let found = diagnosed::diagnosed(vec![
            ("time_s", rows().map(|(pass, row)| 170.0 * pass + 0.5 * row).collect()),
            ("pass", rows().map(|(pass, _)| pass).collect()),
            ("position_mm", rows().map(|(_, row)| 2.0 * row).collect()),
            ("error_um", error_um),
        ]);
        assert_eq!(found.verdict, Verdict::NothingMissing, "{seed}");
    }
}

/// What an instrument with a filter writes: means that overlap, twice over.
/// One record in thirty still gets the name of wear beside `unexplained`: of a few none.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn filtered_noise_is_hardly_an_effect() {
    const OVER: usize = 7;
    let asked = seeds(2, 8);
    let may_be = asked.end / 8;
    let named = asked.filter(|&seed| {
        let mut noise = white(&mut ChaCha8Rng::seed_from_u64(seed), ROWS + 2 * OVER);
        for _ in 0..2 {
            let means = noise.windows(OVER).map(|part| part.iter().sum::<f64>() / 7.0_f64.sqrt());
            noise = means.collect();
        }
        !names(&diagnosed(noise[..ROWS].to_vec())).is_empty()
    });
    assert!(named.count() as u64 <= may_be);
}

/// A display that goes on with the mean of its last twelve readings, in pauses too: a vibration of each record was
/// named.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn running_means_have_no_name() {
    const OVER: usize = 12;
    for &seed in cases(1, &[1, 80, 127]) {
        let drawn = white(&mut ChaCha8Rng::seed_from_u64(seed), 900 + OVER);
        let means = drawn.windows(OVER).map(|part| part.iter().sum::<f64>()).take(900);
        let rows = || (0..900).map(|row| (f64::from(row / 300), f64::from(row % 300)));
        let found = diagnosed::diagnosed(vec![
            ("time_s", (0..900).map(f64::from).collect()),
            ("pass", rows().map(|(pass, _)| pass).collect()),
            ("position_mm", rows().map(|(_, row)| 2.0 * row).collect()),
            ("error_um", means.collect()),
        ]);
        assert!(names(&found).is_empty(), "{seed}: {:?}", names(&found));
    }
}

/// Even noise hides no more than it did.
#[test]
fn a_wave_in_even_noise_is_named() {
    for seed in seeds(2, 8) {
        let noise = white(&mut ChaCha8Rng::seed_from_u64(seed), ROWS);
        let error_um = noise.iter().enumerate().map(|(row, value)| value + wave(row)).collect();
        assert_eq!(names(&diagnosed(error_um)), ["screw-periodic"], "{seed}");
    }
}

/// Four passes, one of them beside a motor that runs, and a wave of the screw, which is as sure as the three quiet ones
/// make it: all four alike, its error is twice that, and in noise with a memory it was slow noise.
#[test]
fn a_louder_pass_weighs_less() {
    for (kept, loudness) in [(0.0, 4.0), (0.8, 6.0)] {
        for seed in seeds(2, 8) {
            let mut chance = ChaCha8Rng::seed_from_u64(seed);
            let mut slow = 0.0;
            let rows = (0..4 * 120_u32).map(|row| {
                let (pass, place_mm) = (row / 120, 1.7 * f64::from(row % 120));
                let kick: f64 = StandardNormal.sample(&mut chance);
                slow = kept * slow + f64::sqrt(1.0 - kept * kept) * kick;
                let size = if pass == 1 { loudness } else { 1.0 };
                let error_um = 0.03 * libm::sin(TAU * place_mm / 5.0) + size * NOISE_UM * slow;
                [f64::from(pass), f64::from(row + 400 * pass), place_mm, error_um]
            });
            let titles = ["pass", "time_s", "position_mm", "error_um"];
            let axis = "spindle.speed = \"60 rpm\"\nlead_screw.lead = \"5 mm\"\n";
            let found = diagnosed::diagnosed_on(axis, diagnosed::columns(titles, rows));
            assert_eq!(names(&found), ["screw-periodic"], "{kept} {seed}");
            assert_eq!(found.verdict, Verdict::Explained, "{kept} {seed}");
            let amplitude = &found.rounds.last().expect("a round").effects[0].parameters[0];
            let error = amplitude.stderr.expect("an error");
            assert!(error < 0.005, "{kept} {seed}: {amplitude:?}");
            assert!((amplitude.value - 0.03).abs() < 3.0 * error, "{kept} {seed}: {amplitude:?}");
        }
    }
}

/// Five passes of a screw of two known effects in noise of a tenth of its wave, the last of which is spoilt.
fn spoilt(seed: u64, spoil: impl Fn(&mut [f64])) -> Diagnosis {
    let known = "spindle.speed = \"60 rpm\"\nlead_screw.lead = \"10 mm\"\n\
                 [[effect]]\nkind = \"screw-periodic\"\namplitude = \"3 um\"\nphase = \"20 deg\"\n\
                 [[effect]]\nkind = \"screw-progressive\"\nlinear = \"40 um/m\"\n";
    let table = |error_um: Vec<f64>| {
        let rows = (0..5 * 84_u32).zip(error_um).map(|(row, error_um)| {
            [f64::from(row / 84), f64::from(row), 4.7 * f64::from(row % 84), error_um]
        });
        diagnosed::columns(["pass", "time_s", "position_mm", "error_um"], rows)
    };
    let bare = diagnosed::problem_of(known, table(vec![0.0; 5 * 84]));
    let mut chance = ChaCha8Rng::seed_from_u64(seed);
    let noise = StandardNormal.sample_iter(&mut chance);
    let said = bare.residual().into_iter().zip(noise);
    let mut error_um: Vec<f64> = said.map(|(left, noise): (f64, f64)| 0.3 * noise - left).collect();
    spoil(&mut error_um[4 * 84..]);
    diagnosed::diagnosed_on(known, table(error_um))
}

/// What makes one pass of five many times as loud is weighed away, and no all-clear for that.
#[test]
fn a_pass_that_was_spoilt_gets_no_all_clear() {
    for seed in seeds(2, 8) {
        assert_eq!(spoilt(seed, |_| {}).verdict, Verdict::NothingMissing, "{seed}");
        let half_back = spoilt(seed, |pass| pass[42..].reverse());
        assert_ne!(half_back.verdict, Verdict::NothingMissing, "{seed}");
        let loud = spoilt(seed, |pass| {
            let rattles = (1..=84_u32).map(|row| 6.0 * libm::sin(37.0 * f64::from(row * row)));
            pass.iter_mut().zip(rattles).for_each(|(value, more)| *value += more);
        });
        assert_eq!(loud.verdict, Verdict::Unexplained, "{seed}");
        assert!(
            loud.residual[0].shape.contains("times as loud as the others"),
            "{:?}",
            loud.residual[0].shape
        );
    }
}
