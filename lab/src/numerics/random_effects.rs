//! Many coefficients that are drawn from one law.

use nalgebra::{DMatrix, DVector, SymmetricEigen};

use super::golden_maximum;
use super::least_squares::dot;

/// Variances that are tried for the law: from so many powers of e below that at which the best
/// known coefficient is half noise, to four times as many above: targets differ up to some hundred thousand
/// times as much as visits of one.
const POWERS: f64 = 6.0;

/// Steps of the search among them, which leave two thousandths of a power.
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
    drawn_sizes_gain_with(columns, target, &[])
}

/// The same of such columns and of some of free sizes, which are whitened and free of the model, too: what the law
/// leaves of these is weighed as generalised least squares do.
#[must_use]
pub(crate) fn drawn_sizes_gain_with(
    columns: &[Vec<f64>],
    target: &[f64],
    free: &[Vec<f64>],
) -> f64 {
    let products = |one: &[Vec<f64>], other: &[Vec<f64>]| {
        DMatrix::from_fn(one.len(), other.len(), |i, j| dot(&one[i], &other[j]))
    };
    let moments = |one: &[Vec<f64>]| DVector::from_fn(one.len(), |i, _| dot(&one[i], target));
    if columns.is_empty() {
        return explained(&products(free, free), &moments(free));
    }
    let (of_free, free_along) = (products(free, free), moments(free));
    let eigen = SymmetricEigen::new(products(columns, columns));
    let along = eigen.eigenvectors.transpose() * moments(columns);
    let across = eigen.eigenvectors.transpose() * products(columns, free);
    let gain = |variance: f64| -> f64 {
        let grown = eigen.eigenvalues.map(|value| 1.0 + variance * value.max(0.0));
        let share = grown.map(|grown| variance / grown);
        let of_law: f64 = along.component_mul(&along).dot(&share) - grown.map(libm::log).sum();
        let shared = DMatrix::from_fn(free.len(), share.len(), |i, j| across[(j, i)] * share[j]);
        let left = &free_along - &shared * &along;
        of_law + explained(&(&of_free - shared * &across), &left)
    };
    let nothing = gain(0.0);
    let largest = eigen.eigenvalues.iter().copied().fold(0.0, f64::max);
    if largest <= 0.0 {
        return nothing;
    }
    let mut of_power = |log_ratio: f64| gain(libm::exp(log_ratio) / largest);
    let (_, best) = golden_maximum(&mut of_power, (-POWERS, 4.0 * POWERS), STEPS);
    best.max(nothing)
}

/// What columns of such products explain of a target with such moments.
fn explained(products: &DMatrix<f64>, moments: &DVector<f64>) -> f64 {
    let sizes = products.clone().cholesky().map(|root| root.solve(moments));
    sizes.map_or(0.0, |sizes| moments.dot(&sizes))
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

    /// Coefficients that are alike but for a scatter of their own, seen in noise that is far smaller: their mean is
    /// told by that scatter, as in the test of Student, `k·ln(1 + t²/(k − 1))`.
    #[test]
    fn a_mean_is_told_by_the_scatter_about_it() {
        let unit = |i: usize| (0..8).map(|j| f64::from(u8::from(i == j))).collect::<Vec<f64>>();
        let columns: Vec<Vec<f64>> = (0..8).map(unit).collect();
        for mean in [0.0, 300.0, 3000.0] {
            let target: Vec<f64> =
                (0..8).map(|i| mean + if i % 2 == 0 { 1000.0 } else { -1000.0 }).collect();
            let ratio = mean / 1000.0;
            let expected = 8.0 * libm::log(1.0 + ratio * ratio);
            let alike = [vec![1.0; 8]];
            let said = drawn_sizes_gain_with(&columns, &target, &alike)
                - drawn_sizes_gain(&columns, &target);
            assert!((said - expected).abs() < 0.01 + 1e-3 * expected, "{mean}: {said}, {expected}");
        }
    }
}
