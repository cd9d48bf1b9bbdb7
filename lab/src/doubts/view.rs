//! A quick look at predictions under a noise that is held fixed.

use crate::model::{Columns, Problem};
use crate::noise::{Noise, Whitener};
use crate::numerics::least_squares::fit;
use crate::numerics::median;

/// Whitening by a fixed noise, free of what is common.
pub(super) struct View {
    whitener: Whitener,
    common: Vec<Vec<f64>>,
}

impl View {
    pub(super) fn new(problem: &Problem, common: &Columns, noises: &[Noise]) -> Self {
        let whitener = Whitener::new(&problem.layout, noises);
        let common = common.whitened(&whitener);
        Self { whitener, common }
    }

    /// Whitened square of what is not common.
    pub(super) fn square(&self, values: &[f64]) -> f64 {
        let views: Vec<&[f64]> = self.common.iter().map(Vec::as_slice).collect();
        fit(&views, &self.whitener.whiten(values)).residual_square
    }

    /// That of what a prediction leaves.
    pub(super) fn left(&self, problem: &Problem, predicted: &[f64]) -> f64 {
        let pairs = problem.observed.iter().zip(predicted);
        self.square(&pairs.map(|(seen, said)| seen - said).collect::<Vec<_>>())
    }
}

/// White noise of the size that neighbouring samples differ by.
pub(super) fn rough_noises(problem: &Problem) -> Vec<Noise> {
    let left = problem.residual();
    let noise = |sensor: usize| {
        let blocks = problem.layout.blocks.iter().filter(|block| block.sensor == sensor);
        let pairs = blocks.flat_map(|block| left[block.rows.clone()].windows(2));
        let mut steps: Vec<f64> = pairs.map(|pair| (pair[1] - pair[0]).abs()).collect();
        let deviation = (1.4826 * median(&mut steps)).max(f64::MIN_POSITIVE.sqrt());
        Noise::white().scaled(0.5 * deviation * deviation)
    };
    (0..problem.sensors.len()).map(noise).collect()
}
