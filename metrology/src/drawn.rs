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

/// So many records where a test draws them; with `HELIXLOCK_SEEDS=all` as many as its bounds were made for.
#[cfg(test)]
pub(crate) fn records(few: u32, all: u32) -> u32 {
    let every_one = std::env::var("HELIXLOCK_SEEDS").is_ok_and(|which| which == "all");
    if every_one { all } else { few }
}
