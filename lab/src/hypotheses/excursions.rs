//! Excursions that most of a record does not show: levels that switch, gusts, saw teeth, a bump one
//! way.
//!
//! Noise that is fitted to all of a record becomes as slow and as large as its excursions. But
//! stationary Gaussian noise, whatever its spectrum, changes as much in one place as in another: the
//! changes of its mean from one stretch to the next follow a normal law, of which the median says
//! what the largest may be. Each change is measured by how loud its neighbourhood is from sample to
//! sample, for a louder stretch is louder at every length, and outliers are cut off. How far the
//! largest stand out is held against noise drawn from the fit.

use std::iter::successors;
use std::ops::Range;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::drawn::{OwnNoise, clearest, surest};
use crate::model::{Fit, Problem};
use crate::noise::{weighed_rms, without_outliers};
use crate::numerics::{count, deviation, median};
use crate::policy::chance::FEWEST_CHANGES;
use crate::policy::extent::{LONGEST_STRETCH, LOUDNESS_ROWS, SHORTEST_STRETCH};
use crate::policy::reading::{HARDLY_CHANGES, LEAST_LOUD, MOST_OF_ROUNDING, OUTLIER_DEVIATIONS};

/// Power that the changes are raised to, for the few large ones to decide.
///
/// At 2 saw teeth and gusts stand out less, from 4 on bumps of several samples do.
const POWER: i32 = 3;

/// What stands out.
#[derive(Debug, Clone, Copy)]
pub(super) struct Excursions {
    /// Root mean square of it over the whole record, µm (arcsec).
    pub(super) rms_um: f64,
    /// Chance of as much in noise.
    pub(super) p_value: f64,
}

/// How far changes over stretches of one length stand out.
#[derive(Debug, Clone, Copy)]
struct Standing {
    /// Logarithm of their mean size against their usual one.
    out: f64,
    /// Share of their square beyond that of usual ones.
    share: f64,
}

/// What stands out of most of a record; `None` where it is too short to tell, or the file says how
/// sure each reading is, so that neighbours need not be alike.
#[must_use]
pub(super) fn excursions(problem: &Problem, fit: &Fit) -> Option<Excursions> {
    if problem.measurement.deviations.is_some() {
        return None;
    }
    let sensors = 0..problem.sensors.len();
    let of_sensor = |sensor| {
        let (own, rows) = OwnNoise::of(problem, fit, sensor);
        Own { own, finest: problem.least_variance[sensor] }.clearest(&fit.left[rows])
    };
    let found: Vec<(Standing, f64)> = sensors.filter_map(of_sensor).collect();
    let (standing, p_value) = surest(&found)?;
    let rms_um = weighed_rms(&problem.layout, &fit.left) * standing.share.sqrt();
    Some(Excursions { rms_um, p_value })
}

/// One sensor.
struct Own<'a> {
    own: OwnNoise<'a>,
    /// Variance below which its readings are all alike.
    finest: f64,
}

impl Own<'_> {
    /// The length of stretches at which changes stand out most, and the chance that any does so.
    fn clearest(&self, left: &[f64]) -> Option<(Standing, f64)> {
        // Readings on a lattice have many changes of exactly none.
        let mut dither = ChaCha8Rng::seed_from_u64(u64::MAX);
        let left = self.dithered(left, &mut dither);
        let blocks = self.own.layout.blocks.iter().map(|block| block.rows.clone());
        let passes: Vec<Range<usize>> =
            blocks.filter(|rows| are_readings(&left[rows.clone()], self.finest.sqrt())).collect();
        let out_of = |found: &[Standing]| found.iter().map(|one| one.out).collect::<Vec<_>>();
        let drawn = |seed| {
            let mut chance = ChaCha8Rng::seed_from_u64(seed);
            let noise = self.own.drawn(&mut chance);
            out_of(&standing(&passes, &self.dithered(&noise, &mut chance)))
        };
        let found = standing(&passes, &left);
        let (place, chance) = clearest(&out_of(&found), drawn)?;
        Some((found[place], chance))
    }

    /// Values with as much noise more as their lattice hides.
    fn dithered(&self, values: &[f64], dither: &mut ChaCha8Rng) -> Vec<f64> {
        let finest = self.finest.sqrt();
        let mut fine = |value: &f64| -> f64 {
            let normal: f64 = StandardNormal.sample(dither);
            value + finest * normal
        };
        values.iter().map(&mut fine).collect()
    }
}

/// True unless a quarter of the rows of a pass change, or change their change, by no more than rounding
/// does, which is next to nothing: they repeat the reading before, or lie on a line between two, and say
/// nothing of how loud the noise is.
pub(super) fn are_readings(values: &[f64], rounding: f64) -> bool {
    let changes: Vec<f64> = values.windows(2).map(|two| two[1] - two[0]).collect();
    let turns: Vec<f64> = changes.windows(2).map(|two| two[1] - two[0]).collect();
    [changes, turns].into_iter().all(|all| {
        let mut sizes: Vec<f64> = all.iter().map(|value| value.abs()).collect();
        sizes.sort_unstable_by(f64::total_cmp);
        let [small, large] = [sizes.get(sizes.len() / 4), sizes.get(9 * sizes.len() / 10)];
        small.zip(large).is_none_or(|(small, large)| {
            MOST_OF_ROUNDING * rounding < *small || HARDLY_CHANGES * large < *small
        })
    })
}

/// Per value the usual change from one to the next in its neighbourhood, and no less than a share of that
/// of the pass.
pub(super) fn loudness(values: &[f64]) -> Vec<f64> {
    let steps: Vec<f64> = values.windows(2).map(|two| (two[1] - two[0]).abs()).collect();
    let mut near = Vec::with_capacity(2 * LOUDNESS_ROWS);
    let around = |row: usize| {
        let to = (row + LOUDNESS_ROWS).min(steps.len());
        near.clear();
        near.extend_from_slice(&steps[row.saturating_sub(LOUDNESS_ROWS).min(to)..to]);
        median(&mut near)
    };
    let mut loudness: Vec<f64> = (0..values.len()).map(around).collect();
    let least = (LEAST_LOUD * median(&mut loudness.clone())).max(f64::MIN_POSITIVE);
    for one in &mut loudness {
        *one = one.max(least);
    }
    loudness
}

/// How far changes stand out, for each length of stretches that there are enough of.
fn standing(passes: &[Range<usize>], values: &[f64]) -> Vec<Standing> {
    let passes: Vec<Pass> = passes.iter().map(|rows| Pass::of(&values[rows.clone()])).collect();
    let lengths = successors(Some(SHORTEST_STRETCH), |length| Some(2 * length));
    let sizes = lengths.take_while(|&length| length <= LONGEST_STRETCH).map(|length| {
        passes.iter().filter_map(|pass| pass.changes(length)).flatten().collect::<Vec<_>>()
    });
    sizes.take_while(|sizes| !sizes.is_empty()).map(|sizes| Standing::of(&sizes)).collect()
}

/// One pass without its outliers.
struct Pass {
    /// Sums of the values before each row.
    sums: Vec<f64>,
    /// Of each row, see [`loudness()`].
    loudness: Vec<f64>,
}

impl Pass {
    fn of(values: &[f64]) -> Self {
        let kept = without_outliers(values, OUTLIER_DEVIATIONS);
        let loudness = loudness(&kept);
        let mut sum = 0.0;
        let sums = kept.iter().map(|value| {
            sum += value;
            sum
        });
        Self { sums: std::iter::once(0.0).chain(sums).collect(), loudness }
    }

    /// Sizes of the changes of the mean from one stretch to the next, half a stretch apart, against the
    /// loudness there and the usual one; `None` where they are too few to say what is usual.
    fn changes(&self, length: usize) -> Option<Vec<f64>> {
        let middles = length..(self.loudness.len() + 1).saturating_sub(length);
        let of = |middle: usize| {
            let [from, to] = [middle - length, middle + length].map(|row| self.sums[row]);
            let change = (from + to - 2.0 * self.sums[middle]) / count(length);
            change.abs() / self.loudness[middle]
        };
        let mut sizes: Vec<f64> = middles.step_by(length / 2).map(of).collect();
        let usual = deviation(&mut sizes).max(f64::MIN_POSITIVE);
        let against_usual = || sizes.iter().map(|size| size / usual).collect();
        (FEWEST_CHANGES <= sizes.len()).then(against_usual)
    }
}

impl Standing {
    /// Of sizes against their usual one.
    fn of(sizes: &[f64]) -> Self {
        let mean = |power: i32| {
            sizes.iter().map(|size| size.powi(power)).sum::<f64>() / count(sizes.len())
        };
        let out = libm::log(mean(POWER)) / f64::from(POWER);
        Self { out, share: (1.0 - 1.0 / mean(2)).max(0.0) }
    }
}

#[cfg(test)]
mod tests {
    use super::super::made_noise::{held, normal, of_many_lengths, slow};
    use super::*;
    use crate::noise::{Block, Layout, fit_noise};
    use rand_distr::{Exp1, StudentT};

    /// Chance of what two passes of 350 rows, read in steps, show under the noise that is fitted to
    /// them.
    fn chance_of(values: &[f64], step: f64) -> f64 {
        let block = |pass: usize| Block {
            sensor: 0,
            pass,
            rows: 350 * pass..350 * (pass + 1),
            loudness: 0,
        };
        let layout = Layout {
            blocks: vec![block(0), block(1)],
            clock: (0..values.len()).map(count).collect(),
            inflation: vec![1.0; values.len()].into(),
        };
        let noise = fit_noise(&layout, values, None).noise;
        Own { own: OwnNoise { layout, noise: &noise }, finest: step * step / 12.0 }
            .clearest(values)
            .map_or(1.0, |found| found.1)
    }

    /// Of 100 records of a noise hardly more fall below a chance than should: of a thousand skewed ones
    /// two fall below 1e-6.
    fn is_calibrated(what: &str, step: f64, mut noise: impl FnMut(&mut ChaCha8Rng, usize) -> f64) {
        let mut of_seed = |seed| {
            let mut random = ChaCha8Rng::seed_from_u64(seed);
            let values: Vec<f64> = (0..700).map(|row| noise(&mut random, row)).collect();
            chance_of(&values, step)
        };
        let chances: Vec<f64> = (0..100).map(&mut of_seed).collect();
        for (limit, most) in [(0.01, 6), (1e-3, 4), (1e-7, 0)] {
            let below = chances.iter().filter(|chance| **chance < limit).count();
            assert!(below <= most, "{what}: {below} of 100 below {limit}");
        }
    }

    #[test]
    #[ignore = "long: `cargo xtask campaign` runs it"]
    fn noise_has_none() {
        is_calibrated("white", 1.0, |random, _| normal(random));
        is_calibrated("skewed", 1.0, |random, _| Exp1.sample(random));
        is_calibrated("tails", 1.0, |random, _| StudentT::new(3.0).unwrap().sample(random));
        is_calibrated("rounded", 1.0, |random, _| normal(random).round());
        let louder = |row: usize| if (200..300).contains(&row) { 4.0 } else { 1.0 };
        is_calibrated("louder in places", 1.0, |random, row| louder(row) * normal(random));
    }

    #[test]
    fn held_and_interpolated_readings_have_none() {
        is_calibrated("every fourth", 0.01, held());
        let mut last = [0.0; 2];
        is_calibrated("between every fifth", 0.01, |random, row| {
            last = if row % 5 == 0 { [last[1], normal(random)] } else { last };
            last[0] + (last[1] - last[0]) * count(row % 5) / 5.0
        });
        let rounded = |value: f64, row| if row < 350 { 2.0 * (value / 2.0).round() } else { value };
        is_calibrated("one pass rounded", 0.01, |random, row| rounded(normal(random), row));
    }

    #[test]
    fn slow_noise_has_none() {
        is_calibrated("slow", 1.0, slow());
        is_calibrated("of many lengths", 1.0, of_many_lengths());
    }

    /// Gusts of six deviations that die away, and levels that switch by five.
    #[test]
    fn gusts_and_levels_stand_out() {
        for seed in 0..6 {
            let mut random = ChaCha8Rng::seed_from_u64(seed);
            let gust = |row: usize| 6.0 * libm::exp(-count(row % 90) / 8.0);
            let gusts: Vec<f64> = (0..700).map(|row| gust(row) + normal(&mut random)).collect();
            assert!(chance_of(&gusts, 1.0) < 1e-3, "{seed}");
            let level = |row: usize| if row % 130 < 40 { 5.0 } else { 0.0 };
            let levels: Vec<f64> = (0..700).map(|row| level(row) + normal(&mut random)).collect();
            assert!(chance_of(&levels, 1.0) < 1e-6, "{seed}");
        }
    }
}
