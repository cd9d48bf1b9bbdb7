//! Levels that an error switches between, and bounds that it swings between, in noise of some slowness.
//!
//! Noise is fitted as slow and as large as the levels are. But Gaussian noise of any spectrum has most of its
//! values in the middle, where an error that switches has none: cut in two, the halves of such noise differ by
//! 2/π of the square (Otsu 1979, *A threshold selection method from gray-level histograms*, IEEE Transactions
//! on Systems, Man, and Cybernetics 9:62), two levels by all of it. Means of a few rows are cut, for of white
//! noise with bounds, as rounding has, they are nearly normal; and the share is held against noise drawn from
//! the fit.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::drawn::{OwnNoise, clearest, surest_share};
use super::excursions::are_readings;
use crate::model::{Fit, Problem};
use crate::noise::without_outliers;
use crate::numerics::{count, mean};
use crate::policy::extent::{FEWEST_CUT_IN_TWO, ROWS_OF_A_LEVEL};
use crate::policy::reading::FAR_OUT;

/// Root mean square of what lies at levels, µm (arcsec), and the chance of as much in noise; `None` where a
/// record is too short to tell, or the file says how sure each reading is.
#[must_use]
pub(super) fn levels(problem: &Problem, fit: &Fit) -> Option<(f64, f64)> {
    surest_share(problem, fit, |sensor| of_sensor(problem, fit, sensor))
}

/// Share of the square by which the halves differ, and the chance of as much, of one sensor.
fn of_sensor(problem: &Problem, fit: &Fit, sensor: usize) -> Option<(f64, f64)> {
    let (own, rows) = OwnNoise::of(problem, fit, sensor);
    let finest = problem.least_variance[sensor].sqrt();
    let figures_of = |values: &[f64]| {
        let read = own.passes(values).filter(|pass| are_readings(pass, finest));
        figures(&read.collect::<Vec<_>>())
    };
    let found = figures_of(&fit.left[rows]);
    let drawn = |seed| figures_of(&own.drawn(&mut ChaCha8Rng::seed_from_u64(seed)));
    let (place, chance) = clearest(&found, drawn)?;
    Some((found[place], chance))
}

/// Share of the square of means of so many rows by which the halves of a pass differ, for each number of
/// rows that leaves enough of them.
fn figures(passes: &[&[f64]]) -> Vec<f64> {
    let share = |rows: &usize| {
        let means: Vec<Vec<f64>> = passes
            .iter()
            .map(|pass| without_outliers(pass, FAR_OUT).chunks_exact(*rows).map(mean).collect())
            .filter(|means: &Vec<f64>| FEWEST_CUT_IN_TWO <= means.len())
            .collect();
        let cut: Vec<(f64, f64)> = means.iter().map(|means| cut_in_two(means)).collect();
        let (between, all) = cut.iter().fold((0.0, 0.0), |sum, cut| (sum.0 + cut.0, sum.1 + cut.1));
        if 0.0 < all { between / all } else { 0.0 }
    };
    ROWS_OF_A_LEVEL.iter().map(share).collect()
}

/// The largest square between two parts of some values, below and above a cut, and the square of all.
fn cut_in_two(values: &[f64]) -> (f64, f64) {
    let middle = mean(values);
    let mut sorted: Vec<f64> = values.iter().map(|value| value - middle).collect();
    sorted.sort_unstable_by(f64::total_cmp);
    let all = sorted.iter().map(|value| value * value).sum();
    let (mut below, mut most) = (0.0, 0.0_f64);
    for (lower, value) in sorted.iter().enumerate().take(sorted.len().saturating_sub(1)) {
        below += value;
        let (lower, upper) = (count(lower + 1), count(sorted.len() - lower - 1));
        most = most.max(below * below * (1.0 / lower + 1.0 / upper));
    }
    (most, all)
}

#[cfg(test)]
mod tests {
    use super::super::made_noise::{held, normal, of_many_lengths, slow};
    use super::*;
    use rand_distr::{Distribution, Exp1, StudentT, Uniform};

    /// Rows of a pass.
    const ROWS: usize = 350;

    /// Mean and deviation of the largest share over 200 records of two passes.
    fn of_noise(mut noise: impl FnMut(&mut ChaCha8Rng, usize) -> f64) -> (f64, f64) {
        let mut of_seed = |seed| {
            let mut random = ChaCha8Rng::seed_from_u64(seed);
            let values: Vec<f64> = (0..2 * ROWS).map(|row| noise(&mut random, row)).collect();
            figures(&values.chunks(ROWS).collect::<Vec<_>>()).into_iter().fold(0.0, f64::max)
        };
        let all: Vec<f64> = (0..200).map(&mut of_seed).collect();
        let middle = mean(&all);
        let square = all.iter().map(|one| (one - middle).powi(2)).sum::<f64>() / 200.0;
        (middle, square.sqrt())
    }

    /// Means of two rows of white noise of any law are hardly farther from the middle than those of normal noise.
    #[test]
    fn white_noise_of_any_law_has_no_levels() {
        let (usual, deviation) = of_noise(|random, _| normal(random));
        let even = Uniform::new(-1.0, 1.0).expect("a range");
        let tails = StudentT::new(3.0).expect("three degrees of freedom");
        let louder = |row: usize| if (200..300).contains(&row) { 4.0 } else { 1.0 };
        for (what, (share, _)) in [
            ("bounded", of_noise(|random, _| even.sample(random))),
            ("skewed", of_noise(|random, _| Exp1.sample(random))),
            ("tails", of_noise(|random, _| tails.sample(random))),
            ("rounded", of_noise(|random, _| normal(random).round())),
            ("louder in places", of_noise(|random, row| louder(row) * normal(random))),
        ] {
            assert!(share < usual + 1.5 * deviation, "{what}: {share} {usual} {deviation}");
        }
    }

    /// Coolant that is on and off for seven rows on average, six deviations apart.
    #[test]
    fn levels_are_told_from_noise_as_slow() {
        let mut high = 1.0;
        let (switched, _) = of_noise(|random, _| {
            high *= if normal(random).abs() < 0.18 { -1.0 } else { 1.0 };
            3.0 * high + normal(random)
        });
        for (noise, wide) in [of_noise(slow()), of_noise(of_many_lengths()), of_noise(held())] {
            assert!(noise + 4.0 * wide < switched, "{noise} {wide} {switched}");
        }
    }
}
