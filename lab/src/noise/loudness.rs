//! How loud each pass is against the others.

use super::layout::{Block, Layout};
use crate::numerics::{count, deviation, median};
use crate::policy::reading::{
    ERROR_OF_LOUDNESS, FEWEST_OF_A_LOUD_PASS, MOST_TOLD, NEIGHBOURS_APART, SLOW_AGAINST_NEIGHBOURS,
    SURELY_LOUDER,
};

/// Variance of every row against the usual one, in powers of two, where a pass is surely louder than others of its
/// sensor or quieter, as those are whose spindle ran or whose door stood open; 1 elsewhere.
///
/// What rows of a pass differ by from the line between their neighbours tells it, which no slow effect changes. Noise
/// that is slow itself tells nothing: it differs as far as the neighbours are apart. Nor does a display that is hardly
/// coarser than the noise.
#[must_use]
pub(crate) fn loudness_of_passes(
    layout: &Layout,
    residual: &[f64],
    least_variance: &[f64],
) -> Vec<f64> {
    let mut variances = vec![1.0; residual.len()];
    for (sensor, least) in least_variance.iter().enumerate() {
        let own = layout.blocks.iter().filter(|block| block.sensor == sensor);
        let passes: Vec<&Block> =
            own.filter(|block| FEWEST_OF_A_LOUD_PASS <= block.rows.len()).collect();
        let sizes = |reach| -> Vec<f64> {
            let bends = |block: &&Block| deviation(&mut bends(layout, block, residual, reach));
            passes.iter().map(bends).collect()
        };
        let (near, wide) = (sizes(1), sizes(NEIGHBOURS_APART));
        let usual = median(&mut near.clone());
        let coarse = (12.0 * least).sqrt();
        let mut wider: Vec<f64> = wide.iter().zip(&near).map(|(wide, near)| wide / near).collect();
        let is_slow = SLOW_AGAINST_NEIGHBOURS < median(&mut wider);
        if passes.len() < 2 || usual <= coarse || is_slow {
            continue;
        }
        // The others tell the usual size no better than a pass of all their rows.
        let apart = (1.0 + 1.0 / count(passes.len() - 1)).sqrt();
        for (block, size) in passes.into_iter().zip(near) {
            let error = ERROR_OF_LOUDNESS * apart / count(block.rows.len()).sqrt();
            variances[block.rows.clone()].fill(variance(size.max(coarse) / usual, error));
        }
    }
    variances
}

/// How far each row between two others, so many rows before and behind, is from the line between these, as far as a row
/// of white noise goes.
fn bends(layout: &Layout, block: &Block, residual: &[f64], reach: usize) -> Vec<f64> {
    let (clock, values) = (&layout.clock[block.rows.clone()], &residual[block.rows.clone()]);
    let bend = |row: usize| {
        let (earlier, later) = (clock[row] - clock[row - reach], clock[row + reach] - clock[row]);
        let before = if 0.0 < earlier + later { later / (earlier + later) } else { 0.5 };
        let behind = 1.0 - before;
        let bend = values[row] - before * values[row - reach] - behind * values[row + reach];
        bend.abs() / (1.0 + before * before + behind * behind).sqrt()
    };
    (reach..values.len() - reach).map(bend).collect()
}

/// The variance of a pass whose deviation is so many times the usual one, with such an error of its logarithm.
fn variance(share: f64, error: f64) -> f64 {
    if share <= 0.0 || libm::log(share).abs() <= SURELY_LOUDER * error {
        return 1.0;
    }
    libm::exp2(libm::round(2.0 * libm::log2(share.clamp(1.0 / MOST_TOLD, MOST_TOLD))))
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    use super::*;

    /// Powers of two in the variances of three passes of so many rows whose deviations are these, beside a slope that
    /// no row is below the noise of and a bow.
    fn powers(seed: u64, rows: u32, deviations: [f64; 3], least: f64) -> [i32; 3] {
        let mut chance = ChaCha8Rng::seed_from_u64(seed);
        let drawn = deviations.iter().flat_map(|deviation| {
            let noise = StandardNormal.sample_iter(&mut chance).take(rows as usize);
            noise.map(|drawn: f64| deviation * drawn).collect::<Vec<_>>()
        });
        let residual: Vec<f64> = (0..rows)
            .cycle()
            .zip(drawn)
            .map(|(row, drawn)| {
                let along = f64::from(row) / f64::from(rows);
                drawn + 900.0 * along + 40.0 * along * along
            })
            .collect();
        let rows = rows as usize;
        let blocks = (0..3)
            .map(|pass| Block { sensor: 0, pass, rows: pass * rows..(pass + 1) * rows })
            .collect();
        let clock: Vec<f64> = (0..3 * rows).map(count).collect();
        let layout = Layout { blocks, clock: clock.into(), ..Layout::default() };
        let found = loudness_of_passes(&layout, &residual, &[least]);
        [0, 1, 2].map(|pass| libm::ilogb(found[pass * rows]))
    }

    #[test]
    fn a_louder_pass_is_told_from_chance() {
        // Once in forty times chance has the noise slow.
        let loud = |seed| powers(seed, 150, [1.0, 4.0, 1.0], 0.0);
        let is_told = |seed: &u64| matches!(loud(*seed), [0, 2..=6, 0]);
        assert!(95 <= (0..100).filter(is_told).count());
        for rows in [24, 150] {
            let alike = |seed| powers(seed, rows, [1.0; 3], 0.0) == [0; 3];
            assert!((0..400).filter(|seed| !alike(*seed)).count() <= 2, "{rows}");
        }
    }

    /// As few rows as tell it by no factor, and a display that hides the noise.
    #[test]
    fn few_rows_and_coarse_ones_are_as_loud_as_others() {
        assert_eq!(powers(1, 10, [1.0, 9.0, 1.0], 0.0), [0; 3]);
        assert_eq!(powers(1, 150, [1.0, 9.0, 1.0], 1.0), [0; 3]);
    }
}
