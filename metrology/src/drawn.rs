//! Drawn errors, their standard deviation one.

use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// Normal.
pub(crate) fn normal(chance: &mut ChaCha8Rng) -> f64 {
    StandardNormal.sample(chance)
}

/// With heavy tails: Student's t for three degrees of freedom, whose variance is three.
pub(crate) fn heavy_tailed(chance: &mut ChaCha8Rng) -> f64 {
    let square: f64 = (0..3).map(|_| normal(chance).powi(2)).sum();
    normal(chance) / square.sqrt()
}
