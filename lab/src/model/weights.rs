//! How much rows weigh: outliers and loud passes weigh less.

use super::problem::Problem;
use crate::noise::{
    Block, Layout, Loudness, Noise, NoiseFit, Whitener, fit_noise, outlier_inflation,
};
use crate::numerics::count;
use crate::policy::reading::{PRICE_OF_LOUDNESS, SURELY_ANOTHER_COLOUR};

/// Rows as they weigh where passes are as loud as they may be, the noises of the sensors then, and twice their log
/// likelihood less what each block that differs must gain to be sure.
struct Loud {
    layout: Layout,
    noises: Vec<Noise>,
    gained: f64,
}

impl Problem {
    /// Weighs outliers and loud passes down, as they stand out of what a model leaves.
    ///
    /// Passes are as loud as makes what is left likeliest, all alike unless one surely differs, and none that does is then
    /// of another colour: a pass that is slow where others are swift is no quiet one. A file that says how sure each
    /// reading is says that of its passes.
    pub(crate) fn mark_outliers(&mut self, left: &[f64]) {
        let (left, telling) = &self.without_own_errors(left);
        let alike = vec![0; self.layout.blocks.len()];
        self.weigh(&alike, left, telling);
        let near = self.loudness().by_neighbours(left);
        if near == alike || self.measurement.deviations.is_some() {
            return;
        }
        let plain = self.as_loud(&alike, left, telling);
        let own = self.loudness().by_noise(left, &plain.noises, &near);
        let [near, own] = [near, own].map(|powers| self.as_loud(&powers, left, telling));
        let likelier = if near.gained < own.gained { own } else { near };
        let alike = likelier.gained < plain.gained || likelier.has_another_colour(left);
        self.layout = if alike { plain.layout } else { likelier.layout };
    }

    fn loudness(&self) -> Loudness<'_> {
        Loudness { layout: &self.layout, least_variance: &self.least_variance }
    }

    fn as_loud(&mut self, powers: &[i32], left: &[f64], telling: &[bool]) -> Loud {
        self.weigh(powers, left, telling);
        let fits = (0..self.sensors.len()).map(|sensor| {
            let (layout, rows) = self.layout.of_sensor(sensor);
            fit_noise(&layout, &left[rows], None)
        });
        let fits: Vec<NoiseFit> = fits.collect();
        let likelihood: f64 = fits.iter().map(|fit| fit.log_likelihood).sum();
        let differing = count(powers.iter().filter(|power| **power != 0).count());
        let gained = 2.0 * likelihood - PRICE_OF_LOUDNESS * differing;
        let noises = fits.into_iter().map(|fit| fit.noise).collect();
        Loud { layout: self.layout.clone(), noises, gained }
    }

    /// Takes passes to be as loud, and weighs down what stands out of them.
    fn weigh(&mut self, powers: &[i32], left: &[f64], telling: &[bool]) {
        let blocks = self.layout.blocks.iter_mut();
        blocks.zip(powers).for_each(|(block, power)| block.loudness = *power);
        let told = self.told_variances();
        let mut scaled: Vec<f64> =
            left.iter().zip(&told).map(|(left, variance)| left / variance.sqrt()).collect();
        for block in &self.layout.blocks {
            let deviation = block.variance().sqrt();
            scaled[block.rows.clone()].iter_mut().for_each(|left| *left /= deviation);
        }
        let outliers = outlier_inflation(&self.layout, &scaled, telling, &self.least_variance);
        self.layout.inflation = outliers.iter().zip(&told).map(|(own, told)| own * told).collect();
    }
}

impl Loud {
    /// True where a block that is louder than others, or quieter, surely has a noise of its own: a step in another one
    /// does not matter.
    fn has_another_colour(&self, left: &[f64]) -> bool {
        let gained = |block: &Block| {
            let (layout, left) = (self.layout.stretch(block), &left[block.rows.clone()]);
            let whitener = Whitener::new(&layout, &self.noises[block.sensor..=block.sensor]);
            let own = fit_noise(&layout, left, None).log_likelihood;
            2.0 * (own - whitener.log_likelihood(left))
        };
        let mut differing = self.layout.blocks.iter().filter(|block| block.loudness != 0);
        differing.any(|block| SURELY_ANOTHER_COLOUR < gained(block))
    }
}
