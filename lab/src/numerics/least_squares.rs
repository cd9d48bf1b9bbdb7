//! Generalised least squares on whitened columns.

use nalgebra::{DMatrix, DVector, SymmetricEigen};

/// What a linear fit gives; covariance at noise scale 1.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct LinearFit {
    /// One coefficient a column, in the column's unit.
    pub(crate) coefficients: Vec<f64>,
    /// Covariance of the coefficients for whitened noise of variance 1.
    pub(crate) covariance: DMatrix<f64>,
    /// Sum of squares of the whitened residual.
    pub(crate) residual_square: f64,
    /// Number of directions of the columns that the data determine.
    pub(crate) rank: usize,
    /// Logarithm of the determinant of the columns' products, on those directions.
    pub(crate) log_determinant: f64,
}

/// Share of a square below which a difference of squares has lost half of its digits.
const NEARLY_ALL: f64 = 1e-8;

/// Fits `target ≈ Σ cᵢ·columnᵢ`, all whitened alike, by the normal equations of scaled columns.
///
/// Directions weaker than 1e-10 of the strongest are left out (their coefficients are the
/// smallest ones), so that columns which say the same do not blow up. Where nearly all is explained,
/// what is left of it is fitted once more, for a difference of large squares says nothing of it.
#[must_use]
pub(crate) fn fit(columns: &[&[f64]], target: &[f64]) -> LinearFit {
    let first = by_normal_equations(columns, target);
    if NEARLY_ALL * dot(target, target) <= first.residual_square {
        return first;
    }
    let rest = left(columns, target, &first.coefficients);
    let second = by_normal_equations(columns, &rest);
    let rest = left(columns, &rest, &second.coefficients);
    let both = first.coefficients.iter().zip(&second.coefficients).map(|(a, b)| a + b);
    LinearFit { coefficients: both.collect(), residual_square: dot(&rest, &rest), ..first }
}

/// What columns that weigh so much leave of a target.
#[must_use]
pub(crate) fn left(columns: &[&[f64]], target: &[f64], coefficients: &[f64]) -> Vec<f64> {
    let mut left = target.to_vec();
    for (column, size) in columns.iter().zip(coefficients) {
        left.iter_mut().zip(*column).for_each(|(rest, value)| *rest -= size * value);
    }
    left
}

fn by_normal_equations(columns: &[&[f64]], target: &[f64]) -> LinearFit {
    let count = columns.len();
    let total = dot(target, target);
    let norms: Vec<f64> = columns.iter().map(|column| dot(column, column).sqrt()).collect();
    let scale = |i: usize| if norms[i] > 0.0 { 1.0 / norms[i] } else { 0.0 };
    let gram = DMatrix::from_fn(count, count, |i, j| {
        if i <= j { dot(columns[i], columns[j]) * scale(i) * scale(j) } else { 0.0 }
    });
    let gram = DMatrix::from_fn(count, count, |i, j| gram[(i.min(j), i.max(j))]);
    let moment = DVector::from_fn(count, |i, _| dot(columns[i], target) * scale(i));
    let (inverse, rank, of_scaled) = pseudo_inverse(gram);
    let lengths = norms.iter().filter(|norm| 0.0 < **norm);
    let log_determinant = of_scaled + 2.0 * lengths.map(|norm| libm::log(*norm)).sum::<f64>();
    let scaled = &inverse * &moment;
    let explained = scaled.dot(&moment);
    let covariance = DMatrix::from_fn(count, count, |i, j| inverse[(i, j)] * scale(i) * scale(j));
    let coefficients = (0..count).map(|i| scaled[i] * scale(i)).collect();
    let residual_square = (total - explained).max(0.0);
    LinearFit { coefficients, covariance, residual_square, rank, log_determinant }
}

/// Inverse of a symmetric matrix of unit diagonal on the directions that matter, their number, and the
/// logarithm of its determinant there.
fn pseudo_inverse(gram: DMatrix<f64>) -> (DMatrix<f64>, usize, f64) {
    let count = gram.nrows();
    if count == 0 {
        return (gram, 0, 0.0);
    }
    let eigen = SymmetricEigen::new(gram);
    let largest = eigen.eigenvalues.iter().copied().fold(0.0, f64::max);
    let mut inverse = DMatrix::zeros(count, count);
    let mut rank = 0;
    let mut log_determinant = 0.0;
    for (value, vector) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
        if *value > 1e-10 * largest {
            inverse += vector * vector.transpose() / *value;
            rank += 1;
            log_determinant += libm::log(*value);
        }
    }
    (inverse, rank, log_determinant)
}

/// Scalar product, summed in eight lanes: one sum after the other would wait for itself.
#[must_use]
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    const LANES: usize = 8;
    let rows = a.len().min(b.len());
    let (a, a_rest) = a[..rows].as_chunks::<LANES>();
    let (b, b_rest) = b[..rows].as_chunks::<LANES>();
    let mut sums = [0.0; LANES];
    for (a, b) in a.iter().zip(b) {
        for lane in 0..LANES {
            sums[lane] += a[lane] * b[lane];
        }
    }
    let rest: f64 = a_rest.iter().zip(b_rest).map(|(x, y)| x * y).sum();
    sums.iter().sum::<f64>() + rest
}

/// Sum of the products of values that stand so many rows apart, of which there are no fewer.
#[must_use]
pub(crate) fn lagged(values: &[f64], lag: usize) -> f64 {
    dot(&values[lag..], &values[..values.len() - lag])
}

/// A part of a covariance as plain rows.
#[must_use]
pub(crate) fn covariance_rows(matrix: &DMatrix<f64>, from: usize, width: usize) -> Vec<Vec<f64>> {
    (from..from + width).map(|i| (from..from + width).map(|j| matrix[(i, j)]).collect()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Noise beside a slope and a parabola that are 10⁸ times as large.
    #[test]
    fn little_that_is_left_of_much_is_told() {
        let x: Vec<f64> = (0..400).map(f64::from).collect();
        let square: Vec<f64> = x.iter().map(|x| x * x).collect();
        let noise: Vec<f64> = x.iter().map(|x| libm::sin(x * x)).collect();
        let target = |size: f64| -> Vec<f64> {
            (0..400).map(|i| noise[i] + size * (square[i] - 300.0 * x[i])).collect()
        };
        let left = |size| fit(&[&x, &square], &target(size)).residual_square;
        assert!((left(1e4) / left(0.0) - 1.0).abs() < 1e-6, "{} {}", left(1e4), left(0.0));
    }
}
