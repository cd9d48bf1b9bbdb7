//! Jumps in a residual: changes from sample to sample that no slow noise makes.

use statrs::distribution::{Continuous, ContinuousCDF, DiscreteCDF, Poisson, StudentsT};

use crate::count;
use crate::fit::Fit;
use crate::noise::Whitener;
use crate::noise_fit::median;
use crate::problem::Problem;

/// A whitened sample beyond this many deviations is a jump.
const DEVIATIONS: f64 = 5.0;

/// Degrees of freedom of the tails that noise may have; the last are nearly Gaussian.
const TAILS: [f64; 8] = [2.5, 3.0, 4.0, 5.0, 7.0, 10.0, 20.0, 200.0];

/// Widths of the bulk that are tried, against unit deviation.
const WIDTHS: [f64; 9] = [0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.1, 1.2];

/// Usual size of the jumps, µm (arcsec), and the chance of so many in noise.
///
/// Outliers are weighed down already, and they come back with the next sample; a jump stays.
/// `None` when there are fewer than two, which a slip or a knock explains.
#[must_use]
pub fn jumps(problem: &Problem, fit: &Fit) -> Option<(f64, f64)> {
    let white = Whitener::new(&problem.layout, &fit.noises).whiten(&fit.left);
    let mut sizes = Vec::new();
    for block in &problem.layout.blocks {
        for row in block.rows.clone().skip(1) {
            if DEVIATIONS < white[row].abs() {
                sizes.push((fit.left[row] - fit.left[row - 1]).abs());
            }
        }
    }
    if sizes.len() < 2 {
        return None;
    }
    let p_value = chance(&white, sizes.len());
    Some((median(&mut sizes), p_value))
}

/// Chance of so many samples beyond [`DEVIATIONS`], in noise with the tails of the others.
///
/// Noise may have tails by itself. The samples within are held against Student's law of every
/// tail and width, cut off there; each law says its own chance, and has the weight of its
/// likelihood.
fn chance(white: &[f64], jumps: usize) -> f64 {
    let bulk: Vec<f64> = white.iter().copied().filter(|z| z.abs() <= DEVIATIONS).collect();
    let beyond = u64::try_from(jumps).unwrap_or(u64::MAX) - 1;
    let laws = TAILS.iter().flat_map(|tail| WIDTHS.iter().map(|width| (*width, *tail)));
    let weighed: Vec<(f64, f64)> = laws
        .filter_map(|(width, tail)| {
            let law = StudentsT::new(0.0, width, tail).ok()?;
            let outside = 2.0 * law.sf(DEVIATIONS);
            let inside = libm::log1p(-outside);
            let likelihood: f64 = bulk.iter().map(|z| law.ln_pdf(*z) - inside).sum();
            let expected = (outside * count(white.len())).max(f64::MIN_POSITIVE);
            Some((likelihood, Poisson::new(expected).map_or(1.0, |law| law.sf(beyond))))
        })
        .collect();
    let best = weighed.iter().map(|(likelihood, _)| *likelihood).fold(f64::NEG_INFINITY, f64::max);
    let weight = |likelihood: f64| libm::exp(likelihood - best);
    let all: f64 = weighed.iter().map(|(likelihood, _)| weight(*likelihood)).sum();
    weighed.iter().map(|(likelihood, chance)| weight(*likelihood) * chance).sum::<f64>() / all
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal, StudentT};

    /// Samples beyond the limit, and their chance.
    fn judged(values: &[f64]) -> Option<f64> {
        let jumps = values.iter().filter(|value| DEVIATIONS < value.abs()).count();
        (1 < jumps).then(|| chance(values, jumps))
    }

    /// Heavy tails are no jumps: fewer than one in a hundred records of them is taken for some.
    #[test]
    fn tails_are_no_jumps() {
        for tail in [2.5, 3.0, 4.0, 6.0] {
            let law = StudentT::new(tail).unwrap();
            let found = (0..300).filter(|&seed| {
                let mut noise = ChaCha8Rng::seed_from_u64(seed);
                let values: Vec<f64> = (0..500).map(|_| law.sample(&mut noise)).collect();
                let square: f64 = values.iter().map(|value| value * value).sum();
                let scale = (square / count(values.len())).sqrt();
                let white: Vec<f64> = values.iter().map(|value| value / scale).collect();
                judged(&white).is_some_and(|chance| chance < crate::probes::SIGNIFICANCE)
            });
            assert!(found.count() <= 3, "{tail} degrees of freedom");
        }
    }

    /// Among 500 samples of Gaussian noise, twelve jumps are beyond doubt.
    #[test]
    fn jumps_in_gaussian_noise_are_found() {
        for seed in 0..20 {
            let mut noise = ChaCha8Rng::seed_from_u64(seed);
            let mut white: Vec<f64> = (0..500).map(|_| StandardNormal.sample(&mut noise)).collect();
            assert_eq!(judged(&white), None);
            for place in (0..12).map(|i| 20 + 40 * i) {
                white[place] = 6.5;
            }
            let chance = judged(&white).unwrap();
            assert!(chance < crate::probes::SIGNIFICANCE / 12.0, "{chance}");
        }
    }
}
