//! Effects and noise fitted together to all sensors.
//!
//! For given nonlinear values the effects are linear, so generalised least squares gives their
//! best coefficients; the noise follows from what is left; both are repeated until they agree.
//! That is the maximum of the joint likelihood (profiled over the coefficients, as in variable
//! projection: Golub and Pereyra 1973).

use std::ops::Range;

use helixlock_plant::EffectError;
use nalgebra::DMatrix;
use rayon::prelude::*;

use crate::component::Component;
use crate::layout::Layout;
use crate::least_squares::{self, LinearFit};
use crate::noise::{Noise, Whitener};
use crate::noise_fit::fit_noise;
use crate::problem::Problem;

/// Columns of all components, stacked for one least-squares fit.
#[derive(Debug, Clone, Default)]
pub struct Columns {
    /// Row by row.
    pub raw: Vec<Vec<f64>>,
    /// Prior mean and standard deviation, where physics fixes a coefficient.
    pub priors: Vec<Option<(f64, f64)>>,
    /// What to take off the target first.
    pub fixed: Option<Vec<f64>>,
}

/// Columns whitened at once, so that two threads share what a fit has.
const TOGETHER: usize = 8;

impl Columns {
    /// Columns of some components.
    ///
    /// # Errors
    ///
    /// [`EffectError`] when a column of data or a section of the machine file is missing.
    pub fn of(problem: &Problem, components: &[Component]) -> Result<Self, EffectError> {
        let mut all = Self::default();
        for component in components {
            let (design, priors) = component.design(problem)?;
            all.raw.extend(design.columns);
            all.priors.extend(priors);
            all.take_off(design.fixed);
        }
        Ok(all)
    }

    /// Free columns that belong to no effect.
    #[must_use]
    pub fn free(raw: Vec<Vec<f64>>) -> Self {
        let priors = vec![None; raw.len()];
        Self { raw, priors, fixed: None }
    }

    /// These columns followed by others.
    #[must_use]
    pub fn and(&self, more: &Self) -> Self {
        let mut both = self.clone();
        both.raw.extend(more.raw.iter().cloned());
        both.priors.extend(more.priors.iter().copied());
        both.take_off(more.fixed.clone());
        both
    }

    fn take_off(&mut self, fixed: Option<Vec<f64>>) {
        match (&mut self.fixed, fixed) {
            (Some(sum), Some(more)) => sum.iter_mut().zip(more).for_each(|(a, b)| *a += b),
            (slot @ None, more) => *slot = more,
            (Some(_), None) => {}
        }
    }

    /// Whitened with one more row a prior, so that plain least squares obeys it.
    #[must_use]
    pub fn whitened(&self, whitener: &Whitener) -> Vec<Vec<f64>> {
        let together = |part: &[&[f64]]| whitener.whiten_all(part);
        let mut white: Vec<Vec<f64>> =
            self.views().par_chunks(TOGETHER).flat_map_iter(together).collect();
        self.hold_to_priors(&mut white);
        white
    }

    /// The columns as slices.
    #[must_use]
    pub fn views(&self) -> Vec<&[f64]> {
        self.raw.iter().map(Vec::as_slice).collect()
    }

    /// Lengthens whitened columns by one row a prior.
    pub fn hold_to_priors(&self, white: &mut [Vec<f64>]) {
        for (index, prior) in self.priors.iter().enumerate() {
            let Some((_, deviation)) = prior else { continue };
            for (other, column) in white.iter_mut().enumerate() {
                column.push(if other == index { 1.0 / deviation } else { 0.0 });
            }
        }
    }

    /// The whitened target with the rows of the priors.
    #[must_use]
    pub fn target(&self, whitener: &Whitener, residual: &[f64]) -> Vec<f64> {
        let mut white = match &self.fixed {
            None => whitener.whiten(residual),
            Some(fixed) => {
                let left: Vec<f64> = residual.iter().zip(fixed).map(|(r, f)| r - f).collect();
                whitener.whiten(&left)
            }
        };
        white.extend(self.priors.iter().flatten().map(|(mean, deviation)| mean / deviation));
        white
    }

    /// What is left of a residual when the columns weigh so much.
    #[must_use]
    pub fn left(&self, residual: &[f64], coefficients: &[f64]) -> Vec<f64> {
        let mut left = residual.to_vec();
        let weighted = self.raw.iter().map(Vec::as_slice).zip(coefficients.iter().copied());
        let fixed = self.fixed.iter().map(|fixed| (fixed.as_slice(), 1.0));
        for (column, weight) in weighted.chain(fixed) {
            left.iter_mut().zip(column).for_each(|(value, part)| *value -= weight * part);
        }
        left
    }
}

/// A fitted model.
#[derive(Debug, Clone)]
pub struct Fit {
    /// Coefficients of the stacked columns.
    pub linear: LinearFit,
    /// Noise of each sensor.
    pub noises: Vec<Noise>,
    /// Log likelihood of data and priors, without constants that all models share.
    pub log_likelihood: f64,
    /// What the model leaves, offsets of passes still in it.
    pub left: Vec<f64>,
}

/// Rounds of coefficients and noise; the likelihood hardly moves after the third.
const ROUNDS: usize = 4;

/// Fits columns and noise to the residual of a problem, beginning with some noise.
#[must_use]
pub fn settle(problem: &Problem, columns: &Columns, start: &[Noise]) -> Fit {
    let residual = problem.residual();
    let mut fit = with_noise(&problem.layout, columns, &residual, start);
    for _ in 0..ROUNDS {
        let noises = adjusted_noises(problem, &fit.left, &fit.noises);
        let next = with_noise(&problem.layout, columns, &residual, &noises);
        let gained = next.log_likelihood - fit.log_likelihood;
        if 0.0 < gained {
            fit = next;
        }
        if gained < 0.05 || columns.raw.is_empty() {
            break;
        }
    }
    fit
}

/// Fits columns under known noise.
#[must_use]
pub fn with_noise(layout: &Layout, columns: &Columns, residual: &[f64], noises: &[Noise]) -> Fit {
    let whitener = Whitener::new(layout, noises);
    let white = columns.whitened(&whitener);
    let views: Vec<&[f64]> = white.iter().map(Vec::as_slice).collect();
    let linear = least_squares::fit(&views, &columns.target(&whitener, residual));
    let left = columns.left(residual, &linear.coefficients);
    let log_likelihood = -0.5 * (linear.residual_square + whitener.log_determinant());
    Fit { linear, noises: noises.to_vec(), log_likelihood, left }
}

/// Noise of each sensor from what a model leaves.
#[must_use]
pub fn noises_of(problem: &Problem, left: &[f64]) -> Vec<Noise> {
    (0..problem.sensors.len()).map(|sensor| noise_of(problem, left, sensor, None)).collect()
}

/// Noise of each sensor, searched for near one that is nearly right.
fn adjusted_noises(problem: &Problem, left: &[f64], near: &[Noise]) -> Vec<Noise> {
    let with_index = near.iter().enumerate();
    with_index.map(|(sensor, noise)| noise_of(problem, left, sensor, Some(noise))).collect()
}

/// Least noise of a sensor, µm: a meter's clock is no finer, and a simulated record without any
/// would weigh so much that nothing else could be calculated.
const LEAST_UM: f64 = 1e-4;

fn noise_of(problem: &Problem, left: &[f64], sensor: usize, near: Option<&Noise>) -> Noise {
    let (layout, rows) = problem.of_sensor(sensor);
    let part: Vec<f64> = rows.iter().map(|&row| left[row]).collect();
    let noise = fit_noise(&layout, &part, near).noise;
    Noise { white: noise.white.max(LEAST_UM * LEAST_UM), ..noise }
}

/// Root mean square about the offset of each pass, all sensors together, µm.
#[must_use]
pub fn rms(layout: &Layout, left: &[f64]) -> f64 {
    rms_about_means(layout.blocks.iter().map(|block| block.rows.clone()), left)
}

/// Root mean square of values about the mean of each of their parts.
pub fn rms_about_means(parts: impl IntoIterator<Item = Range<usize>>, values: &[f64]) -> f64 {
    let mut square = 0.0;
    for rows in parts {
        let part = &values[rows];
        let mean = part.iter().sum::<f64>() / crate::count(part.len().max(1));
        square += part.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>();
    }
    (square / crate::count(values.len().max(1))).sqrt()
}

/// Stretches a pass is cut into to tell what is swift from what is slow.
const STRETCHES: usize = 10;

/// Root mean square about the mean of each tenth of a pass, µm: slow effects that are still to be
/// found are no noise for a swift one.
#[must_use]
pub fn swift_rms(layout: &Layout, left: &[f64]) -> f64 {
    let stretches = layout.blocks.iter().flat_map(|block| {
        let Range { start, end } = block.rows;
        let length = (end - start).div_ceil(STRETCHES).max(1);
        (start..end).step_by(length).map(move |from| from..(from + length).min(end))
    });
    rms_about_means(stretches, left)
}

/// A part of a covariance as plain rows.
#[must_use]
pub fn covariance_rows(matrix: &DMatrix<f64>, from: usize, width: usize) -> Vec<Vec<f64>> {
    (from..from + width).map(|i| (from..from + width).map(|j| matrix[(i, j)]).collect()).collect()
}
