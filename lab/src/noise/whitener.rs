//! The factorised covariance of all rows: makes columns white and frees them of pass offsets.

use std::ops::Range;

use super::factor::{Factor, Pivots};
use super::kernel::{Noise, PARTS};
use super::layout::{Block, Layout};
use crate::numerics::count;
use crate::numerics::least_squares::dot;

/// The factorised covariance of all rows: makes columns white and frees them of pass offsets.
#[derive(Debug, Clone)]
pub(crate) struct Whitener {
    blocks: Vec<Part>,
    runs: Vec<Run>,
    ones: Vec<f64>,
    log_determinant: f64,
}

/// A block with its runs and the number of its slow parts.
#[derive(Debug, Clone)]
struct Part {
    rows: Range<usize>,
    runs: Range<usize>,
    slow: usize,
}

/// Neighbouring rows that follow from the ones before in the same way: with even sampling nearly
/// all of a block.
#[derive(Debug, Clone, Copy)]
struct Run {
    /// The first row behind them.
    end: usize,
    step: Step,
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
            runs: Vec::new(),
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
        whitener.ones = whitener.whiten_only(vec![1.0; layout.len()]);
        whitener.normalise_ones();
        whitener
    }

    /// Log determinant of the covariance, with that of the offsets (restricted likelihood).
    #[must_use]
    pub(crate) fn log_determinant(&self) -> f64 {
        self.log_determinant
    }

    /// Restricted log likelihood of what is left under these noises, without the constant `−n/2·log 2π`.
    #[must_use]
    pub(crate) fn log_likelihood(&self, left: &[f64]) -> f64 {
        let white = self.whiten(left.to_vec());
        -0.5 * (dot(&white, &white) + self.log_determinant)
    }

    /// Number of offsets projected out: one a block.
    #[must_use]
    pub(crate) fn offsets(&self) -> usize {
        self.blocks.len()
    }

    /// The column with unit, uncorrelated noise and without the part a pass offset explains.
    #[must_use]
    pub(crate) fn whiten(&self, column: Vec<f64>) -> Vec<f64> {
        let mut white = self.whiten_only(column);
        self.clear_of_offsets(&mut white);
        white
    }

    /// Several columns as [`Self::whiten`] does them one by one, at a fraction of the time.
    #[must_use]
    pub(crate) fn whiten_all(&self, columns: &[&[f64]]) -> Vec<Vec<f64>> {
        let mut white: Vec<Vec<f64>> = columns.iter().map(|column| column.to_vec()).collect();
        let rest = self.filter_in_lanes::<LANES>(&mut white);
        let rest = self.filter_in_lanes::<{ LANES / 2 }>(rest);
        let rest = self.filter_in_lanes::<2>(rest);
        self.filter_in_lanes::<1>(rest);
        for column in &mut white {
            self.clear_of_offsets(column);
        }
        white
    }

    /// The column with unit, uncorrelated noise; offsets stay in it.
    #[must_use]
    pub(crate) fn whiten_only(&self, column: Vec<f64>) -> Vec<f64> {
        let mut lane = [column];
        self.filter_all(&mut lane);
        let [white] = lane;
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
            for (rows, step) in self.runs(block).rev() {
                for row in rows.rev() {
                    let mut value = white[row] * step.inverse_root;
                    for (carried, part) in after.carried.iter().zip(&adjoint) {
                        value += carried * part;
                    }
                    for (decay, part) in after.decay.iter().zip(&mut adjoint) {
                        *part = decay * *part - value;
                    }
                    weighted[row] = value;
                    after = *step;
                }
            }
        }
        weighted
    }

    /// The runs of a block: their rows, and how these follow.
    fn runs(&self, block: &Part) -> impl DoubleEndedIterator<Item = (Range<usize>, &Step)> {
        let starts = block.runs.clone().map(move |run| {
            if run == block.runs.start { block.rows.start } else { self.runs[run - 1].end }
        });
        let runs = &self.runs[block.runs.clone()];
        starts.zip(runs).map(|(start, run)| (start..run.end, &run.step))
    }

    /// Filters as many columns as fill lanes, and returns the rest.
    fn filter_in_lanes<'a, const L: usize>(
        &self,
        columns: &'a mut [Vec<f64>],
    ) -> &'a mut [Vec<f64>] {
        let (full, rest) = columns.as_chunks_mut::<L>();
        for lanes in full {
            self.filter_all(lanes);
        }
        rest
    }

    /// Replaces columns by their whitened selves.
    fn filter_all<const L: usize>(&self, columns: &mut [Vec<f64>; L]) {
        for block in &self.blocks {
            match block.slow {
                0 => self.weigh(block, columns),
                1 => self.filter::<1, L>(block, columns),
                _ => self.filter::<PARTS, L>(block, columns),
            }
        }
    }

    /// The same for a block of independent samples.
    fn weigh<const L: usize>(&self, block: &Part, columns: &mut [Vec<f64>; L]) {
        for (rows, step) in self.runs(block) {
            for column in &mut *columns {
                column[rows.clone()].iter_mut().for_each(|value| *value *= step.inverse_root);
            }
        }
    }

    /// Innovations of the columns over a block, tile by tile.
    fn filter<const P: usize, const L: usize>(&self, block: &Part, columns: &mut [Vec<f64>; L]) {
        let mut foreseen = [[0.0; L]; P];
        let mut innovation = [0.0; L];
        let mut tile = [[0.0; L]; TILE];
        let mut runs = &self.runs[block.runs.clone()];
        for start in block.rows.clone().step_by(TILE) {
            let end = (start + TILE).min(block.rows.end);
            for (lane, column) in columns.iter().enumerate() {
                tile.iter_mut().zip(&column[start..end]).for_each(|(row, v)| row[lane] = *v);
            }
            let mut row = start;
            while let Some((run, later)) = runs.split_first().filter(|_| row < end) {
                let until = run.end.min(end);
                for values in &mut tile[row - start..until - start] {
                    run.step.apply(&mut foreseen, &mut innovation, values);
                }
                runs = if run.end == until { later } else { runs };
                row = until;
            }
            for (lane, column) in columns.iter_mut().enumerate() {
                column[start..end].iter_mut().zip(&tile).for_each(|(v, row)| *v = row[lane]);
            }
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
        let first_run = self.runs.len();
        if let Some(first) = block.rows.clone().next() {
            let mut factor = Factor::<P, 1>::new([noise], layout.inflation[first]);
            let variance = block.variance();
            let mut run = Run { end: first + 1, step: Step::new(&factor, &[[0.0]; P], variance) };
            let mut pivots = Pivots::new();
            pivots.times(&factor.pivot, first);
            for row in block.rows.clone().skip(1) {
                let (interval, inflation) =
                    (layout.clock[row] - layout.clock[row - 1], layout.inflation[row]);
                if !factor.stays(interval, inflation) {
                    let before = factor.gain;
                    factor.advance(interval, inflation);
                    self.runs.push(run);
                    run.step = Step::new(&factor, &before, variance);
                }
                run.end = row + 1;
                pivots.times(&factor.pivot, row);
            }
            self.runs.push(run);
            let [logarithm] = pivots.logarithm();
            self.log_determinant += logarithm + count(block.rows.len()) * libm::log(variance);
        }
        let runs = first_run..self.runs.len();
        self.blocks.push(Part { rows: block.rows.clone(), runs, slow: P });
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
    /// Of a row's factor and the gains of the row before, in a block of some variance.
    fn new<const P: usize>(factor: &Factor<P, 1>, gain: &[[f64; 1]; P], variance: f64) -> Self {
        let inverse_root = 1.0 / (variance * factor.pivot[0]).sqrt();
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
