//! Effects and noise fitted together to all sensors.
//!
//! For given nonlinear values the effects are linear, so generalised least squares gives their
//! best coefficients; the noise follows from what is left; both are repeated until they agree.
//! That is the maximum of the joint likelihood (profiled over the coefficients, as in variable
//! projection: Golub and Pereyra 1973).

use super::columns::Columns;
use super::problem::Problem;
use crate::noise::{Layout, Noise, Whitener, fit_noise};
use crate::numerics::least_squares::LinearFit;
use crate::numerics::{deviation, least_squares};

/// A fitted model.
#[derive(Debug, Clone)]
pub(crate) struct Fit {
    /// Coefficients of the stacked columns.
    pub(crate) linear: LinearFit,
    /// Noise of each sensor.
    pub(crate) noises: Vec<Noise>,
    /// Log likelihood of data and priors, without constants that all models share.
    pub(crate) log_likelihood: f64,
    /// What the model leaves, offsets of passes still in it.
    pub(crate) left: Vec<f64>,
}

/// Rounds of coefficients and noise; the likelihood hardly moves after the third.
const ROUNDS: usize = 4;

/// Fits columns and noise to the residual of a problem, beginning with some noise.
#[must_use]
pub(crate) fn settle(problem: &Problem, columns: &Columns, start: &[Noise]) -> Fit {
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

/// The same, and no less likely than with as many slow parts as the noise of a smaller model.
///
/// A noise found anew pays for its parts and may have fewer; compared with a model that keeps
/// them, the columns would be charged for what the noise has lost.
#[must_use]
pub(crate) fn settle_beside(
    problem: &Problem,
    columns: &Columns,
    start: &[Noise],
    smaller: &[Noise],
) -> Fit {
    let fit = settle(problem, columns, start);
    let fewer = |(own, other): (&Noise, &Noise)| own.slow.len() < other.slow.len();
    if !fit.noises.iter().zip(smaller).any(fewer) {
        return fit;
    }
    let kept = settle(problem, columns, smaller);
    if fit.log_likelihood < kept.log_likelihood { kept } else { fit }
}

/// Fits columns under known noise.
#[must_use]
pub(crate) fn with_noise(
    layout: &Layout,
    columns: &Columns,
    residual: &[f64],
    noises: &[Noise],
) -> Fit {
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
pub(crate) fn noises_of(problem: &Problem, left: &[f64]) -> Vec<Noise> {
    (0..problem.sensors.len()).map(|sensor| noise_of(problem, left, sensor, None)).collect()
}

/// White noise of the size that neighbouring samples of what is left differ by: no slow effect hides in it.
#[must_use]
pub(crate) fn plain_noises(problem: &Problem, left: &[f64]) -> Vec<Noise> {
    (0..problem.sensors.len())
        .map(|sensor| {
            let blocks = problem.layout.blocks.iter().filter(|block| block.sensor == sensor);
            let mut steps: Vec<f64> = blocks
                .flat_map(|block| block.rows.clone().skip(1))
                .map(|row| (left[row] - left[row - 1]).abs())
                .collect();
            let deviation = deviation(&mut steps).max(f64::MIN_POSITIVE.sqrt());
            Noise::white().scaled(0.5 * deviation * deviation)
        })
        .collect()
}

/// Noise of each sensor, searched for near one that is nearly right.
fn adjusted_noises(problem: &Problem, left: &[f64], near: &[Noise]) -> Vec<Noise> {
    let with_index = near.iter().enumerate();
    with_index.map(|(sensor, noise)| noise_of(problem, left, sensor, Some(noise))).collect()
}

fn noise_of(problem: &Problem, left: &[f64], sensor: usize, near: Option<&Noise>) -> Noise {
    let (layout, rows) = problem.layout.of_sensor(sensor);
    let noise = fit_noise(&layout, &left[rows], near).noise;
    Noise { white: noise.white.max(problem.least_variance[sensor]), ..noise }
}
