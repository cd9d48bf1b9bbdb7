//! How much a set of columns explains of pure noise, found by trying it.
//!
//! A likelihood ratio with the noise fitted on both sides follows χ² only when the columns are few
//! against the correlation lengths of the record. Many smooth columns also follow slow noise, and
//! what they leave looks whiter than it was. Noise drawn from the fitted model says by how much.

use helixlock_plant::Column;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::model::{Columns, Fit, Problem, settle};
use crate::noise::{Layout, Noise};
use crate::numerics::{chi_squared_tail, count, in_parallel};
use crate::policy::chance::{BEYOND_DOUBT, DRAWS, MOST_DRAWS, NARROW, STANDARD_ERRORS, TAIL};

/// Chance of a gain of some free columns in noise like that of a fit, drawn for until it is clear on
/// which side of a limit it lies.
///
/// Never more favourable than χ² with one degree a column.
#[must_use]
pub(crate) fn chance(
    problem: &Problem,
    (model, fit): (&Columns, &Fit),
    raw: &[Column],
    gain: f64,
    limit: f64,
) -> f64 {
    let width = count(raw.len());
    let plain = chi_squared_tail(gain, width);
    if limit <= plain || BEYOND_DOUBT * width < gain {
        return plain;
    }
    let mut gains: Vec<f64> = Vec::new();
    loop {
        let drawn = gains.len() as u64;
        let of_seed = |seed| drawn_gain(problem, model, fit, raw, seed);
        gains.extend(in_parallel(drawn..drawn + DRAWS, of_seed));
        let law = Law::of(&gains, width);
        let ends = [1.0 / law.within, law.within].map(|by| law.chance(by * gain) < limit);
        if ends[0] == ends[1] {
            return law.chance(gain).max(plain);
        }
        if MOST_DRAWS <= drawn + DRAWS {
            let narrow = raw.len() <= NARROW;
            let chance = if narrow { chance_by_tail(&mut gains, gain) } else { law.chance(gain) };
            return chance.max(plain);
        }
    }
}

/// The law `c·χ²(k)` that has the mean and the variance of some gains (Satterthwaite 1946).
struct Law {
    scale: f64,
    freedom: f64,
    /// Factor by which the mean may be off.
    within: f64,
}

impl Law {
    /// That of drawn gains, which for columns of some width is at least χ².
    fn of(gains: &[f64], width: f64) -> Self {
        let number = count(gains.len());
        let mean = gains.iter().sum::<f64>() / number;
        let squares = gains.iter().map(|gain| (gain - mean) * (gain - mean));
        let variance = squares.sum::<f64>() / (number - 1.0).max(1.0);
        let error = (variance / number).sqrt() / mean.max(f64::MIN_POSITIVE);
        let within = 1.0 + STANDARD_ERRORS * error;
        if mean <= width || variance <= 0.0 {
            return Self { scale: 1.0, freedom: width, within };
        }
        let scale = (0.5 * variance / mean).max(1.0);
        Self { scale, freedom: mean / scale, within }
    }

    fn chance(&self, gain: f64) -> f64 {
        chi_squared_tail(gain / self.scale, self.freedom)
    }
}

/// Chance of a gain by the largest twentieth of drawn ones, beyond which twice a likelihood ratio falls as the
/// exponential of its half: by Markov's inequality no ratio K of likelihoods is beaten more often than in one of K.
///
/// The scaled χ² that has the variance of so many goes by the one largest of them.
fn chance_by_tail(gains: &mut [f64], gain: f64) -> f64 {
    gains.sort_by(f64::total_cmp);
    let tail = (gains.len() / TAIL).max(1);
    let from = gains[gains.len() - tail];
    let share = count(tail) / count(gains.len());
    if gain <= from {
        return count(gains.iter().filter(|one| gain <= **one).count()) / count(gains.len());
    }
    share * libm::exp(-0.5 * (gain - from))
}

/// Gain of the columns on noise drawn from a fit, whose noise keeps the parts that it was found to
/// have: with fewer, the columns would be given what a part has lost.
fn drawn_gain(problem: &Problem, model: &Columns, fit: &Fit, raw: &[Column], seed: u64) -> f64 {
    let mut chance = ChaCha8Rng::seed_from_u64(seed);
    let mut noisy = problem.clone();
    let drawn = draw(&problem.layout, &fit.noises, &mut chance);
    noisy.observed =
        problem.predicted.iter().zip(drawn).map(|(said, drawn)| said + drawn).collect();
    let model = Columns { fixed: None, ..model.clone() };
    let plain = settle(&noisy, &model, &fit.noises);
    let wide = settle(&noisy, &model.and(&Columns::free(raw.to_vec())), &plain.noises);
    2.0 * (wide.log_likelihood - plain.log_likelihood)
}

/// Noise of each block, sample after sample: the slow parts forget exponentially.
pub(super) fn draw(layout: &Layout, noises: &[Noise], chance: &mut ChaCha8Rng) -> Vec<f64> {
    let mut normal = || -> f64 { StandardNormal.sample(chance) };
    let mut all = vec![0.0; layout.len()];
    for block in &layout.blocks {
        let noise = noises[block.sensor].scaled(block.variance());
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
    use statrs::distribution::{ChiSquared, ContinuousCDF};

    use super::*;
    use crate::noise::{Block, SlowPart};

    #[test]
    fn drawn_noise_has_the_variance_and_the_memory_of_its_model() {
        let rows = 20_000;
        let layout = Layout {
            blocks: vec![Block { sensor: 0, pass: 0, rows: 0..rows, loudness: 0 }],
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

    /// Quantiles of χ² with one degree, and one draw that stands out: beyond the others' tail a gain of 16 is as rare
    /// as e⁻⁶ of a twentieth, which the variance of all hides.
    #[test]
    fn one_draw_that_stands_out_makes_no_chance() {
        let quantile = |of: u32| {
            let share = (f64::from(of) + 0.5) / 256.0;
            ChiSquared::new(1.0).map_or(0.0, |law| law.inverse_cdf(share))
        };
        let mut gains: Vec<f64> = (0..255).map(quantile).chain([60.0]).collect();
        assert!(2e-3 < Law::of(&gains, 1.0).chance(16.0));
        let by_tail = chance_by_tail(&mut gains, 16.0);
        assert!((1e-4..2e-4).contains(&by_tail), "{by_tail}");
    }
}
