//! Rows of one analysis: which sensor and pass each belongs to, and the clock its noise runs on.

use std::ops::Range;

use helixlock_plant::Column;

use crate::numerics::{mean, rms_about_means};
use crate::policy::size::STRETCHES;

/// Consecutive rows of one sensor in one pass; it has its own zero and its own noise history.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Block {
    /// Index of the sensor; each sensor has its own noise.
    pub sensor: usize,
    /// Index of the pass.
    pub pass: usize,
    /// Rows of the block.
    pub rows: Range<usize>,
    /// Logarithm to base 2 of the variance of its noise, white and slow, against the usual one.
    pub loudness: i32,
}

impl Block {
    /// Variance of its noise against the usual one.
    #[must_use]
    pub(crate) fn variance(&self) -> f64 {
        libm::exp2(f64::from(self.loudness))
    }
}

/// How the rows of a fit hang together.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Layout {
    /// Blocks in row order, without gaps between them, those of a sensor together.
    pub blocks: Vec<Block>,
    /// Per row: clock of the noise in median sample intervals, not falling within a block.
    pub clock: Column,
    /// Per row: factor on the white variance, 1 for an ordinary sample, more for an outlier.
    pub inflation: Column,
}

impl Layout {
    /// The same with so much noise in some rows that a fit does not see them.
    #[must_use]
    pub(crate) fn without(&self, is_out: impl Fn(usize) -> bool) -> Self {
        let mut layout = self.clone();
        let rows = layout.inflation.iter_mut().enumerate();
        rows.filter(|(row, _)| is_out(*row)).for_each(|(_, by)| *by *= 1e8);
        layout
    }

    /// Number of rows.
    #[must_use]
    pub(crate) fn len(&self) -> usize {
        self.clock.len()
    }

    /// Number of passes.
    #[must_use]
    pub(crate) fn passes(&self) -> usize {
        self.blocks.iter().map(|block| block.pass + 1).max().unwrap_or(0)
    }

    /// The layout of one sensor's blocks as those of sensor 0, and the rows they had here.
    #[must_use]
    pub(crate) fn of_sensor(&self, sensor: usize) -> (Self, Range<usize>) {
        let own = || self.blocks.iter().filter(|block| block.sensor == sensor);
        let start = own().map(|block| block.rows.start).min().unwrap_or(0);
        let rows = start..own().map(|block| block.rows.end).max().unwrap_or(start);
        let block = |block: &Block| {
            let own = block.rows.start - start..block.rows.end - start;
            Block { sensor: 0, rows: own, ..*block }
        };
        let (clock, inflation) = (self.clock.part(&rows), self.inflation.part(&rows));
        (Self { blocks: own().map(block).collect(), clock, inflation }, rows)
    }

    /// The layout of some rows, each block's together, and where they are here.
    #[must_use]
    pub(crate) fn of_rows(&self, keep: &[bool]) -> (Self, Vec<usize>) {
        let kept = |block: &Block| block.rows.clone().filter(|&row| keep[row]).collect();
        self.picked(self.blocks.iter().map(|block| (block, kept(block))))
    }

    /// The layout of the first rows of some blocks, and the rows they had here.
    #[must_use]
    pub(crate) fn begun(&self, most: usize, keep: impl Fn(&Block) -> bool) -> (Self, Vec<usize>) {
        let blocks = self.blocks.iter().filter(|block| keep(block));
        self.picked(blocks.map(|block| (block, block.rows.clone().take(most).collect())))
    }

    /// The layout of every so many-th row of each block, and the rows they had here.
    #[must_use]
    pub(crate) fn every(&self, step: usize) -> (Self, Vec<usize>) {
        let blocks = self.blocks.iter();
        self.picked(blocks.map(|block| (block, block.rows.clone().step_by(step).collect())))
    }

    /// The layout of neighbouring rows of one block, as of one sensor.
    #[must_use]
    pub(crate) fn stretch(&self, block: &Block) -> Self {
        Self {
            blocks: vec![Block { sensor: 0, rows: 0..block.rows.len(), ..*block }],
            clock: self.clock.part(&block.rows),
            inflation: self.inflation.part(&block.rows),
        }
    }

    fn picked<'a>(
        &self,
        parts: impl Iterator<Item = (&'a Block, Vec<usize>)>,
    ) -> (Self, Vec<usize>) {
        let mut part = Self::default();
        let mut rows = Vec::new();
        for (block, own) in parts {
            let start = rows.len();
            rows.extend(own);
            part.blocks.push(Block { rows: start..rows.len(), ..*block });
        }
        part.clock = rows.iter().map(|&row| self.clock[row]).collect();
        part.inflation = rows.iter().map(|&row| self.inflation[row]).collect();
        (part, rows)
    }
}

/// Values of rows about the mean of their pass.
#[must_use]
pub(crate) fn about_means(layout: &Layout, values: &[f64]) -> Vec<f64> {
    let mut about = values.to_vec();
    for block in &layout.blocks {
        let part = &mut about[block.rows.clone()];
        let mean = mean(part);
        for value in part {
            *value -= mean;
        }
    }
    about
}

/// Root mean square about the offset of each pass, all sensors together, µm.
#[must_use]
pub(crate) fn rms(layout: &Layout, left: &[f64]) -> f64 {
    rms_about_means(layout.blocks.iter().map(|block| block.rows.clone()), left)
}

/// The same of rows as they weigh, so that one outlier is not most of it.
#[must_use]
pub(crate) fn weighed_rms(layout: &Layout, left: &[f64]) -> f64 {
    weighed(layout, layout.blocks.iter().cloned(), left)
}

/// Root mean square about the mean of each stretch, rows as they weigh.
fn weighed(layout: &Layout, stretches: impl Iterator<Item = Block>, left: &[f64]) -> f64 {
    let (mut square, mut all) = (0.0, 0.0);
    for stretch in stretches {
        let part = &left[stretch.rows.clone()];
        let variance = stretch.variance();
        let weights = layout.inflation[stretch.rows].iter().map(|by| 1.0 / (by * variance));
        let weight: f64 = weights.clone().sum();
        let sum: f64 = weights.clone().zip(part).map(|(by, value)| by * value).sum();
        let mean = sum / weight.max(f64::MIN_POSITIVE);
        let about = part.iter().map(|value| (value - mean) * (value - mean));
        square += weights.zip(about).map(|(by, value)| by * value).sum::<f64>();
        all += weight;
    }
    (square / all.max(f64::MIN_POSITIVE)).sqrt()
}

/// Root mean square about the mean of each tenth of a pass, µm, rows as they weigh: slow effects
/// that are still to be found are no noise for a swift one.
#[must_use]
pub(crate) fn swift_rms(layout: &Layout, left: &[f64]) -> f64 {
    let stretches = layout.blocks.iter().flat_map(|block| {
        let Range { start, end } = block.rows;
        let length = (end - start).div_ceil(STRETCHES).max(1);
        let part = move |from: usize| Block { rows: from..(from + length).min(end), ..*block };
        (start..end).step_by(length).map(part)
    });
    weighed(layout, stretches, left)
}
