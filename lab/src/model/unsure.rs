//! How much less is known of coefficients because their noise is found in the same rows.
//!
//! A slow part that is too faint to be seen, or whose length is uncertain, may still move a slope by more
//! than the noise that was fitted says. By the law of total variance over noises `k`, about the fitted `β`
//!
//! ```text
//! var βᵢ = Σ w_k·(C_k,ii + (β_k,i − βᵢ)²)
//! ```
//!
//! with `w_k` what a noise is worth beforehand times its restricted likelihood: offsets and all columns
//! are projected out and counted (Patterson and Thompson 1971; Harville 1974).

use super::columns::Columns;
use super::fit::{Fit, with_noise};
use super::problem::Problem;
use super::state::State;
use crate::noise::{Layout, Noise, plausible, scaled_to};
use crate::numerics::{count, in_parallel};
use crate::policy::extent::SEARCHED_ROWS;

/// Rows that tell which noises may be, and the linearised model on them.
pub(super) struct Rows<'a> {
    layout: Layout,
    columns: Columns,
    left: Vec<f64>,
    noises: &'a [Noise],
    /// Of each sensor, see [`Problem::least_variance`].
    least_variance: &'a [f64],
}

/// Coefficients under one noise.
struct Under {
    log_weight: f64,
    /// Variances about the fitted coefficients.
    variances: Vec<f64>,
}

/// By how much the standard error of each coefficient of a linearised model is larger, or smaller, than
/// under the fitted noise. Each sensor's noise is varied alone.
#[must_use]
pub(super) fn widening(problem: &Problem, state: &State, columns: &Columns) -> Vec<f64> {
    let rows = Rows::of(problem, state, columns);
    let known = rows.fit(rows.noises);
    let mut wider = vec![1.0; columns.raw.len()];
    for sensor in 0..problem.sensors.len() {
        let about = rows.variances(sensor);
        for (index, (wider, about)) in wider.iter_mut().zip(about).enumerate() {
            let share = about / known.linear.covariance[(index, index)];
            if share.is_finite() && 0.0 < share {
                *wider *= share.sqrt();
            }
        }
    }
    wider
}

impl<'a> Rows<'a> {
    /// All rows, or as many, evenly picked, as a search looks at: what is faint among many rows is as
    /// faint against the errors of few.
    pub(super) fn of(problem: &'a Problem, state: &'a State, columns: &Columns) -> Self {
        let (noises, least_variance) = (&state.fit.noises, &problem.least_variance);
        let step = problem.samples.len().div_ceil(SEARCHED_ROWS).max(1);
        let (layout, rows) = problem.layout.every(step);
        let of_rows =
            |column: &[f64]| -> Vec<f64> { rows.iter().map(|&row| column[row]).collect() };
        let raw = columns.raw.iter().map(|column| of_rows(column).into()).collect();
        // A prior is about the coefficient; the coefficients here are what is added to the fitted ones.
        let coefficients =
            state.fit.linear.coefficients.iter().copied().chain(std::iter::repeat(0.0));
        let priors = columns.priors.iter().zip(coefficients);
        let priors = priors.map(|(prior, at)| prior.map(|(mean, sd)| (mean - at, sd))).collect();
        let columns = Columns { raw, priors, fixed: None };
        Self { layout, columns, left: of_rows(&state.fit.left), noises, least_variance }
    }

    /// What is added to the fitted coefficients under some noises.
    pub(super) fn fit(&self, noises: &[Noise]) -> Fit {
        with_noise(&self.layout, &self.columns, &self.left, noises)
    }

    /// Variances of the coefficients when the noise of a sensor is one of those that may be.
    fn variances(&self, sensor: usize) -> Vec<f64> {
        let (layout, rows) = self.layout.of_sensor(sensor);
        let may_be = plausible(&layout, &self.noises[sensor]);
        let under = in_parallel(&may_be, |one| {
            let mut noises = self.noises.to_vec();
            let noise = scaled_to(&layout, &self.left[rows.clone()], &one.shape);
            let white = noise.white.max(self.least_variance[sensor]);
            noises[sensor] = Noise { white, ..noise };
            self.under(&noises, one.share)
        });
        let likeliest = under.iter().map(|one| one.log_weight).fold(f64::NEG_INFINITY, f64::max);
        let mut variances = vec![0.0; self.columns.raw.len()];
        let mut sum = 0.0;
        for one in &under {
            let weight = libm::exp(one.log_weight - likeliest);
            sum += weight;
            variances.iter_mut().zip(&one.variances).for_each(|(all, own)| *all += weight * own);
        }
        variances.iter().map(|all| all / sum).collect()
    }

    /// The coefficients under a noise whose scale is what the rows say, and leaves no white
    /// part below a sensor's least.
    fn under(&self, noises: &[Noise], share: f64) -> Under {
        let fit = self.fit(noises);
        let linear = &fit.linear;
        let known = self.columns.priors.iter().flatten().count();
        let free =
            (self.layout.len() + known).saturating_sub(self.layout.blocks.len() + linear.rank);
        let free = count(free.max(1));
        let least =
            noises.iter().zip(self.least_variance).map(|(noise, least)| least / noise.white);
        let scale = least.fold(linear.residual_square / free, f64::max);
        // What the noise and the columns add to twice the negative log likelihood beside the square.
        let of_noise = -2.0 * fit.log_likelihood - linear.residual_square;
        let square = linear.residual_square / scale + free * libm::log(scale);
        let log_weight = libm::log(share) - 0.5 * (square + of_noise + linear.log_determinant);
        let moved = linear.coefficients.iter().enumerate();
        let variances =
            moved.map(|(at, by)| scale * linear.covariance[(at, at)] + by * by).collect();
        Under { log_weight, variances }
    }
}
