//! Symmetric positive definite band matrices.

/// Lower half of a symmetric band matrix, row by row: `bands[i][d]` is the element `(i, i − d)`.
pub(crate) struct Banded {
    bands: Vec<Vec<f64>>,
}

impl Banded {
    /// Zeros, with elements up to `width` off the diagonal.
    pub(crate) fn zeros(size: usize, width: usize) -> Self {
        Self { bands: vec![vec![0.0; width + 1]; size] }
    }

    /// Adds `weight · row rowᵀ`, where `row` has the given elements, each `(column, value)`.
    pub(crate) fn add_outer(&mut self, row: &[(usize, f64)], weight: f64) {
        for &(i, left) in row {
            for &(j, right) in row.iter().filter(|(j, _)| *j <= i) {
                self.bands[i][i - j] += weight * left * right;
            }
        }
    }

    /// Adds to one element, at or below the diagonal.
    pub(crate) fn add(&mut self, row: usize, column: usize, value: f64) {
        self.bands[row][row - column] += value;
    }

    /// Cholesky factor in place of the matrix; `None` when it is not positive definite.
    pub(crate) fn factor(mut self) -> Option<Factor> {
        let width = self.bands.first().map_or(0, |row| row.len() - 1);
        for i in 0..self.bands.len() {
            for d in (0..=width.min(i)).rev() {
                let j = i - d;
                let mut sum = self.bands[i][d];
                for k in i.saturating_sub(width)..j {
                    if j - k <= width {
                        sum -= self.bands[i][i - k] * self.bands[j][j - k];
                    }
                }
                if d == 0 {
                    if sum.is_nan() || sum <= 0.0 {
                        return None;
                    }
                    self.bands[i][0] = sum.sqrt();
                } else {
                    self.bands[i][d] = sum / self.bands[j][0];
                }
            }
        }
        Some(Factor(self.bands))
    }
}

/// A Cholesky factor.
pub(crate) struct Factor(Vec<Vec<f64>>);

impl Factor {
    /// Natural logarithm of the determinant of the matrix.
    pub(crate) fn log_determinant(&self) -> f64 {
        2.0 * self.0.iter().map(|row| libm::log(row[0])).sum::<f64>()
    }

    /// The lower triangle times a vector: independent normal numbers become those of the covariance.
    pub(crate) fn spread(&self, normal: &[f64]) -> Vec<f64> {
        let row = |(i, row): (usize, &Vec<f64>)| {
            row.iter().take(i + 1).enumerate().map(|(d, value)| value * normal[i - d]).sum()
        };
        self.0.iter().enumerate().map(row).collect()
    }

    /// Solves for one right-hand side.
    pub(crate) fn solve(&self, right: &[f64]) -> Vec<f64> {
        let mut x = right.to_vec();
        for i in 0..x.len() {
            let width = (self.0[i].len() - 1).min(i);
            let known: f64 = (1..=width).map(|d| self.0[i][d] * x[i - d]).sum();
            x[i] = (x[i] - known) / self.0[i][0];
        }
        self.drawn(x)
    }

    /// The inverse of the upper triangle times a vector: independent normal numbers become those whose
    /// precision the matrix is.
    pub(crate) fn drawn(&self, mut normal: Vec<f64>) -> Vec<f64> {
        for i in (0..normal.len()).rev() {
            normal[i] /= self.0[i][0];
            for d in 1..=(self.0[i].len() - 1).min(i) {
                normal[i - d] -= self.0[i][d] * normal[i];
            }
        }
        normal
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The second-difference matrix of size 4 has determinant 5; solved by hand for ones.
    #[test]
    fn second_difference() {
        let mut matrix = Banded::zeros(4, 1);
        for i in 0..4 {
            matrix.add_outer(&[(i, 1.0)], 2.0);
        }
        for i in 1..4 {
            matrix.add_outer(&[(i - 1, 1.0), (i, -1.0)], 1.0);
            matrix.add_outer(&[(i - 1, 1.0)], -1.0);
            matrix.add_outer(&[(i, 1.0)], -1.0);
        }
        let factor = matrix.factor().unwrap();
        assert!((factor.log_determinant() - libm::log(5.0)).abs() < 1e-12);
        for (found, expected) in factor.solve(&[1.0; 4]).iter().zip([2.0, 3.0, 3.0, 2.0]) {
            assert!((found - expected).abs() < 1e-12);
        }
    }

    #[test]
    fn indefinite_matrices_are_refused() {
        let mut matrix = Banded::zeros(2, 1);
        matrix.add_outer(&[(0, 1.0), (1, 1.0)], 1.0);
        assert!(matrix.factor().is_none());
    }
}
