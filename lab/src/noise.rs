//! Correlated noise of a recorder: white plus slow parts, at O(n) a column and for any sampling.
//!
//! The covariance of two samples of one block is
//!
//! ```text
//! K(i, j) = w²·[i = j] + Σ a_k²·exp(−|u_i − u_j| / τ_k)
//! ```
//!
//! with `u` in sample intervals. One slow part is AR(1) when sampling is even; two cover what
//! lies between white, 1/f and a random walk. Its Cholesky factor is semiseparable, so whitening
//! costs a handful of multiplications a sample (Foreman-Mackey et al. 2017, *Fast and scalable
//! Gaussian process modeling*, AJ 154:220, equations 40 to 48, real terms).

use crate::layout::Layout;

/// Most slow parts a noise model has.
pub const PARTS: usize = 2;

/// One exponentially forgetting part (Ornstein–Uhlenbeck process).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlowPart {
    /// Variance against that of the white part; the whole is scaled later.
    pub variance: f64,
    /// Correlation length in sample intervals.
    pub length: f64,
}

/// The noise of one sensor, relative: variances against the white one, the scale apart.
#[derive(Debug, Clone, PartialEq)]
pub struct Noise {
    /// Variance of the white part at scale 1.
    pub white: f64,
    /// Slow parts, at most [`PARTS`].
    pub slow: Vec<SlowPart>,
}

impl Noise {
    /// Independent samples of variance 1.
    #[must_use]
    pub fn white() -> Self {
        Self { white: 1.0, slow: Vec::new() }
    }

    /// Variance of one sample.
    #[must_use]
    pub fn variance(&self) -> f64 {
        self.white + self.slow.iter().map(|part| part.variance).sum::<f64>()
    }

    /// The same shape with all variances multiplied.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        let slow =
            self.slow.iter().map(|part| SlowPart { variance: part.variance * factor, ..*part });
        Self { white: self.white * factor, slow: slow.collect() }
    }
}

/// The factorised covariance of all rows: makes columns white and frees them of pass offsets.
#[derive(Debug, Clone)]
pub struct Whitener {
    layout_rows: Vec<std::ops::Range<usize>>,
    decay: Vec<[f64; PARTS]>,
    gain: Vec<[f64; PARTS]>,
    variance: Vec<[f64; PARTS]>,
    inverse_root: Vec<f64>,
    ones: Vec<f64>,
    log_determinant: f64,
}

impl Whitener {
    /// Factorises the covariance; `noises` holds one model a sensor.
    #[must_use]
    pub fn new(layout: &Layout, noises: &[Noise]) -> Self {
        let rows = layout.len();
        let mut whitener = Self {
            layout_rows: layout.blocks.iter().map(|block| block.rows.clone()).collect(),
            decay: vec![[0.0; PARTS]; rows],
            gain: vec![[0.0; PARTS]; rows],
            variance: vec![[0.0; PARTS]; rows],
            inverse_root: vec![1.0; rows],
            ones: vec![1.0; rows],
            log_determinant: 0.0,
        };
        for block in &layout.blocks {
            whitener.factorise(layout, block.rows.clone(), &noises[block.sensor]);
        }
        whitener.ones = whitener.whiten_only(&vec![1.0; rows]);
        whitener.normalise_ones();
        whitener
    }

    /// Log determinant of the covariance, with that of the offsets (restricted likelihood).
    #[must_use]
    pub fn log_determinant(&self) -> f64 {
        self.log_determinant
    }

    /// Number of offsets projected out: one a block.
    #[must_use]
    pub fn offsets(&self) -> usize {
        self.layout_rows.len()
    }

    /// The column with unit, uncorrelated noise and without the part a pass offset explains.
    #[must_use]
    pub fn whiten(&self, column: &[f64]) -> Vec<f64> {
        let mut white = self.whiten_only(column);
        for rows in &self.layout_rows {
            let ones = &self.ones[rows.clone()];
            let part = &mut white[rows.clone()];
            let along: f64 = ones.iter().zip(part.iter()).map(|(one, value)| one * value).sum();
            for (value, one) in part.iter_mut().zip(ones) {
                *value -= along * one;
            }
        }
        white
    }

    /// The column with unit, uncorrelated noise; offsets stay in it.
    #[must_use]
    pub fn whiten_only(&self, column: &[f64]) -> Vec<f64> {
        let mut white = vec![0.0; column.len()];
        for rows in &self.layout_rows {
            let mut state = [0.0; PARTS];
            let mut before = 0.0;
            for row in rows.clone() {
                let mut value = column[row];
                for (part, memory) in state.iter_mut().enumerate() {
                    let carried =
                        if row == rows.start { 0.0 } else { self.gain[row - 1][part] * before };
                    *memory = self.decay[row][part] * (*memory + carried);
                    value -= self.variance[row][part] * *memory;
                }
                before = value;
                white[row] = value * self.inverse_root[row];
            }
        }
        white
    }

    /// Inverse covariance times the residual that `white` was made of: correlating it with any
    /// column gives the column's whitened product, without whitening the column.
    #[must_use]
    pub fn unwhiten(&self, white: &[f64]) -> Vec<f64> {
        let mut weighted = vec![0.0; white.len()];
        for rows in &self.layout_rows {
            let mut state = [0.0; PARTS];
            for row in rows.clone().rev() {
                let mut value = white[row] * self.inverse_root[row];
                for (part, memory) in state.iter_mut().enumerate() {
                    value -= self.gain[row][part] * *memory;
                }
                for (part, memory) in state.iter_mut().enumerate() {
                    *memory = self.decay[row][part] * (*memory + self.variance[row][part] * value);
                }
                weighted[row] = value;
            }
        }
        weighted
    }

    fn factorise(&mut self, layout: &Layout, rows: std::ops::Range<usize>, noise: &Noise) {
        let mut factor = Factor::new(noise);
        for row in rows.clone() {
            let interval = (rows.start < row).then(|| layout.clock[row] - layout.clock[row - 1]);
            factor.advance(interval, layout.inflation[row]);
            self.decay[row] = factor.decay;
            self.gain[row] = factor.gain;
            self.variance[row] = factor.variance;
            self.inverse_root[row] = 1.0 / factor.pivot.sqrt();
            self.log_determinant += libm::log(factor.pivot);
        }
    }

    /// Scales the whitened constants to length 1 a block and counts them in the determinant.
    fn normalise_ones(&mut self) {
        for rows in &self.layout_rows {
            let square: f64 = self.ones[rows.clone()].iter().map(|one| one * one).sum();
            let length = square.max(f64::MIN_POSITIVE).sqrt();
            self.log_determinant += 2.0 * libm::log(length);
            self.ones[rows.clone()].iter_mut().for_each(|one| *one /= length);
        }
    }
}

/// One row after the other of a block's Cholesky factor.
#[derive(Debug)]
struct Factor<'a> {
    noise: &'a Noise,
    slow: f64,
    variance: [f64; PARTS],
    memory: [[f64; PARTS]; PARTS],
    decay: [f64; PARTS],
    gain: [f64; PARTS],
    pivot: f64,
    decays: DecayCache,
}

impl<'a> Factor<'a> {
    fn new(noise: &'a Noise) -> Self {
        let mut variance = [0.0; PARTS];
        for (slot, part) in variance.iter_mut().zip(&noise.slow) {
            *slot = part.variance;
        }
        Self {
            noise,
            slow: variance.iter().sum(),
            variance,
            memory: [[0.0; PARTS]; PARTS],
            decay: [0.0; PARTS],
            gain: [0.0; PARTS],
            pivot: 0.0,
            decays: DecayCache::default(),
        }
    }

    /// Goes to the next row: `φφᵀ ∘ (S + d·w·wᵀ)`; `interval` is `None` for the first.
    fn advance(&mut self, interval: Option<f64>, inflation: f64) {
        if let Some(interval) = interval {
            self.decay = self.decays.over(interval, self.noise);
            for i in 0..PARTS {
                for j in 0..PARTS {
                    let grown = self.memory[i][j] + self.pivot * self.gain[i] * self.gain[j];
                    self.memory[i][j] = self.decay[i] * self.decay[j] * grown;
                }
            }
        }
        let projected = self.memory.map(|line| dot(&line, &self.variance));
        let pivot = self.noise.white * inflation + self.slow - dot(&projected, &self.variance);
        self.pivot = pivot.max(1e-12 * (self.noise.white + self.slow));
        self.gain = projected.map(|value| (1.0 - value) / self.pivot);
    }
}

/// Whitened square of a column without its offsets, and log determinant with theirs.
///
/// The same numbers as from a [`Whitener`], in one sweep without storing the factor.
#[must_use]
pub fn square_and_log_determinant(layout: &Layout, noise: &Noise, column: &[f64]) -> (f64, f64) {
    let (mut square, mut logarithm) = (0.0, 0.0);
    for block in &layout.blocks {
        let mut factor = Factor::new(noise);
        let mut state = [[0.0; PARTS]; 2];
        let mut before = [0.0; 2];
        let (mut sums, mut product) = ([0.0; 3], 1.0);
        for row in block.rows.clone() {
            let interval =
                (block.rows.start < row).then(|| layout.clock[row] - layout.clock[row - 1]);
            let carried = factor.gain;
            factor.advance(interval, layout.inflation[row]);
            let mut values = [column[row], 1.0];
            for (which, value) in values.iter_mut().enumerate() {
                for part in 0..PARTS {
                    let fresh = carried[part] * before[which];
                    state[which][part] = factor.decay[part] * (state[which][part] + fresh);
                    *value -= factor.variance[part] * state[which][part];
                }
                before[which] = *value;
            }
            let weight = 1.0 / factor.pivot;
            sums[0] += weight * values[0] * values[0];
            sums[1] += weight * values[0] * values[1];
            sums[2] += weight * values[1] * values[1];
            product *= factor.pivot;
            // One logarithm for many rows: it is taken before the product leaves the range.
            if !(1e-200..1e200).contains(&product) {
                logarithm += libm::log(product);
                product = 1.0;
            }
        }
        square += sums[0] - sums[1] * sums[1] / sums[2].max(f64::MIN_POSITIVE);
        logarithm += libm::log(product) + libm::log(sums[2].max(f64::MIN_POSITIVE));
    }
    (square, logarithm)
}

fn dot(a: &[f64; PARTS], b: &[f64; PARTS]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// Remembers the last decay: evenly sampled data need one exponential in all.
#[derive(Debug, Default)]
struct DecayCache {
    interval: Option<f64>,
    decay: [f64; PARTS],
}

impl DecayCache {
    fn over(&mut self, interval: f64, noise: &Noise) -> [f64; PARTS] {
        let same =
            self.interval.is_some_and(|known| (known - interval).abs() <= 1e-9 * interval.abs());
        if !same {
            self.interval = Some(interval);
            for (slot, part) in self.decay.iter_mut().zip(&noise.slow) {
                *slot = libm::exp(-interval.max(0.0) / part.length);
            }
        }
        self.decay
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector};

    use super::*;
    use crate::layout::Block;

    fn uneven() -> (Layout, Vec<Noise>) {
        let clock = vec![0.0, 1.0, 1.5, 4.0, 4.0, 7.0, 0.0, 2.0, 2.5, 9.0];
        let mut inflation = vec![1.0; 10];
        inflation[4] = 7.0;
        let blocks = vec![
            Block { sensor: 0, pass: 0, rows: 0..6 },
            Block { sensor: 1, pass: 0, rows: 6..10 },
        ];
        let slow =
            vec![SlowPart { variance: 2.0, length: 1.5 }, SlowPart { variance: 0.7, length: 40.0 }];
        let noises = vec![Noise { white: 0.3, slow }, Noise { white: 1.1, slow: vec![] }];
        (Layout { blocks, clock, inflation }, noises)
    }

    fn dense(layout: &Layout, noises: &[Noise]) -> DMatrix<f64> {
        let rows = layout.len();
        let mut matrix = DMatrix::zeros(rows, rows);
        for block in &layout.blocks {
            let noise = &noises[block.sensor];
            for i in block.rows.clone() {
                for j in block.rows.clone() {
                    let apart = (layout.clock[i] - layout.clock[j]).abs();
                    let slow = |p: &SlowPart| p.variance * libm::exp(-apart / p.length);
                    matrix[(i, j)] = noise.slow.iter().map(slow).sum();
                }
                matrix[(i, i)] += noise.white * layout.inflation[i];
            }
        }
        matrix
    }

    #[test]
    fn products_equal_those_of_the_dense_inverse() {
        let (layout, noises) = uneven();
        let inverse = dense(&layout, &noises).try_inverse().unwrap();
        let whitener = Whitener::new(&layout, &noises);
        let a = DVector::from_fn(10, |i, _| libm::sin(crate::count(i)));
        let b = DVector::from_fn(10, |i, _| libm::cos(crate::count(i * i)));
        let (white_a, white_b) =
            (whitener.whiten_only(a.as_slice()), whitener.whiten_only(b.as_slice()));
        let semiseparable: f64 = white_a.iter().zip(&white_b).map(|(x, y)| x * y).sum();
        assert!((semiseparable - a.dot(&(&inverse * &b))).abs() < 1e-10);
        let weighted = whitener.unwhiten(&white_a);
        let product: f64 = weighted.iter().zip(b.iter()).map(|(x, y)| x * y).sum();
        assert!((product - semiseparable).abs() < 1e-10);
    }

    #[test]
    fn determinant_equals_the_dense_one_with_the_offsets() {
        let (layout, noises) = uneven();
        let matrix = dense(&layout, &noises);
        let inverse = matrix.clone().try_inverse().unwrap();
        let mut expected = libm::log(matrix.determinant());
        for block in &layout.blocks {
            let ones = DVector::from_fn(10, |i, _| f64::from(u8::from(block.rows.contains(&i))));
            expected += libm::log(ones.dot(&(&inverse * &ones)));
        }
        assert!((Whitener::new(&layout, &noises).log_determinant() - expected).abs() < 1e-10);
    }

    #[test]
    fn one_sweep_gives_what_the_stored_factor_gives() {
        let (layout, noises) = uneven();
        let (layout, rows) = layout.restricted(|block| block.sensor == 0);
        let column: Vec<f64> = rows.iter().map(|&i| libm::sin(crate::count(7 * i))).collect();
        let whitener = Whitener::new(&layout, &noises);
        let white = whitener.whiten(&column);
        let square: f64 = white.iter().map(|value| value * value).sum();
        let swept = square_and_log_determinant(&layout, &noises[0], &column);
        assert!((swept.0 - square).abs() < 1e-10, "{swept:?} {square}");
        assert!((swept.1 - whitener.log_determinant()).abs() < 1e-10);
    }

    #[test]
    fn a_constant_in_a_pass_whitens_to_nothing() {
        let (layout, noises) = uneven();
        let mut column = vec![3.0; 10];
        column[6..].fill(-8.0);
        let white = Whitener::new(&layout, &noises).whiten(&column);
        assert!(white.iter().all(|value| value.abs() < 1e-12), "{white:?}");
    }
}
