//! Readings that lost their sign when they were written down.
//!
//! Such a reading is off by twice itself: far from its neighbours, so that a fit takes it for a bad one, and with
//! its sign turned where they are. How likely it is that some are so is held against the likelihood that all are
//! as they were read, in noise of any tails, to which a bad one belongs, and that some are turned about one value of
//! their pass, as skewed noise and readings of few steps may be: only where they should have read different values
//! does a sign tell.

use std::ops::Range;

use statrs::distribution::{Continuous, StudentsT};

use super::drawn::surest_share_of;
use crate::model::{Fit, Problem};
use crate::noise::{departures, rms};
use crate::numerics::{chi_squared_tail, deviation, middle};
use crate::policy::chance::SIGNIFICANCE;
use crate::policy::reading::{BEYOND_NOISE, SIGNS_LOST};

/// Root mean square of readings of the other sign, µm (arcsec), and the chance of as many; `None` where the file
/// says how sure each reading is.
#[must_use]
pub(super) fn lost_signs(problem: &Problem, fit: &Fit) -> Option<(f64, f64)> {
    surest_share_of(problem, rms(&problem.layout, &fit.left), |sensor| {
        let of_sensor = problem.layout.blocks.iter().filter(|block| block.sensor == sensor);
        let passes = of_sensor.map(|block| block.rows.clone());
        // Between two steps of a display a reading is either, and of either sign about zero.
        let step = (12.0 * problem.least_variance[sensor]).sqrt();
        share(passes, &fit.left, &problem.observed, step)
    })
}

/// The same of one sensor, as a share of the square of all rows.
fn share(
    passes: impl Iterator<Item = Range<usize>>,
    left: &[f64],
    observed: &[f64],
    step: f64,
) -> Option<(f64, f64)> {
    let rows = |rows: Range<usize>| rows_of(&left[rows.clone()], &observed[rows]);
    let rows: Vec<Row> = passes.flat_map(rows).collect();
    let usual = deviation(&mut rows.iter().map(|row| row.off.abs()).collect::<Vec<_>>());
    let usual = usual.max(step);
    let is_turned = |row: &&Row| {
        row.turned().abs() < BEYOND_NOISE * usual && BEYOND_NOISE * usual < row.off.abs()
    };
    let lost: Vec<&Row> = rows.iter().filter(is_turned).collect();
    if lost.is_empty() {
        return None;
    }
    let [none, found] = likelihoods(&rows, Row::turned, usual);
    let by_chance = |otherwise: f64| chi_squared_tail(2.0 * (found - otherwise), 1.0);
    let chance = by_chance(none);
    let about_one_value = |lost: &&Row| {
        let aside = lost.expected - lost.middle;
        let turned = |row: &Row| -row.off - 2.0 * (row.middle + aside);
        by_chance(likelihoods(&rows, turned, usual)[1])
    };
    let chance = match chance {
        0.0..SIGNIFICANCE => {
            let some = lost.iter().step_by(lost.len().div_ceil(VALUES));
            some.map(about_one_value).fold(chance, f64::max)
        }
        _ => chance,
    };
    let square = |row: &Row| row.off * row.off;
    let of_lost: f64 = lost.into_iter().map(square).sum();
    Some((of_lost / rows.iter().map(square).sum::<f64>(), chance))
}

/// A reading.
struct Row {
    /// What it is off its neighbours by.
    off: f64,
    /// What should have been read.
    expected: f64,
    /// The middle of that in its pass.
    middle: f64,
}

impl Row {
    /// What it is off by with its sign turned.
    fn turned(&self) -> f64 {
        -self.off - 2.0 * self.expected
    }
}

/// The readings of a pass.
fn rows_of(left: &[f64], observed: &[f64]) -> Vec<Row> {
    let zero = middle(&mut left.to_vec());
    let expected: Vec<f64> =
        observed.iter().zip(left).map(|(read, left)| read - (left - zero)).collect();
    let middle = middle(&mut expected.clone());
    let off = departures(left).into_iter();
    off.zip(expected).map(|(off, expected)| Row { off, expected, middle }).collect()
}

/// Most values about which rows are turned.
const VALUES: usize = 20;

/// Degrees of freedom of the tails that are tried: from a bad reading in four to none.
const TAILS: [f64; 6] = [1.0, 1.5, 2.0, 3.0, 6.0, 200.0];

/// Widths of the bulk that are tried, against the usual departure, which readings of the other sign widen.
const WIDTHS: [f64; 6] = [0.5, 0.6, 0.72, 0.86, 1.0, 1.2];

/// Logarithms of the likelihoods that no row is turned, and that a share of them is, at the best share, each at the
/// best tail and width.
fn likelihoods(rows: &[Row], turned: impl Fn(&Row) -> f64, usual: f64) -> [f64; 2] {
    let laws = TAILS.iter().flat_map(|tail| WIDTHS.iter().map(|width| (usual * width, *tail)));
    let of_law = |(width, tail): (f64, f64)| {
        let law = StudentsT::new(0.0, width, tail).ok()?;
        let density = |row: &Row| (law.pdf(row.off), law.pdf(turned(row)));
        let densities: Vec<(f64, f64)> = rows.iter().map(density).collect();
        let of_share = |share: f64| -> f64 {
            let rows = densities.iter();
            rows.map(|(off, turned)| libm::log((1.0 - share) * off + share * turned)).sum()
        };
        let some = SIGNS_LOST.map(of_share).into_iter().fold(f64::NEG_INFINITY, f64::max);
        Some([of_share(0.0), some])
    };
    let best = |best: [f64; 2], one: [f64; 2]| [best[0].max(one[0]), best[1].max(one[1])];
    laws.filter_map(of_law).fold([f64::NEG_INFINITY; 2], best)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::super::made_noise::normal;
    use super::*;
    use crate::numerics::count;
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StudentT};

    /// Rows of two passes.
    const ROWS: usize = 60;

    /// A play that a display shows as one step or two, to either side of zero.
    #[test]
    fn readings_of_few_steps_have_lost_no_sign() {
        let play = |row: usize| if row < ROWS / 2 { -0.4 } else { 0.4 };
        let found = (0..300).filter(|seed| {
            let mut random = ChaCha8Rng::seed_from_u64(*seed);
            let read = |row| (play(row) + 0.5 * normal(&mut random)).round();
            let observed: Vec<f64> = (0..ROWS).map(read).collect();
            let left: Vec<f64> =
                observed.iter().enumerate().map(|(row, read)| read - play(row)).collect();
            let passes = [0..ROWS / 2, ROWS / 2..ROWS].into_iter();
            share(passes, &left, &observed, 1.0).is_some_and(|(_, chance)| chance < 1e-3)
        });
        assert_eq!(found.count(), 0);
    }

    /// Chance that signs were lost of a wave of eight units, some rows of which are read otherwise.
    fn chance(seed: u64, mut read: impl FnMut(&mut ChaCha8Rng, f64) -> f64) -> f64 {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let wave: Vec<f64> =
            (0..ROWS).map(|row| 8.0 * libm::sin(TAU * count(row) / 20.0)).collect();
        let observed: Vec<f64> = wave.iter().map(|true_um| read(&mut random, *true_um)).collect();
        let left: Vec<f64> = observed.iter().zip(&wave).map(|(read, wave)| read - wave).collect();
        let passes = [0..ROWS / 2, ROWS / 2..ROWS].into_iter();
        share(passes, &left, &observed, 0.01).map_or(1.0, |(_, chance)| chance)
    }

    #[test]
    fn signs_that_were_lost_are_told_from_bad_readings() {
        let one_in = |random: &mut ChaCha8Rng, share: f64| random.random::<f64>() < share;
        let lost = |random: &mut ChaCha8Rng, value: f64| {
            let read = value + normal(random);
            if one_in(random, 0.15) { -read } else { read }
        };
        let found = (0..100).filter(|seed| chance(*seed, lost) < 1e-4).count();
        assert!(80 <= found, "{found}");
        let knocked = |random: &mut ChaCha8Rng, value: f64| {
            value + normal(random) + if one_in(random, 0.1) { 16.0 * normal(random) } else { 0.0 }
        };
        let tails = |random: &mut ChaCha8Rng, value: f64| {
            value + StudentT::new(2.0).unwrap().sample(random)
        };
        let below = |what: &str, chances: Vec<f64>| {
            let found = chances.iter().filter(|chance| **chance < 1e-3).count();
            assert!(found <= 5, "{what}: {found}");
        };
        below("knocked", (0..1000).map(|seed| chance(seed, knocked)).collect());
        below("tails", (0..1000).map(|seed| chance(seed, tails)).collect());
    }
}
