//! The factorised covariance of all rows: makes columns white and frees them of pass offsets.

use std::ops::Range;

use super::factor::{Factor, Pivots};
use super::kernel::{Noise, PARTS};
use super::layout::{Block, Layout};
use crate::numerics::least_squares::dot;

/// The factorised covariance of all rows: makes columns white and frees them of pass offsets.
#[derive(Debug, Clone)]
pub(crate) struct Whitener {
    blocks: Vec<Part>,
    steps: Vec<Step>,
    ones: Vec<f64>,
    log_determinant: f64,
}

/// A block with the number of its slow parts.
#[derive(Debug, Clone)]
struct Part {
    rows: Range<usize>,
    slow: usize,
}

/// How a row follows from the one before: what its slow parts keep, what they take of the last
/// innovation, and one over the deviation of its own.
#[derive(Debug, Clone, Copy)]
struct Step {
    decay: [f64; PARTS],
    carried: [f64; PARTS],
    inverse_root: f64,
}

/// Columns whitened at once: their recursions run side by side in vector registers.
const LANES: usize = 8;

/// Rows of a tile in which the values of all lanes lie side by side.
const TILE: usize = 32;

impl Whitener {
    /// Factorises the covariance; `noises` holds one model a sensor.
    #[must_use]
    pub(crate) fn new(layout: &Layout, noises: &[Noise]) -> Self {
        let mut whitener = Self {
            blocks: Vec::with_capacity(layout.blocks.len()),
            steps: Vec::with_capacity(layout.len()),
            ones: Vec::new(),
            log_determinant: 0.0,
        };
        for block in &layout.blocks {
            let noise = &noises[block.sensor];
            match noise.slow.len() {
                0 => whitener.factorise::<0>(layout, block, noise),
                1 => whitener.factorise::<1>(layout, block, noise),
                _ => whitener.factorise::<PARTS>(layout, block, noise),
            }
        }
        whitener.ones = whitener.whiten_only(&vec![1.0; layout.len()]);
        whitener.normalise_ones();
        whitener
    }

    /// Log determinant of the covariance, with that of the offsets (restricted likelihood).
    #[must_use]
    pub(crate) fn log_determinant(&self) -> f64 {
        self.log_determinant
    }

    /// Number of offsets projected out: one a block.
    #[must_use]
    pub(crate) fn offsets(&self) -> usize {
        self.blocks.len()
    }

    /// The column with unit, uncorrelated noise and without the part a pass offset explains.
    #[must_use]
    pub(crate) fn whiten(&self, column: &[f64]) -> Vec<f64> {
        let mut white = self.whiten_only(column);
        self.clear_of_offsets(&mut white);
        white
    }

    /// Several columns as [`Self::whiten`] does them one by one, at a fraction of the time.
    #[must_use]
    pub(crate) fn whiten_all(&self, columns: &[&[f64]]) -> Vec<Vec<f64>> {
        let mut white = Vec::with_capacity(columns.len());
        let (full, rest) = columns.as_chunks::<LANES>();
        white.extend(full.iter().flat_map(|lanes| self.filtered(lanes)));
        let (half, rest) = rest.as_chunks::<{ LANES / 2 }>();
        white.extend(half.iter().flat_map(|lanes| self.filtered(lanes)));
        let (pairs, rest) = rest.as_chunks::<2>();
        white.extend(pairs.iter().flat_map(|lanes| self.filtered(lanes)));
        white.extend(rest.iter().map(|column| self.whiten_only(column)));
        for column in &mut white {
            self.clear_of_offsets(column);
        }
        white
    }

    /// The column with unit, uncorrelated noise; offsets stay in it.
    #[must_use]
    pub(crate) fn whiten_only(&self, column: &[f64]) -> Vec<f64> {
        let [white] = self.filtered(&[column]);
        white
    }

    /// Inverse covariance times the residual that `white` was made of: correlating it with any
    /// column gives the column's whitened product, without whitening the column.
    #[must_use]
    pub(crate) fn unwhiten(&self, white: &[f64]) -> Vec<f64> {
        let mut weighted = vec![0.0; white.len()];
        for block in &self.blocks {
            let mut adjoint = [0.0; PARTS];
            let mut after = Step { decay: [0.0; PARTS], carried: [0.0; PARTS], inverse_root: 0.0 };
            for row in block.rows.clone().rev() {
                let mut value = white[row] * self.steps[row].inverse_root;
                for (carried, part) in after.carried.iter().zip(&adjoint) {
                    value += carried * part;
                }
                for (decay, part) in after.decay.iter().zip(&mut adjoint) {
                    *part = decay * *part - value;
                }
                weighted[row] = value;
                after = self.steps[row];
            }
        }
        weighted
    }

    fn filtered<const L: usize>(&self, columns: &[&[f64]; L]) -> [Vec<f64>; L] {
        let mut white = columns.map(|column| vec![0.0; column.len()]);
        for block in &self.blocks {
            match block.slow {
                0 => self.weigh(&block.rows, columns, &mut white),
                1 => self.filter::<1, L>(&block.rows, columns, &mut white),
                _ => self.filter::<PARTS, L>(&block.rows, columns, &mut white),
            }
        }
        white
    }

    /// The same for a block of independent samples.
    fn weigh<const L: usize>(
        &self,
        rows: &Range<usize>,
        columns: &[&[f64]; L],
        white: &mut [Vec<f64>; L],
    ) {
        let steps = &self.steps[rows.clone()];
        for (column, white) in columns.iter().zip(white) {
            let values = white[rows.clone()].iter_mut().zip(&column[rows.clone()]);
            values.zip(steps).for_each(|((white, value), step)| *white = value * step.inverse_root);
        }
    }

    /// Innovations of the columns over a block, tile by tile.
    fn filter<const P: usize, const L: usize>(
        &self,
        rows: &Range<usize>,
        columns: &[&[f64]; L],
        white: &mut [Vec<f64>; L],
    ) {
        let mut foreseen = [[0.0; L]; P];
        let mut innovation = [0.0; L];
        let mut tile = [[0.0; L]; TILE];
        let mut start = rows.start;
        while start < rows.end {
            let end = (start + TILE).min(rows.end);
            for (lane, column) in columns.iter().enumerate() {
                tile.iter_mut().zip(&column[start..end]).for_each(|(row, v)| row[lane] = *v);
            }
            for (values, step) in tile.iter_mut().zip(&self.steps[start..end]) {
                step.apply(&mut foreseen, &mut innovation, values);
            }
            for (lane, column) in white.iter_mut().enumerate() {
                column[start..end].iter_mut().zip(&tile).for_each(|(v, row)| *v = row[lane]);
            }
            start = end;
        }
    }

    fn clear_of_offsets(&self, white: &mut [f64]) {
        for block in &self.blocks {
            let ones = &self.ones[block.rows.clone()];
            let part = &mut white[block.rows.clone()];
            let along = dot(ones, part);
            for (value, one) in part.iter_mut().zip(ones) {
                *value -= along * one;
            }
        }
    }

    fn factorise<const P: usize>(&mut self, layout: &Layout, block: &Block, noise: &Noise) {
        self.blocks.push(Part { rows: block.rows.clone(), slow: P });
        let Some(first) = block.rows.clone().next() else { return };
        let mut factor = Factor::<P, 1>::new([noise], layout.inflation[first]);
        let mut step = Step::new(&factor, &[[0.0]; P]);
        self.steps.push(step);
        let mut pivots = Pivots::new();
        pivots.times(&factor.pivot, first);
        for row in block.rows.clone().skip(1) {
            let (interval, inflation) =
                (layout.clock[row] - layout.clock[row - 1], layout.inflation[row]);
            if !factor.stays(interval, inflation) {
                let before = factor.gain;
                factor.advance(interval, inflation);
                step = Step::new(&factor, &before);
            }
            pivots.times(&factor.pivot, row);
            self.steps.push(step);
        }
        let [logarithm] = pivots.logarithm();
        self.log_determinant += logarithm;
    }

    /// Scales the whitened constants to length 1 a block and counts them in the determinant.
    fn normalise_ones(&mut self) {
        for block in &self.blocks {
            let ones = &mut self.ones[block.rows.clone()];
            let square = dot(ones, ones);
            let length = square.max(f64::MIN_POSITIVE).sqrt();
            self.log_determinant += 2.0 * libm::log(length);
            for one in ones {
                *one /= length;
            }
        }
    }
}

impl Step {
    /// Of a row's factor and the gains of the row before.
    fn new<const P: usize>(factor: &Factor<P, 1>, gain: &[[f64; 1]; P]) -> Self {
        let inverse_root = 1.0 / factor.pivot[0].sqrt();
        let mut step = Self { decay: [0.0; PARTS], carried: [0.0; PARTS], inverse_root };
        for (part, ([decay], [gain])) in factor.decay.iter().zip(gain).enumerate() {
            step.decay[part] = *decay;
            step.carried[part] = decay * gain;
        }
        step
    }

    /// Replaces the values of a row by its whitened innovations.
    fn apply<const P: usize, const L: usize>(
        &self,
        foreseen: &mut [[f64; L]; P],
        innovation: &mut [f64; L],
        values: &mut [f64; L],
    ) {
        for (part, foreseen) in foreseen.iter_mut().enumerate() {
            for lane in 0..L {
                foreseen[lane] =
                    self.decay[part] * foreseen[lane] + self.carried[part] * innovation[lane];
                values[lane] -= foreseen[lane];
            }
        }
        *innovation = *values;
        for value in values {
            *value *= self.inverse_root;
        }
    }
}
