//! Noise of known laws, row by row, for tests.

use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// One deviation of white noise.
pub(super) fn normal(random: &mut ChaCha8Rng) -> f64 {
    StandardNormal.sample(random)
}

/// Noise that forgets over twenty rows, and as much white noise.
pub(super) fn slow() -> impl FnMut(&mut ChaCha8Rng, usize) -> f64 {
    let mut last = 0.0;
    move |random, _| {
        last = 0.95 * last + 0.3 * normal(random);
        last + normal(random)
    }
}

/// Noise that forgets over two, ten and a hundred rows.
pub(super) fn of_many_lengths() -> impl FnMut(&mut ChaCha8Rng, usize) -> f64 {
    let mut last = [0.0; 3];
    move |random, _| {
        for (value, kept) in last.iter_mut().zip([0.5, 0.9, 0.99]) {
            *value = kept * *value + (1.0_f64 - kept * kept).sqrt() * normal(random);
        }
        last.iter().sum()
    }
}

/// White noise, each reading held for four rows.
pub(super) fn held() -> impl FnMut(&mut ChaCha8Rng, usize) -> f64 {
    let mut last = 0.0;
    move |random, row| {
        last = if row % 4 == 0 { normal(random) } else { last };
        last
    }
}
