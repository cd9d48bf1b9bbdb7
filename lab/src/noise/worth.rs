//! What correlated samples are worth.

use super::{Layout, Noise, Whitener};
use crate::numerics::least_squares::dot;

/// Variance of a sample over the variance of the best mean: `σ²·1ᵀK⁻¹1`.
///
/// A pass that lasts `T` under noise of correlation length `τ` alone is worth `1 + T/2τ` samples.
#[must_use]
pub(crate) fn effective_samples(layout: &Layout, noise: &Noise) -> f64 {
    let whitener = Whitener::new(layout, std::slice::from_ref(noise));
    let ones = whitener.whiten_only(vec![1.0; layout.len()]);
    noise.variance() * dot(&ones, &ones)
}
