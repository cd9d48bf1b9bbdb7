//! Levels, humps and teeth that noise of some slowness has swallowed.
//!
//! The best prediction of stationary Gaussian noise is a weighted sum of its last values, whatever
//! its spectrum. A level that lasts, a hump that comes and goes, a tooth that grows until it falls
//! are predicted better by squares and cubes of what was last (Keenan 1985, *A Tukey
//! nonadditivity-type test for time series nonlinearity*, Biometrika 72:39; Tsay 1986, *Nonlinearity
//! tests for time series*, Biometrika 73:461). What these add to the weighted sum is held against
//! Fisher's law, and against noise drawn at the same instants.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use statrs::distribution::{ContinuousCDF, FisherSnedecor};

use super::drawn::{OwnNoise, clearest, surest_share};
use super::excursions::{are_readings, loudness};
use crate::model::{Fit, Problem};
use crate::noise::without_outliers;
use crate::numerics::least_squares;
use crate::numerics::{count, deviation, mean, median, middle};
use crate::policy::extent::{JUST_BEFORE, LOUDNESS_ROWS, PREDICTED_BY, ROWS_A_LAG};
use crate::policy::reading::{CLEARLY_LOUDER, FAR_OUT, MOST_DEVIATIONS};

/// Root mean square of what is predicted so, µm (arcsec), and the chance of as much in noise; `None`
/// where a record is too short to tell, or the file says how sure each reading is.
#[must_use]
pub(super) fn nonlinearity(problem: &Problem, fit: &Fit) -> Option<(f64, f64)> {
    surest_share(problem, fit, |sensor| of_sensor(problem, fit, sensor))
}

/// Share and chance of one sensor. Rows that come unevenly are no linear series, for how far the last
/// values lie apart says how long ago they were: Fisher's law is held against noise drawn at the same
/// instants.
fn of_sensor(problem: &Problem, fit: &Fit, sensor: usize) -> Option<(f64, f64)> {
    let (own, rows) = OwnNoise::of(problem, fit, sensor);
    let finest = problem.least_variance[sensor].sqrt();
    let judged_of = |values: &[f64]| judged(&own.passes(values).collect::<Vec<_>>(), finest);
    let found = judged_of(&fit.left[rows])?;
    if WORTH_NOISE < found.chance {
        return Some((found.share, found.chance));
    }
    let drawn = |seed| {
        let noise = own.drawn(&mut ChaCha8Rng::seed_from_u64(seed));
        vec![judged_of(&noise).map_or(0.0, |one| one.root)]
    };
    let (_, chance) = clearest(&[found.root], drawn)?;
    Some((found.share, found.chance.max(chance)))
}

/// Chance below which it is held against drawn noise.
const WORTH_NOISE: f64 = 1e-3;

/// What powers add to the prediction.
struct Added {
    /// Share of what the last values leave of the next ones.
    share: f64,
    /// Cube root of Fisher's ratio, which follows a normal law nearly (Wilson and Hilferty 1931, *The
    /// distribution of chi-square*, PNAS 17:684).
    root: f64,
    /// Chance of as much by his law.
    chance: f64,
}

/// What the powers of the last values add, over the passes of one sensor.
fn judged(passes: &[&[f64]], finest: f64) -> Option<Added> {
    let mut rows = Rows::default();
    for pass in passes.iter().filter(|pass| are_readings(pass, finest)) {
        rows.add(&scaled(&without_outliers(pass, FAR_OUT)));
    }
    let freedom = rows.next.len().checked_sub(rows.linear.len() + rows.powers.len())?;
    if freedom < ROWS_A_LAG * rows.linear.len() {
        return None;
    }
    let linear = columns(&rows.linear);
    let both = columns(rows.linear.iter().chain(&rows.powers));
    let [before, after] = [linear, both].map(|columns| least_squares::fit(&columns, &rows.next));
    let more = after.rank.checked_sub(before.rank).filter(|more| 0 < *more)?;
    let explained = (before.residual_square - after.residual_square).max(0.0);
    let ratio = explained / count(more) / (after.residual_square / count(freedom));
    let law = FisherSnedecor::new(count(more), count(freedom)).ok()?;
    Some(Added {
        share: explained / before.residual_square.max(f64::MIN_POSITIVE),
        root: libm::cbrt(ratio),
        chance: law.sf(ratio),
    })
}

fn columns<'a>(all: impl IntoIterator<Item = &'a Vec<f64>>) -> Vec<&'a [f64]> {
    all.into_iter().map(Vec::as_slice).collect()
}

/// About the median of a pass, in its own deviations, and no farther out than a few of them.
fn scaled(pass: &[f64]) -> Vec<f64> {
    let middle = middle(&mut pass.to_vec());
    let mut sizes: Vec<f64> = pass.iter().map(|value| (value - middle).abs()).collect();
    let size = deviation(&mut sizes).max(f64::MIN_POSITIVE);
    let limited = |value: &f64| ((value - middle) / size).clamp(-MOST_DEVIATIONS, MOST_DEVIATIONS);
    pass.iter().map(limited).collect()
}

/// What is to be predicted, and what by, column by column.
#[derive(Default)]
struct Rows {
    next: Vec<f64>,
    linear: Vec<Vec<f64>>,
    powers: Vec<Vec<f64>>,
}

impl Rows {
    /// Adds the rows of a pass, those of loud places for less.
    fn add(&mut self, pass: &[f64]) {
        let loudness = loudness(pass);
        let usual = median(&mut loudness.clone()).max(f64::MIN_POSITIVE);
        // A median is late where a loud stretch begins or ends.
        let weight = |row: usize| {
            let near = row.saturating_sub(LOUDNESS_ROWS)..(row + LOUDNESS_ROWS).min(loudness.len());
            let louder = loudness[near].iter().fold(0.0_f64, |most, one| most.max(*one)) / usual;
            if CLEARLY_LOUDER < louder { 1.0 / louder } else { 1.0 }
        };
        for (row, next) in pass.iter().enumerate().skip(PREDICTED_BY) {
            let before = &pass[row - PREDICTED_BY..row];
            let last = before[PREDICTED_BY - 1];
            let [near, all] =
                [JUST_BEFORE, PREDICTED_BY].map(|n| mean(&before[PREDICTED_BY - n..]));
            let powers = [last, near, all].into_iter().flat_map(|one| [one * one, one * one * one]);
            let weight = weight(row);
            let weighed = |value: f64| value * weight;
            self.next.push(weighed(*next));
            push(&mut self.linear, before.iter().copied().chain([1.0]).map(weighed));
            push(&mut self.powers, powers.chain([last * all]).map(weighed));
        }
    }
}

/// One value more to each column.
fn push(columns: &mut Vec<Vec<f64>>, values: impl Iterator<Item = f64>) {
    for (place, value) in values.enumerate() {
        if columns.len() <= place {
            columns.push(Vec::new());
        }
        columns[place].push(value);
    }
}

#[cfg(test)]
mod tests {
    use super::super::made_noise::{held, normal, of_many_lengths, slow};
    use super::*;
    use rand_distr::{Distribution, Exp1, StudentT};

    /// Rows of a pass.
    const ROWS: usize = 350;

    /// Chance of two passes, read in steps.
    fn chance_of(values: &[f64], step: f64) -> f64 {
        let passes: Vec<&[f64]> = values.chunks(ROWS).collect();
        judged(&passes, step / f64::sqrt(12.0)).map_or(1.0, |found| found.chance)
    }

    /// Of 300 records hardly more fall below a chance than should.
    fn is_calibrated(what: &str, step: f64, mut noise: impl FnMut(&mut ChaCha8Rng, usize) -> f64) {
        let mut of_seed = |seed| {
            let mut random = ChaCha8Rng::seed_from_u64(seed);
            let values: Vec<f64> = (0..2 * ROWS).map(|row| noise(&mut random, row)).collect();
            chance_of(&values, step)
        };
        let chances: Vec<f64> = (0..300).map(&mut of_seed).collect();
        for (limit, most) in [(0.01, 12), (1e-3, 4), (1e-5, 0)] {
            let below = chances.iter().filter(|chance| **chance < limit).count();
            assert!(below <= most, "{what}: {below} of 300 below {limit}");
        }
    }

    #[test]
    fn swift_noise_of_any_law_has_none() {
        is_calibrated("white", 0.01, |random, _| normal(random));
        is_calibrated("skewed", 0.01, |random, _| Exp1.sample(random));
        is_calibrated("tails", 0.01, |random, _| StudentT::new(3.0).unwrap().sample(random));
        is_calibrated("rounded", 1.0, |random, _| normal(random).round());
        let louder = |row: usize| if (200..300).contains(&row) { 4.0 } else { 1.0 };
        is_calibrated("louder in places", 0.01, |random, row| louder(row) * normal(random));
        let bad = |row: usize| if row % 97 == 5 { 40.0 } else { 0.0 };
        is_calibrated("bad readings", 0.01, |random, row| bad(row) + normal(random));
    }

    #[test]
    fn slow_noise_has_none() {
        is_calibrated("slow", 0.01, slow());
        is_calibrated("of many lengths", 0.01, of_many_lengths());
        let mut walk = 0.0;
        is_calibrated("by steps of long tails", 0.01, |random, _| {
            let step: f64 = StudentT::new(4.0).unwrap().sample(random);
            walk = 0.9 * walk + step;
            walk
        });
    }

    #[test]
    fn held_and_rounded_readings_have_none() {
        is_calibrated("every fourth", 0.01, held());
        let rounded =
            |value: f64, row| if row < ROWS { 2.0 * (value / 2.0).round() } else { value };
        is_calibrated("one pass rounded", 0.01, |random, row| rounded(normal(random), row));
    }

    /// Teeth of uneven length, up to seven deviations high, and humps of four.
    #[test]
    fn teeth_and_humps_do() {
        for seed in 0..6 {
            let mut random = ChaCha8Rng::seed_from_u64(seed);
            let starts = [0_usize, 31, 47, 90, 118, 171, 190, 233, 271, 302, 330];
            let since = |row: usize| {
                starts.iter().rev().find(|at| **at <= row % ROWS).map_or(0, |at| row % ROWS - at)
            };
            let teeth: Vec<f64> =
                (0..2 * ROWS).map(|row| count(since(row)) / 6.0 + normal(&mut random)).collect();
            let hump = |row: usize| {
                let off = (count(since(row)) - 12.0) / 4.0;
                4.0 * libm::exp(-off * off)
            };
            let humps: Vec<f64> =
                (0..2 * ROWS).map(|row| hump(row) + normal(&mut random)).collect();
            let chances = [teeth, humps].map(|values| chance_of(&values, 0.01));
            assert!(chances.iter().all(|chance| *chance < 1e-5), "{seed}: {chances:?}");
        }
    }
}
