//! How much a set of columns explains of pure noise, found by trying it.
//!
//! A likelihood ratio with the noise fitted on both sides follows χ² only when the columns are few
//! against the correlation lengths of the record. Many smooth columns also follow slow noise, and
//! what they leave looks whiter than it was. Noise drawn from the fitted model says by how much.

use helixlock_plant::Column;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use rayon::prelude::*;

use crate::model::{Columns, Fit, Problem, noises_of, settle};
use crate::noise::{Layout, Noise};
use crate::numerics::{chi_squared_tail, count};
use crate::policy::chance::{BEYOND_DOUBT, DRAWS};

/// Chance of a gain of some free columns in noise like that of a fit.
///
/// The gains of the draws are matched by `c·χ²(k)` with their mean and variance (Satterthwaite
/// 1946), never more favourable than χ² with one degree a column.
#[must_use]
pub(crate) fn chance(
    problem: &Problem,
    model: &Columns,
    fit: &Fit,
    raw: &[Column],
    gain: f64,
) -> f64 {
    let width = count(raw.len());
    let plain = chi_squared_tail(gain, width);
    if BEYOND_DOUBT * width < gain {
        return plain;
    }
    let gains: Vec<f64> =
        (0..DRAWS).into_par_iter().map(|seed| drawn_gain(problem, model, fit, raw, seed)).collect();
    let mean = gains.iter().sum::<f64>() / count(gains.len());
    let variance = gains.iter().map(|g| (g - mean) * (g - mean)).sum::<f64>()
        / count(gains.len().saturating_sub(1).max(1));
    if mean <= width || variance <= 0.0 {
        return plain;
    }
    let scale = (0.5 * variance / mean).max(1.0);
    chi_squared_tail(gain / scale, mean / scale).max(plain)
}

/// Gain of the columns on noise drawn from a fit.
fn drawn_gain(problem: &Problem, model: &Columns, fit: &Fit, raw: &[Column], seed: u64) -> f64 {
    let mut chance = ChaCha8Rng::seed_from_u64(seed);
    let mut noisy = problem.clone();
    let drawn = draw(&problem.layout, &fit.noises, &mut chance);
    noisy.observed =
        problem.predicted.iter().zip(drawn).map(|(said, drawn)| said + drawn).collect();
    let model = Columns { fixed: None, ..model.clone() };
    let start = noises_of(&noisy, &noisy.residual());
    let plain = settle(&noisy, &model, &start);
    let wide = settle(&noisy, &model.and(&Columns::free(raw.to_vec())), &plain.noises);
    2.0 * (wide.log_likelihood - plain.log_likelihood)
}

/// Noise of each block, sample after sample: the slow parts forget exponentially.
fn draw(layout: &Layout, noises: &[Noise], chance: &mut ChaCha8Rng) -> Vec<f64> {
    let mut normal = || -> f64 { StandardNormal.sample(chance) };
    let mut all = vec![0.0; layout.len()];
    for block in &layout.blocks {
        let noise = &noises[block.sensor];
        let mut slow: Vec<f64> =
            noise.slow.iter().map(|part| part.variance.sqrt() * normal()).collect();
        for row in block.rows.clone() {
            if block.rows.start < row {
                let interval = (layout.clock[row] - layout.clock[row - 1]).max(0.0);
                for (value, part) in slow.iter_mut().zip(&noise.slow) {
                    let kept = libm::exp(-interval / part.length);
                    let fresh = (part.variance * (1.0 - kept * kept)).max(0.0).sqrt();
                    *value = kept * *value + fresh * normal();
                }
            }
            let white = (noise.white * layout.inflation[row]).sqrt() * normal();
            all[row] = slow.iter().sum::<f64>() + white;
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::noise::{Block, SlowPart};

    #[test]
    fn drawn_noise_has_the_variance_and_the_memory_of_its_model() {
        let rows = 20_000;
        let layout = Layout {
            blocks: vec![Block { sensor: 0, pass: 0, rows: 0..rows }],
            clock: (0..rows).map(count).collect(),
            inflation: vec![1.0; rows].into(),
        };
        let noise = Noise { white: 0.5, slow: vec![SlowPart { variance: 2.0, length: 4.0 }] };
        let drawn = draw(&layout, &[noise], &mut ChaCha8Rng::seed_from_u64(3));
        let product = |lag: usize| {
            drawn[lag..].iter().zip(&drawn).map(|(a, b)| a * b).sum::<f64>() / count(rows - lag)
        };
        // K(0) = 2.5, K(4) = 2·exp(−1); standard errors by Bartlett are about 0.06.
        assert!((product(0) - 2.5).abs() < 0.25, "{}", product(0));
        assert!((product(4) - 2.0 * libm::exp(-1.0)).abs() < 0.25, "{}", product(4));
    }
}
