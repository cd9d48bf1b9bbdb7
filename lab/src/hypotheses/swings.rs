//! Swings there and back whose length wanders, in noise of some slowness.
//!
//! Noise that forgets, at whatever rates, is never of the other sign a while later: what goes there and back
//! is, half a period later, wherever its frequency drifts to meanwhile, so that no line and no narrow band
//! shows it. The most negative autocorrelation is held against noise drawn from the fit at the same instants,
//! and against none, by its standard error (Bartlett 1946, *On the theoretical specification and sampling
//! properties of autocorrelated time series*, Supplement to the JRSS 8:27): a moving average forgets sooner
//! than any noise that is drawn.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use statrs::distribution::{ContinuousCDF, Normal};

use super::drawn::{OwnNoise, clearest, surest_share};
use super::excursions::are_readings;
use crate::model::{Fit, Problem};
use crate::noise::without_outliers;
use crate::numerics::least_squares::dot;
use crate::numerics::{count, mean};
use crate::policy::extent::HALF_A_SWING;
use crate::policy::reading::FAR_OUT;

/// Root mean square of what swings, µm (arcsec), and the chance of as much in noise; `None` where the file says
/// how sure each reading is.
#[must_use]
pub(super) fn swings(problem: &Problem, fit: &Fit) -> Option<(f64, f64)> {
    surest_share(problem, fit, |sensor| of_sensor(problem, fit, sensor))
}

/// Share of the square that is of the other sign later, and the chance of as much, of one sensor.
fn of_sensor(problem: &Problem, fit: &Fit, sensor: usize) -> Option<(f64, f64)> {
    let (own, rows) = OwnNoise::of(problem, fit, sensor);
    let finest = problem.least_variance[sensor].sqrt();
    let figures_of = |values: &[f64]| {
        let read = own.passes(values).filter(|pass| are_readings(pass, finest));
        figures(&read.collect::<Vec<_>>())
    };
    let found = figures_of(&fit.left[rows]);
    let drawn = |seed| at_halves(&figures_of(&own.drawn(&mut ChaCha8Rng::seed_from_u64(seed))));
    let halves = at_halves(&found);
    let (place, chance) = clearest(&halves, drawn)?;
    let (against, looks) = (halves[place], count(halves.len()));
    Some((against, chance.max((looks * against_none(&found, against, own.layout.len())).min(1.0))))
}

/// Chance that noise which has forgotten is by so much of the other sign.
fn against_none(found: &[f64], against: f64, rows: usize) -> f64 {
    let squares: f64 = found.iter().map(|one| one * one).sum();
    let error = ((1.0 + 2.0 * squares) / count(rows)).sqrt();
    Normal::standard().sf(against / error)
}

fn at_halves(all: &[f64]) -> Vec<f64> {
    HALF_A_SWING.iter().map(|apart| all[apart - 1]).collect()
}

/// By how much the values of passes are of the other sign one row later, two and so on, against their square.
fn figures(passes: &[&[f64]]) -> Vec<f64> {
    let centred: Vec<Vec<f64>> = passes.iter().map(|pass| centred(pass)).collect();
    let square: f64 = centred.iter().map(|pass| dot(pass, pass)).sum();
    let against = |apart: usize| {
        let pairs = centred.iter().filter(|pass| apart < pass.len());
        let product: f64 = pairs.map(|pass| dot(&pass[apart..], &pass[..pass.len() - apart])).sum();
        -product / square.max(f64::MIN_POSITIVE)
    };
    (1..=HALF_A_SWING[HALF_A_SWING.len() - 1]).map(against).collect()
}

fn centred(pass: &[f64]) -> Vec<f64> {
    let kept = without_outliers(pass, FAR_OUT);
    let middle = mean(&kept);
    kept.into_iter().map(|value| value - middle).collect()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::super::made_noise::{held, normal, of_many_lengths, slow};
    use super::*;

    /// Rows of a pass.
    const ROWS: usize = 350;

    /// The chance of two passes against noise that has forgotten, with the looks.
    fn chance_of(values: &[f64]) -> f64 {
        let found = figures(&values.chunks(ROWS).collect::<Vec<_>>());
        let most = at_halves(&found).into_iter().fold(0.0, f64::max);
        count(HALF_A_SWING.len()) * against_none(&found, most, values.len())
    }

    fn record(seed: u64, mut value: impl FnMut(&mut ChaCha8Rng, usize) -> f64) -> Vec<f64> {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        (0..2 * ROWS).map(|row| value(&mut random, row)).collect()
    }

    /// Noise that forgets sooner or later, readings that are held, and a mean that moves along.
    #[test]
    fn noise_that_forgets_does_not_swing() {
        for seed in 0..100 {
            let mut last = [0.0; 5];
            let moving = record(seed, |random, row| {
                last[row % 5] = normal(random);
                last.iter().sum()
            });
            let white = record(seed, |random, _| normal(random));
            let all = [white, moving, record(seed, slow()), record(seed, held())];
            for (which, values) in all.iter().enumerate() {
                assert!(1e-4 < chance_of(values), "{which} {seed}: {}", chance_of(values));
            }
            assert!(1e-4 < chance_of(&record(seed, of_many_lengths())), "{seed}");
        }
    }

    /// A pump that speeds up from a swing in seven rows to one in three.
    #[test]
    fn a_swing_of_any_frequency_does() {
        for seed in 0..10 {
            let swing = |row: usize| {
                let turns = count(row) / 7.0 + 0.5 * count(row * row) / count(2 * ROWS) / 6.0;
                2.0 * libm::sin(TAU * turns)
            };
            let values = record(seed, |random, row| swing(row) + normal(random));
            assert!(chance_of(&values) < 1e-9, "{seed}: {}", chance_of(&values));
        }
    }
}
