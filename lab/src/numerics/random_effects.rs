//! Many coefficients that are drawn from one law.

use nalgebra::{DMatrix, DVector, SymmetricEigen};

use super::golden_maximum;
use super::least_squares::dot;

/// Variances that are tried for the law: from so many powers of e below that at which the best
/// known coefficient is half noise, to twice as many above.
const POWERS: f64 = 6.0;

/// Steps of the search among them, which leave a thousandth of a power.
const STEPS: usize = 20;

/// By how much twice the log likelihood grows when whitened columns join whose coefficients are
/// drawn from a normal law about zero, at its likeliest deviation.
///
/// With the coefficients integrated out it is `Σ cᵢ²·v/(1+v·λᵢ) − ln(1+v·λᵢ)`, of the eigenvalues
/// `λᵢ` of the columns' products, the moments `cᵢ` along their vectors and the variance `v` (the
/// marginal likelihood of random effects: Searle and others, *Variance Components*,
/// 1992, chapter 6).
#[must_use]
pub(crate) fn drawn_sizes_gain(columns: &[Vec<f64>], target: &[f64]) -> f64 {
    let width = columns.len();
    if width == 0 {
        return 0.0;
    }
    let products = DMatrix::from_fn(width, width, |i, j| dot(&columns[i], &columns[j]));
    let moments = DVector::from_fn(width, |i, _| dot(&columns[i], target));
    let eigen = SymmetricEigen::new(products);
    let along = eigen.eigenvectors.transpose() * moments;
    let largest = eigen.eigenvalues.iter().copied().fold(0.0, f64::max);
    if largest <= 0.0 {
        return 0.0;
    }
    let mut gain = |log_ratio: f64| -> f64 {
        let variance = libm::exp(log_ratio) / largest;
        let terms = eigen.eigenvalues.iter().zip(along.iter()).map(|(value, moment)| {
            let grown = 1.0 + variance * value.max(0.0);
            moment * moment * variance / grown - libm::log(grown)
        });
        terms.sum()
    };
    let (_, best) = golden_maximum(&mut gain, (-POWERS, 2.0 * POWERS), STEPS);
    best.max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::count;

    /// Coefficients seen once each in noise of 1: their mean square `s` is noise and law together,
    /// and `k·(s − 1 − ln s)` is gained, nothing where they are no larger than noise.
    #[test]
    fn as_much_is_gained_as_the_mean_square_tells() {
        let unit = |i: usize| (0..8).map(|j| f64::from(u8::from(i == j))).collect::<Vec<f64>>();
        let columns: Vec<Vec<f64>> = (0..8).map(unit).collect();
        for size in [0.5_f64, 1.5, 3.0, 20.0] {
            let target: Vec<f64> = (0..8).map(|i| if i % 2 == 0 { size } else { -size }).collect();
            let square = (size * size).max(1.0);
            let expected = count(columns.len()) * (square - 1.0 - libm::log(square));
            let said = drawn_sizes_gain(&columns, &target);
            assert!((said - expected).abs() < 0.01 + 1e-3 * expected, "{size}: {said}, {expected}");
        }
        assert!(drawn_sizes_gain(&[], &[1.0]).abs() < 1e-12);
    }
}
