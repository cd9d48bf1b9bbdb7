//! Slow noise that is smooth, beside slow noise that forgets.
//!
//! What forgets is rough: its path has no slope anywhere. What a cause draws has one. So noise with a
//! smooth part, of the covariance
//!
//! ```text
//! K(i, j) = w²·[i = j] + a²·(1 + s + s²/3)·exp(−s),  s = √5·|u_i − u_j| / ℓ
//! ```
//!
//! (Matérn's of order 5/2: Rasmussen and Williams 2006, *Gaussian processes for machine learning*, eq. 4.17; the
//! parts of [`super::Noise`] are his of order 1/2) is held against it by the same restricted likelihood. Its three
//! states, value, slope and curvature, make it a Kalman filter as well (Hartikainen and Särkkä 2010, *Kalman
//! filtering and smoothing solutions to temporal Gaussian process regression models*, IEEE MLSP).

use nalgebra::{Matrix2, Matrix3, Matrix3x2, RowVector2, Vector2, Vector3};

use super::kernel::Noise;
use super::layout::{Block, Layout};
use super::noise_fit::{DESCENT, log_likelihood_of, longest_block, scaled_likelihood, variance};
use crate::numerics::count;
use crate::numerics::quasi_newton::minimise;

/// Lengths that a search begins at, against the longest block.
const STARTS: [f64; 3] = [0.03, 0.1, 0.3];

/// Noise with a smooth part, fitted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SmoothFit {
    /// By how much twice its log likelihood is ahead of noise that forgets.
    pub(crate) ahead: f64,
    /// Length ℓ of the smooth part, in sample intervals.
    pub(crate) length: f64,
}

/// Noise with a smooth part instead of `forgetting` noise, fitted to the residual of one sensor.
#[must_use]
pub(crate) fn smooth_fit(layout: &Layout, residual: &[f64], forgetting: &Noise) -> SmoothFit {
    let span = longest_block(layout).max(2.0);
    let value = |point: &Vector2<f64>| log_likelihood(layout, residual, point, span);
    let found = STARTS.map(|share| {
        let start = Vector2::new(0.0, libm::log(share * span));
        let losses =
            |points: &[Vector2<f64>]| points.iter().map(|point| -value(point)).collect::<Vec<_>>();
        let point = minimise(losses, start, DESCENT);
        (value(&point), point)
    });
    let best = |a: (f64, Vector2<f64>), b: (f64, Vector2<f64>)| if a.0 < b.0 { b } else { a };
    let (smooth, point) = found.into_iter().reduce(best).unwrap_or_default();
    let rough = log_likelihood_of(layout, residual, forgetting);
    SmoothFit { ahead: 2.0 * (smooth - rough), length: length(&point, span) }
}

fn length(point: &Vector2<f64>, span: f64) -> f64 {
    libm::exp(point[1].clamp(0.0, libm::log(span)))
}

/// Restricted log likelihood, by logarithms of variance against the white one and of length.
fn log_likelihood(layout: &Layout, residual: &[f64], point: &Vector2<f64>, span: f64) -> f64 {
    let (variance, rate) = (variance(point[0]), 5.0_f64.sqrt() / length(point, span));
    let (mut square, mut log_determinant) = (0.0, 0.0);
    for block in layout.blocks.iter().filter(|block| !block.rows.is_empty()) {
        let (products, logarithm) = filtered(layout, residual, block, (variance, rate));
        let ones = products[(1, 1)].max(f64::MIN_POSITIVE);
        square += products[(0, 0)] - products[(0, 1)] * products[(0, 1)] / ones;
        log_determinant += logarithm + libm::log(ones);
    }
    scaled_likelihood(layout, square, log_determinant)
}

/// Whitened products of a block's residual and of ones, and the log determinant of its covariance.
fn filtered(
    layout: &Layout,
    residual: &[f64],
    block: &Block,
    (variance, rate): (f64, f64),
) -> (Matrix2<f64>, f64) {
    // In units of the rate all states are as large as the value.
    let third = -1.0 / 3.0;
    let settled = variance * Matrix3::new(1.0, 0.0, third, 0.0, -third, 0.0, third, 0.0, 1.0);
    let (mut spread, mut state) = (settled, Matrix3x2::<f64>::zeros());
    let (mut products, mut logarithm) = (Matrix2::zeros(), 0.0);
    for row in block.rows.clone() {
        if block.rows.start < row {
            let ahead = transition(rate * (layout.clock[row] - layout.clock[row - 1]));
            state = ahead * state;
            spread = settled + ahead * (spread - settled) * ahead.transpose();
        }
        let pivot = spread[(0, 0)] + layout.inflation[row];
        let news = RowVector2::new(residual[row], 1.0) - state.row(0);
        let gain: Vector3<f64> = spread.column(0) / pivot;
        state += gain * news;
        spread -= pivot * gain * gain.transpose();
        products += news.transpose() * news / pivot;
        logarithm += libm::log(pivot);
    }
    let variance = block.variance();
    (products / variance, logarithm + count(block.rows.len()) * libm::log(variance))
}

/// What value, slope and curvature are after a while, in units of the rate: `exp(F·s)`, whose `F + 1` is
/// nilpotent.
fn transition(s: f64) -> Matrix3<f64> {
    let more = Matrix3::new(1.0, 1.0, 0.0, 0.0, 1.0, 1.0, -1.0, -3.0, -2.0);
    libm::exp(-s) * (Matrix3::identity() + s * more + 0.5 * s * s * more * more)
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector};

    use super::*;
    use crate::noise::Block;

    /// Uneven rows of two blocks, an outlier among them.
    fn layout() -> Layout {
        let clock: Vec<f64> =
            (0..14).map(|row| f64::from(row) + 0.2 * f64::from(row * row % 5)).collect();
        let mut inflation = vec![1.0; 14];
        inflation[3] = 7.0;
        let block = |pass, rows, loudness| Block { sensor: 0, pass, rows, loudness };
        Layout {
            blocks: vec![block(0, 0..8, 0), block(1, 8..14, 2)],
            clock: clock.into_iter().collect(),
            inflation: inflation.into_iter().collect(),
        }
    }

    #[test]
    fn is_the_likelihood_of_the_covariance_as_written() {
        let layout = layout();
        let residual: Vec<f64> = (0..14).map(|row| libm::sin(f64::from(row * row))).collect();
        let (variance, length): (f64, f64) = (2.5, 3.0);
        let (mut square, mut log_determinant) = (0.0, 0.0);
        for block in &layout.blocks {
            let rows: Vec<usize> = block.rows.clone().collect();
            let covariance = DMatrix::from_fn(rows.len(), rows.len(), |i, j| {
                let s =
                    5.0_f64.sqrt() * (layout.clock[rows[i]] - layout.clock[rows[j]]).abs() / length;
                let white = if i == j { layout.inflation[rows[i]] } else { 0.0 };
                let loudness = if block.pass == 1 { 4.0 } else { 1.0 };
                loudness * (white + variance * (1.0 + s + s * s / 3.0) * libm::exp(-s))
            });
            let values = DVector::from_iterator(rows.len(), rows.iter().map(|&row| residual[row]));
            let ones = DVector::from_element(rows.len(), 1.0);
            let inverse = covariance.clone().try_inverse().expect("a covariance");
            let [own, with, all] = [(&values, &values), (&values, &ones), (&ones, &ones)]
                .map(|(a, b)| (a.transpose() * &inverse * b)[0]);
            square += own - with * with / all;
            log_determinant += libm::log(covariance.determinant()) + libm::log(all);
        }
        let expected = scaled_likelihood(&layout, square, log_determinant);
        let point = Vector2::new(libm::log(variance), libm::log(length));
        let found = log_likelihood(&layout, &residual, &point, 20.0);
        assert!((found - expected).abs() < 1e-9, "{found}, not {expected}");
    }
}
