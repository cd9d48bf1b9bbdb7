//! How loud each pass is against the others.

use std::f64::consts::SQRT_2;

use super::kernel::Noise;
use super::layout::{Block, Layout};
use super::whitener::Whitener;
use crate::numerics::{count, deviation, median};
use crate::policy::reading::{
    ERROR_OF_LOUDNESS, ERROR_OF_NEIGHBOURS, FEWEST_OF_A_LOUD_PASS, MOST_TOLD, PERHAPS_LOUDER,
};

/// Asks which passes are louder than others of their sensor, or quieter, as those are whose spindle ran or whose door
/// stood open.
#[derive(Debug)]
pub(crate) struct Loudness<'a> {
    /// Rows and their passes, all alike.
    pub(crate) layout: &'a Layout,
    /// Variance below which no sensor's noise is taken to be: a display that is hardly finer than the noise tells no
    /// loudness.
    pub(crate) least_variance: &'a [f64],
}

impl Loudness<'_> {
    /// Logarithms to base 2 of the variances of the blocks against the usual one, 0 but where a block may differ: told
    /// by how far its rows are from the line between their neighbours, which no slow effect changes.
    ///
    /// Where noise is slow this is as large as rows are far apart, and a guess.
    pub(crate) fn by_neighbours(&self, left: &[f64]) -> Vec<i32> {
        let size = |block: &Block| deviation(&mut self.bends(block, left));
        self.powers(size, ERROR_OF_NEIGHBOURS, self.least_variance)
    }

    /// The same, told by the innovations of what is left under noise that was fitted to it, of sensors one of whose
    /// blocks differs by its neighbours.
    pub(crate) fn by_noise(&self, left: &[f64], noises: &[Noise], near: &[i32]) -> Vec<i32> {
        let white = Whitener::new(self.layout, noises).whiten(left.to_vec());
        let size = |block: &Block| {
            let sizes = white[block.rows.clone()].iter().map(|own| own.abs());
            deviation(&mut sizes.collect::<Vec<_>>())
        };
        let mut powers = self.powers(size, ERROR_OF_LOUDNESS, &vec![0.0; noises.len()]);
        let blocks = || self.layout.blocks.iter();
        let differs = |sensor| {
            let mut own = blocks().zip(near).filter(|(block, _)| block.sensor == sensor);
            own.any(|(_, power)| *power != 0)
        };
        let differs: Vec<bool> = (0..noises.len()).map(differs).collect();
        blocks()
            .zip(&mut powers)
            .filter(|(block, _)| !differs[block.sensor])
            .for_each(|(_, power)| *power = 0);
        powers
    }

    /// How far each row between two others is from the line between these, as far as a row of white noise goes.
    fn bends(&self, block: &Block, left: &[f64]) -> Vec<f64> {
        let bend = |(values, clock): (&[f64], &[f64])| {
            let (earlier, later) = (clock[1] - clock[0], clock[2] - clock[1]);
            let before = if 0.0 < earlier + later { later / (earlier + later) } else { 0.5 };
            let behind = 1.0 - before;
            let bend = values[1] - before * values[0] - behind * values[2];
            bend.abs() / (1.0 + before * before + behind * behind).sqrt()
        };
        let clock = self.layout.clock[block.rows.clone()].windows(3);
        left[block.rows.clone()].windows(3).zip(clock).map(bend).collect()
    }

    /// The powers of two of the blocks by a deviation of each, whose logarithm has such an error times the root of its
    /// rows.
    fn powers(&self, size: impl Fn(&Block) -> f64, error: f64, least: &[f64]) -> Vec<i32> {
        let mut powers = vec![0; self.layout.blocks.len()];
        for (sensor, least) in least.iter().enumerate() {
            let asked = self.layout.blocks.iter().enumerate().filter(|(_, block)| {
                block.sensor == sensor && FEWEST_OF_A_LOUD_PASS <= block.rows.len()
            });
            let sizes: Vec<_> =
                asked.map(|(at, block)| (at, block.rows.len(), size(block))).collect();
            let usual = median(&mut sizes.iter().map(|(_, _, size)| *size).collect::<Vec<_>>());
            let coarse = (12.0 * least).sqrt();
            if sizes.len() < 2 || usual <= coarse {
                continue;
            }
            // The others tell the usual size no better than a pass of all their rows.
            let apart = (1.0 + 1.0 / count(sizes.len() - 1)).sqrt();
            for (at, rows, size) in sizes {
                powers[at] = power(size.max(coarse) / usual, error * apart / count(rows).sqrt());
            }
        }
        powers
    }
}

/// Logarithm to base 2 of the variance of a pass whose deviation is so many times the usual one, with such an error of
/// its logarithm.
fn power(share: f64, error: f64) -> i32 {
    if share <= 0.0 || libm::log(share).abs() <= PERHAPS_LOUDER * error {
        return 0;
    }
    let share = share.clamp(1.0 / MOST_TOLD, MOST_TOLD);
    libm::ilogb(SQRT_2 * share * share)
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    use super::*;
    use crate::noise::fit_noise;

    /// Three passes of so many rows of a sensor whose noise has these deviations: white, at even places beside a slope
    /// that no row stands out of and a bow; or with such a share that is slow, at other places in each.
    fn passes(seed: u64, rows: u32, deviations: [f64; 3], slow: f64) -> (Layout, Vec<f64>) {
        let mut chance = ChaCha8Rng::seed_from_u64(seed);
        let (mut layout, mut left, mut clock) = (Layout::default(), Vec::new(), Vec::new());
        for (pass, deviation) in deviations.into_iter().enumerate() {
            let start = left.len();
            let mut walk: f64 = StandardNormal.sample(&mut chance);
            for row in 0..rows {
                let [kick, white]: [f64; 2] = [(); 2].map(|()| StandardNormal.sample(&mut chance));
                let apart = if slow > 0.0 { count(1 + pass * 3) } else { 1.0 };
                let kept = libm::exp(-apart / 20.0);
                walk = kept * walk + (1.0 - kept * kept).sqrt() * kick;
                let along = f64::from(row) / f64::from(rows);
                let noise = slow.sqrt() * walk + (1.0 - slow).sqrt() * white;
                let curve = if slow > 0.0 { 0.0 } else { 900.0 * along + 40.0 * along * along };
                left.push(deviation * noise + curve);
                clock.push(apart * f64::from(row));
            }
            layout.blocks.push(Block { sensor: 0, pass, rows: start..left.len(), loudness: 0 });
        }
        layout.inflation = vec![1.0; left.len()].into();
        layout.clock = clock.into();
        (layout, left)
    }

    fn by_neighbours(layout: &Layout, left: &[f64], least: f64) -> Vec<i32> {
        Loudness { layout, least_variance: &[least] }.by_neighbours(left)
    }

    #[test]
    fn a_louder_pass_is_told_from_chance() {
        let of = |seed, rows, deviations| {
            let (layout, left) = passes(seed, rows, deviations, 0.0);
            by_neighbours(&layout, &left, 0.0)
        };
        let is_told = |seed: &u64| matches!(of(*seed, 150, [1.0, 4.0, 1.0])[..], [0, 3..=5, 0]);
        assert!(95 <= (0..100).filter(is_told).count());
        for rows in [24, 150] {
            let is_asked = |seed: &u64| of(*seed, rows, [1.0; 3]) != [0; 3];
            assert!((0..400).filter(is_asked).count() <= 400 * 3 / 80, "{rows}");
        }
    }

    /// Rows four and seven times as far apart, over which slow noise goes farther: under its own law it is as loud as
    /// elsewhere, and a pass that is louder is so, if less than it is, for the noise of all is whiter for its sake.
    #[test]
    fn slow_noise_is_told_by_its_innovations() {
        for seed in 0..20 {
            let found = [[1.0; 3], [4.0, 1.0, 1.0]].map(|deviations| {
                let (layout, left) = passes(seed, 150, deviations, 0.99);
                let passes = Loudness { layout: &layout, least_variance: &[0.0] };
                let near = passes.by_neighbours(&left);
                assert_ne!(near, [0; 3], "{seed}");
                passes.by_noise(&left, &[fit_noise(&layout, &left, None).noise], &near)
            });
            assert_eq!(found[0], [0; 3], "{seed}");
            assert!(matches!(found[1][..], [2..=4, -1..=0, -1..=0]), "{seed}: {:?}", found[1]);
        }
    }

    /// As few rows as tell it by no factor, and a display that hides the noise.
    #[test]
    fn few_rows_and_coarse_ones_are_as_loud_as_others() {
        let (layout, left) = passes(1, 10, [1.0, 9.0, 1.0], 0.0);
        assert_eq!(by_neighbours(&layout, &left, 0.0), [0; 3]);
        let (layout, left) = passes(1, 150, [1.0, 9.0, 1.0], 0.0);
        assert_eq!(by_neighbours(&layout, &left, 1.0), [0; 3]);
    }
}
