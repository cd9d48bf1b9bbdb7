//! How loud each pass is against the others.

use super::layout::{Block, Layout};
use super::noise_fit::departures;
use crate::numerics::{count, deviation, median};
use crate::policy::reading::{ERROR_OF_LOUDNESS, FEWEST_OF_A_LOUD_PASS, MOST_TOLD, SURELY_LOUDER};

/// Variance of every row against the usual one, in powers of two, where a pass is surely louder than others of its
/// sensor or quieter, as those are whose spindle ran or whose door stood open; 1 elsewhere.
///
/// What rows of a pass differ by from their neighbours tells it, which no slow effect changes. A display tells none
/// that is hardly coarser than the noise.
#[must_use]
pub(crate) fn loudness_of_passes(
    layout: &Layout,
    residual: &[f64],
    least_variance: &[f64],
) -> Vec<f64> {
    let mut variances = vec![1.0; residual.len()];
    for (sensor, least) in least_variance.iter().enumerate() {
        let blocks: Vec<&Block> =
            layout.blocks.iter().filter(|block| block.sensor == sensor).collect();
        let size = |block: &&Block| {
            let departures = departures(&residual[block.rows.clone()]).into_iter();
            deviation(&mut departures.map(f64::abs).collect::<Vec<f64>>())
        };
        let sizes: Vec<f64> = blocks.iter().map(size).collect();
        let usual = median(&mut sizes.clone());
        if usual * usual <= 12.0 * least {
            continue;
        }
        for (block, size) in blocks.into_iter().zip(sizes) {
            variances[block.rows.clone()].fill(variance(size / usual, block.rows.len()));
        }
    }
    variances
}

/// The variance of a pass of so many rows whose deviation is so many times the usual one.
fn variance(share: f64, rows: usize) -> f64 {
    let error = ERROR_OF_LOUDNESS * (2.0 / count(rows)).sqrt();
    let share = share.clamp(1.0 / MOST_TOLD, MOST_TOLD);
    if rows < FEWEST_OF_A_LOUD_PASS || libm::log(share).abs() < SURELY_LOUDER * error {
        return 1.0;
    }
    libm::exp2(libm::round(2.0 * libm::log2(share)))
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    use super::*;

    /// Powers of two in the variances of three passes of so many rows whose deviations are these.
    fn powers(seed: u64, rows: usize, deviations: [f64; 3], least: f64) -> [i32; 3] {
        let mut chance = ChaCha8Rng::seed_from_u64(seed);
        let blocks = (0..3)
            .map(|pass| Block { sensor: 0, pass, rows: pass * rows..(pass + 1) * rows })
            .collect();
        let residual: Vec<f64> = (0..3 * rows)
            .map(|row| {
                let drawn: f64 = StandardNormal.sample(&mut chance);
                deviations[row / rows] * drawn
            })
            .collect();
        let layout = Layout { blocks, ..Layout::default() };
        let found = loudness_of_passes(&layout, &residual, &[least]);
        [0, 1, 2].map(|pass| libm::ilogb(found[pass * rows]))
    }

    #[test]
    fn a_louder_pass_is_told_from_chance() {
        for seed in 0..100 {
            let [first, loud, last] = powers(seed, 150, [1.0, 4.0, 1.0], 0.0);
            assert_eq!([first, last], [0, 0], "{seed}");
            assert!((2..=6).contains(&loud), "{seed}: {loud}");
        }
        let alike = |seed| powers(seed, 150, [1.0; 3], 0.0) == [0; 3];
        assert!((0..400).filter(|seed| !alike(*seed)).count() <= 2);
    }

    /// As few rows as a bow makes louder, and a display that hides the noise.
    #[test]
    fn few_rows_and_coarse_ones_are_as_loud_as_others() {
        assert_eq!(powers(1, 40, [1.0, 9.0, 1.0], 0.0), [0; 3]);
        assert_eq!(powers(1, 150, [1.0, 9.0, 1.0], 1.0), [0; 3]);
    }
}
