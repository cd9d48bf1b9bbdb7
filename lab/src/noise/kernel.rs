//! Correlated noise of a recorder: white plus slow parts, at O(n) a column and for any sampling.
//!
//! The covariance of two samples of one block is
//!
//! ```text
//! K(i, j) = w²·[i = j] + Σ a_k²·exp(−|u_i − u_j| / τ_k)
//! ```
//!
//! with `u` in sample intervals. One slow part is AR(1) when sampling is even; two cover what
//! lies between white, 1/f and a random walk. Slow parts are Markov processes, so a Kalman filter
//! works out the Cholesky factor and whitens at a handful of multiplications a sample (Kalman
//! 1960; for the factor as such Foreman-Mackey et al. 2017, *Fast and scalable Gaussian process
//! modeling*, AJ 154:220).

/// Most slow parts a noise model has.
pub(crate) const PARTS: usize = 2;

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
    /// Slow parts, at most two.
    pub slow: Vec<SlowPart>,
}

impl Noise {
    /// Independent samples of variance 1.
    #[must_use]
    pub(crate) fn white() -> Self {
        Self { white: 1.0, slow: Vec::new() }
    }

    /// Variance of one sample.
    #[must_use]
    pub(crate) fn variance(&self) -> f64 {
        self.white + self.slow.iter().map(|part| part.variance).sum::<f64>()
    }

    /// True when no number differs from another noise's by a twentieth: nothing that is tried
    /// under the one comes out otherwise under the other.
    #[must_use]
    pub(crate) fn is_like(&self, other: &Self) -> bool {
        let like = |a: f64, b: f64| (a - b).abs() <= 0.05 * a.abs().max(b.abs());
        let parts = self.slow.iter().zip(&other.slow);
        self.slow.len() == other.slow.len()
            && like(self.white, other.white)
            && parts
                .into_iter()
                .all(|(a, b)| like(a.variance, b.variance) && like(a.length, b.length))
    }

    /// The same shape with all variances multiplied.
    #[must_use]
    pub(crate) fn scaled(&self, factor: f64) -> Self {
        let slow =
            self.slow.iter().map(|part| SlowPart { variance: part.variance * factor, ..*part });
        Self { white: self.white * factor, slow: slow.collect() }
    }
}
