//! Whether a residual would look the same backwards in time.
//!
//! Noise would: independent samples of any law, skewed, rounded or clipped, every stationary
//! Gaussian noise whatever its spectrum (Weiss 1975, *Time-reversibility of linear stochastic
//! processes*, J. Appl. Prob. 12:831), and what has no preferred sign. Stick and slip does not: it
//! creeps one way and jumps back.
//!
//! The residual is differenced over neighbouring stretches, and of each run of one sign the largest
//! difference is kept: rises and falls then take turns. Backwards in time a fall is a rise, so that
//! a rise and the fall behind it change places: which of a pair is the larger is even chance. The
//! sum of what the pairs differ by is held against all signs that these might have had, by
//! Chernoff's bound: no law of the noise is needed, and no number of samples.

use std::ops::Range;

use super::repeatability::between_turns;
use crate::model::{Fit, Problem};
use crate::noise::rms;
use crate::numerics::{count, golden_maximum, mean};
use crate::policy::extent::REVERSED_STRETCHES;

/// Power that sizes are raised to: a few large jumps among many small ones of noise decide.
///
/// Any odd law of the sizes keeps the chances right; this one was the most sensitive of 1, 2, 3, 4
/// and 6 on saw teeth of uneven length, of 12 to 40 standard errors.
const POWER: i32 = 6;

/// Steepest tilt that the bound is sought at, against the largest pair.
///
/// Where all pairs agree any bound goes on falling: at 200 a pair of a fiftieth of the largest lacks
/// a thousandth of its factor of two.
const STEEPEST: f64 = 200.0;

/// Steps of that search: to a hundred-thousandth.
const STEPS: usize = 32;

/// A pair of neighbouring extremes.
#[derive(Debug, Clone, Copy)]
struct Pair {
    rise: f64,
    fall: f64,
}

impl Pair {
    /// By how much the rise is the larger.
    fn excess(self) -> f64 {
        self.rise.powi(POWER) - self.fall.powi(POWER)
    }
}

/// Usual size of the jumps, µm (arcsec), and the chance of as much in noise.
///
/// Both the sign in time and, where passes run both ways, the one along the travel are looked at.
/// `None` where a record is too short for any pair.
#[must_use]
pub(super) fn one_way(problem: &Problem, fit: &Fit) -> Option<(f64, f64)> {
    let noise_um = rms(&problem.layout, &fit.left);
    let direction = |row: usize| problem.record.direction[problem.samples[row]];
    let blocks = problem.layout.blocks.iter();
    let of_block = |rows: Range<usize>| strokes(&fit.left, rows, direction);
    let strokes: Vec<_> = blocks.flat_map(|block| of_block(block.rows.clone())).collect();
    let (size, chance) = judged(&strokes)?;
    Some((noise_um * size, chance))
}

/// Values from one reversal of a pass to the next, with their way: behind it jumps go the other way.
fn strokes(
    left: &[f64],
    rows: Range<usize>,
    direction: impl Fn(usize) -> f64,
) -> Vec<(&[f64], f64)> {
    let way = |row: usize| if direction(row) < 0.0 { -1.0 } else { 1.0 };
    let all = between_turns(rows, &direction).into_iter();
    all.map(|rows| (&left[rows.clone()], way(rows.start))).collect()
}

/// Size of the jumps against the noise, and the chance, over some strokes and their ways.
fn judged(blocks: &[(&[f64], f64)]) -> Option<(f64, f64)> {
    let both_ways = blocks.iter().any(|(_, way)| *way < 0.0) && blocks.iter().any(|b| 0.0 < b.1);
    let mut looked = 0.0;
    let mut best: Option<(f64, f64)> = None;
    for stretch in REVERSED_STRETCHES {
        let in_time: Vec<Vec<f64>> =
            blocks.iter().map(|(values, _)| excesses(values, stretch)).collect();
        let along = in_time.iter().zip(blocks).flat_map(|(all, (_, way))| {
            all.iter().map(move |excess| way * excess).collect::<Vec<_>>()
        });
        let along: Option<Vec<f64>> = both_ways.then(|| along.collect());
        for excesses in std::iter::once(in_time.concat()).chain(along) {
            looked += 1.0;
            let chance = chance(&excesses);
            if best.is_none_or(|(_, least)| chance < least) {
                best = Some((usual_jump(&excesses), chance));
            }
        }
    }
    best.map(|(size, chance)| (size, (looked * chance).min(1.0)))
}

/// What the pairs of a pass differ by, in units of its own size: passes may differ in noise.
fn excesses(values: &[f64], stretch: usize) -> Vec<f64> {
    let square: f64 = values.iter().map(|value| value * value).sum();
    let size = (square / count(values.len().max(1))).sqrt();
    if size <= 0.0 {
        return Vec::new();
    }
    let sized = |pair: Pair| Pair { rise: pair.rise / size, fall: pair.fall / size };
    pairs(values, stretch).into_iter().map(|pair| sized(pair).excess()).collect()
}

/// The largest rise and fall, by turns, of the means of neighbouring stretches.
fn pairs(values: &[f64], stretch: usize) -> Vec<Pair> {
    let change = |both: &[f64]| mean(&both[stretch..]) - mean(&both[..stretch]);
    let mut extremes: Vec<f64> = Vec::new();
    for change in values.windows(2 * stretch).map(change).filter(|change| change.abs() > 0.0) {
        match extremes.last_mut() {
            Some(last) if 0.0 < *last * change => {
                *last = last.abs().max(change.abs()).copysign(change);
            }
            _ => extremes.push(change),
        }
    }
    let from = usize::from(extremes.first().is_some_and(|first| *first < 0.0));
    let of_two = |two: &[f64]| Pair { rise: two[0], fall: -two[1] };
    extremes.get(from..).unwrap_or_default().chunks_exact(2).map(of_two).collect()
}

/// Largest chance that so large a sum, either way, has by even signs: `2·min exp(−t·s)·∏ cosh(t·a)`.
fn chance(excesses: &[f64]) -> f64 {
    let largest = excesses.iter().fold(0.0_f64, |most, one| most.max(one.abs()));
    if largest <= 0.0 {
        return 1.0;
    }
    let scaled = || excesses.iter().map(|one| one / largest);
    let sum = scaled().sum::<f64>().abs();
    // ln cosh x without overflow.
    let ln_cosh = |x: f64| x + libm::log1p(libm::exp(-2.0 * x)) - std::f64::consts::LN_2;
    let mut evidence = |t: f64| t * sum - scaled().map(|one| ln_cosh(t * one.abs())).sum::<f64>();
    // Every `t` gives a bound, the best one the least.
    let (_, best) = golden_maximum(&mut evidence, (0.0, STEEPEST), STEPS);
    (2.0 * libm::exp(-best)).min(1.0)
}

/// Size of the jumps that decide: half of all that speaks for the larger side is in such or larger.
fn usual_jump(excesses: &[f64]) -> f64 {
    let side = excesses.iter().sum::<f64>();
    let mut own: Vec<f64> =
        excesses.iter().filter(|one| 0.0 < side * **one).map(|one| one.abs()).collect();
    own.sort_by(|a, b| b.total_cmp(a));
    let all: f64 = own.iter().sum();
    let mut sum = 0.0;
    let half = own.iter().find(|one| {
        sum += **one;
        0.5 * all <= sum
    });
    half.map_or(0.0, |one| libm::pow(*one, 1.0 / f64::from(POWER)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{ChiSquared, Distribution, Exp1, StandardNormal, StudentT};

    /// Three passes of 300 rows, the second the other way.
    fn chance_of(mut noise: impl FnMut() -> f64) -> f64 {
        let passes: Vec<Vec<f64>> = (0..3).map(|_| (0..300).map(|_| noise()).collect()).collect();
        let ways = [1.0, -1.0, 1.0];
        let blocks: Vec<(&[f64], f64)> =
            passes.iter().zip(ways).map(|(pass, way)| (pass.as_slice(), way)).collect();
        judged(&blocks).unwrap().1
    }

    /// Of 300 records at most as many fall below a chance as it says, and three more.
    fn is_calibrated(what: &str, mut noise: impl FnMut(&mut ChaCha8Rng) -> f64) {
        let of_seed = |seed| {
            let mut random = ChaCha8Rng::seed_from_u64(seed);
            chance_of(|| noise(&mut random))
        };
        let chances: Vec<f64> = (0..300).map(of_seed).collect();
        for limit in [0.1, 0.01, 1e-3] {
            let below = chances.iter().filter(|chance| **chance < limit).count();
            assert!(count(below) <= 300.0 * limit + 3.0, "{what}: {below} of 300 below {limit}");
        }
    }

    #[test]
    fn noise_of_any_law_is_the_same_backwards() {
        is_calibrated("white", |random| StandardNormal.sample(random));
        is_calibrated("skewed", |random| Exp1.sample(random));
        is_calibrated("more skewed", |random| ChiSquared::new(1.0).unwrap().sample(random));
        is_calibrated("tails", |random| StudentT::new(2.0).unwrap().sample(random));
        let normal = |random: &mut ChaCha8Rng| -> f64 { StandardNormal.sample(random) };
        is_calibrated("clipped", |random| normal(random).max(-0.3));
        is_calibrated("rounded", |random| normal(random).round());
    }

    #[test]
    fn slow_noise_is_the_same_backwards() {
        for memory in [0.5, 0.9, 0.98] {
            let mut last = 0.0;
            is_calibrated("slow", |random| {
                let step: f64 = StandardNormal.sample(random);
                last = memory * last + step;
                last
            });
        }
        let (mut last, mut before) = (0.0, 0.0);
        is_calibrated("resonant", |random| {
            let step: f64 = StandardNormal.sample(random);
            (last, before) = (1.7 * last - 0.94 * before + step, last);
            last
        });
    }

    /// Saw teeth of uneven length and a jump of four deviations, the other way on the way back.
    #[test]
    fn stick_and_slip_is_not() {
        let mut random = ChaCha8Rng::seed_from_u64(7);
        let mut pass = |way: f64| -> Vec<f64> {
            let (mut held, mut need) = (0.0, 4.0);
            (0..300)
                .map(|_| {
                    held += 0.25;
                    if need < held {
                        let part: f64 = StandardNormal.sample(&mut random);
                        (held, need) = (0.0, 4.0 + 0.8 * part.clamp(-2.0, 2.0));
                    }
                    let noise: f64 = StandardNormal.sample(&mut random);
                    way * held + noise
                })
                .collect()
        };
        let passes = [pass(1.0), pass(-1.0), pass(1.0)];
        let blocks = [(&passes[0][..], 1.0), (&passes[1][..], -1.0), (&passes[2][..], 1.0)];
        let (_, chance) = judged(&blocks).unwrap();
        assert!(chance < 1e-5, "{chance}");

        // The same in one pass, there and back and there again.
        let joined = passes.concat();
        let way = |row: usize| if row / 300 == 1 { -1.0 } else { 1.0 };
        let strokes = strokes(&joined, 0..joined.len(), way);
        let chance_of = |strokes: &[(&[f64], f64)]| judged(strokes).unwrap().1;
        let (by_strokes, whole) = (chance_of(&strokes), chance_of(&[(&joined, 1.0)]));
        assert!(by_strokes < 1e-5 && 1e-3 < whole, "{by_strokes} {whole}");
    }
}
