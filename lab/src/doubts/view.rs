//! A quick look at predictions under a noise that is held fixed.

use crate::model::{Columns, Problem};
use crate::noise::{Noise, Whitener};
use crate::numerics::deviation;
use crate::numerics::least_squares::fit;

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
    pub(super) fn square(&self, values: Vec<f64>) -> f64 {
        let views: Vec<&[f64]> = self.common.iter().map(Vec::as_slice).collect();
        fit(&views, &self.whitener.whiten(values)).residual_square
    }

    /// That of what a problem's prediction leaves.
    pub(super) fn left(&self, problem: &Problem) -> f64 {
        self.square(problem.residual())
    }
}

/// White noise of the size by which samples lie off the line between their neighbours.
///
/// A slope, which may be the very mistake, is no noise.
pub(super) fn rough_noises(problem: &Problem) -> Vec<Noise> {
    let left = problem.residual();
    let turns: Vec<f64> = problem.record.turns().collect();
    let turn = |row: usize| turns[problem.samples[row]];
    let off = |row: usize| {
        let (from, to) = (turn(row - 1), turn(row + 1));
        let share = (turn(row) - from) / (to - from);
        let share = if (0.0..=1.0).contains(&share) { share } else { 0.5 };
        let line = left[row - 1] + share * (left[row + 1] - left[row - 1]);
        let variance = 1.0 + share * share + (1.0 - share) * (1.0 - share);
        (left[row] - line).abs() / variance.sqrt()
    };
    let noise = |sensor: usize| {
        let blocks = problem.layout.blocks.iter().filter(|block| block.sensor == sensor);
        let inner = blocks
            .flat_map(|block| block.rows.clone().skip(1).take(block.rows.len().saturating_sub(2)));
        let mut sizes: Vec<f64> = inner.map(off).collect();
        let deviation = deviation(&mut sizes).max(f64::MIN_POSITIVE.sqrt());
        Noise::white().scaled(deviation * deviation)
    };
    (0..problem.sensors.len()).map(noise).collect()
}
