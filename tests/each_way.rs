//! What there and back do not share, in passes that run by turns, is told and no noise.

use helixlock_lab::{Diagnosis, Verdict};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::support::diagnosed::{self, is_nobodys, names};
use crate::support::passes::white;
use crate::support::seeds::seeds;

/// Four passes of two hundred rows by turns there and back, with noise of 0.1 µm and an error, µm, of
/// direction, way since the start of the pass and place, mm.
fn by_turns(seed: u64, error_um: &dyn Fn(f64, f64, f64) -> f64) -> Diagnosis {
    let mut chance = ChaCha8Rng::seed_from_u64(seed);
    let mut columns = [vec![], vec![], vec![], vec![]];
    for pass in 0..4 {
        let way = if pass % 2 == 0 { 1.0 } else { -1.0 };
        for row in 0..200 {
            let gone = 2.0 * f64::from(row);
            let mm = if pass % 2 == 0 { gone } else { 398.0 - gone };
            let noise: f64 = StandardNormal.sample(&mut chance);
            let error = 0.1 * noise + error_um(way, gone, mm);
            let cells = [f64::from(pass), 300.0 * f64::from(pass) + gone / 2.0, mm, error];
            columns.iter_mut().zip(cells).for_each(|(column, cell)| column.push(cell));
        }
    }
    let names = ["pass", "time_s", "position_mm", "error_um"];
    diagnosed::diagnosed(names.into_iter().zip(columns).collect())
}

/// The loop of a flexure: noise of a pass's length follows it, but not the same way every time.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_lens_between_there_and_back_is_no_noise() {
    is_nobodys(|seed| {
        by_turns(seed, &|way, _, mm| {
            let x = mm / 199.0 - 1.0;
            0.15 * way * (1.0 - x * x)
        })
    });
}

/// Play that a nut takes up over a way from each start on.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn play_that_each_start_takes_up_is_no_noise() {
    is_nobodys(|seed| by_turns(seed, &|way, gone, _| -0.4 * way * libm::exp(-gone / 40.0)));
}

/// A rail that is rough for the roller of one way alone: only every second pass repeats it.
#[test]
fn a_rough_rail_of_one_way_is_no_noise() {
    is_nobodys(|seed| {
        by_turns(seed, &|way, _, mm| {
            let rough =
                libm::sin(2.4 * mm + 3.0 * libm::sin(0.9 * mm)) * libm::sin(0.031 * mm * mm);
            if way < 0.0 { 0.0 } else { 0.25 * rough }
        })
    });
}

/// A turn of a table with a worm of 72, twice there and back in 400 more or less uneven rows, with noise of 1″ and
/// a wave of some phase each way.
fn worm(seed: u64, unevenness: f64, size_arcsec: f64, phase: impl Fn(f64) -> f64) -> Diagnosis {
    let table = "output.rotary = true\nspindle.speed = '1 rpm'\n\
                 gear = [{ name = 'worm', order = 72 }]\n";
    let (mut noise, mut uneven) = (white(seed, 1.0), white(seed + 100, 0.3));
    let mut turns = 0.0;
    let mut columns = [const { Vec::new() }; 5];
    for row in 0..400_u32 {
        let way = if row % 200 < 100 { 1.0 } else { -1.0 };
        turns += 0.005 * way * libm::exp(unevenness * uneven());
        let wave = libm::sin(std::f64::consts::TAU * 72.0 * turns + phase(way));
        let cells =
            [f64::from(row / 200), 0.7 * f64::from(row), turns, way, size_arcsec * wave + noise()];
        columns.iter_mut().zip(cells).for_each(|(column, cell)| column.push(cell));
    }
    let header = ["pass", "time_s", "angle_rev", "direction", "error_arcsec"];
    diagnosed::diagnosed_on(table, header.into_iter().zip(columns).collect())
}

/// A worm that lies against another flank each way has no phase that is that of both.
#[test]
fn a_wave_of_another_phase_each_way_is_not_explained_by_its_mean() {
    for seed in seeds(1, 12) {
        let apart = worm(seed, 3.0, 0.85, |way| 0.7 * way);
        assert_eq!(apart.verdict, Verdict::Unexplained, "{seed}");
        let alike = worm(seed, 3.0, 0.85, |_| 0.7);
        assert_eq!((alike.verdict, names(&alike)), (Verdict::Explained, vec!["gear-error"]));
    }
}

/// At one speed a sine in time may keep step with either way between two reversals, and two of them with both.
#[test]
fn a_worm_that_bears_on_another_flank_each_way_is_no_vibration() {
    for seed in seeds(1, 4) {
        let found = worm(seed, 0.03, 1.8, |way| 1.2 * way);
        assert_eq!(found.verdict, Verdict::Unexplained, "{seed}");
        assert!(names(&found).is_empty(), "{seed}: {:?}", names(&found));
    }
}
