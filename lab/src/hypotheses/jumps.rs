//! Jumps in a residual: changes from sample to sample that no slow noise makes.

use super::excursions::are_readings;
use super::tails::chance_beyond;
use crate::model::{Fit, Problem};
use crate::noise::Whitener;
use crate::numerics::{deviation, mean, median};
use crate::policy::chance::{
    FEWEST_JUMPS, JUMP_DEVIATIONS, JUMP_KEPT, JUMP_SIDE, SAMPLES_THAT_TELL,
};

/// Usual size of the jumps, µm (arcsec), and the chance of so many in noise.
///
/// Many jumps make the noise that is fitted to them, so they are held against what most samples
/// say. Outliers are weighed down already, and they come back with the next sample; a jump stays.
/// `None` when there are fewer than two, which a slip or a knock explains.
#[must_use]
pub(crate) fn jumps(problem: &Problem, fit: &Fit) -> Option<(f64, f64)> {
    let white = Whitener::new(&problem.layout, &fit.noises).whiten(fit.left.clone());
    let mut sizes = Vec::new();
    let mut innovations = Vec::new();
    for block in &problem.layout.blocks {
        let rows = block.rows.clone();
        let usual = usual(problem, fit, (block.sensor, &white[rows.clone()]));
        innovations.extend(white[rows.clone()].iter().map(|value| value / usual));
        let left = &fit.left[rows.clone()];
        let far = rows.clone().skip(1).filter(|&row| JUMP_DEVIATIONS * usual < white[row].abs());
        sizes.extend(far.filter_map(|row| stays(left, row - rows.start)));
    }
    if sizes.len() < FEWEST_JUMPS {
        return None;
    }
    let p_value = chance_beyond(&innovations, JUMP_DEVIATIONS, sizes.len());
    Some((median(&mut sizes), p_value))
}

/// What most whitened samples of a pass are, against what its noise says, if they are readings of their
/// own; no finer than its sensor.
fn usual(problem: &Problem, fit: &Fit, (sensor, white): (usize, &[f64])) -> f64 {
    let least = (problem.least_variance[sensor] / fit.noises[sensor].white).sqrt();
    if white.len() < SAMPLES_THAT_TELL || !are_readings(white, least) {
        return 1.0;
    }
    let mut sizes: Vec<f64> = white.iter().map(|value| value.abs()).collect();
    deviation(&mut sizes).clamp(least.min(1.0), 1.0)
}

/// Size of the change before a row, if the level stays.
fn stays(left: &[f64], row: usize) -> Option<f64> {
    let change = left[row] - left[row - 1];
    let before = mean(&left[row.saturating_sub(JUMP_SIDE)..row]);
    let behind = mean(&left[row..left.len().min(row + JUMP_SIDE)]);
    (JUMP_KEPT < (behind - before) / change).then_some(change.abs())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::count;
    use crate::policy::chance::SIGNIFICANCE;
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal, StudentT};

    /// Samples beyond the limit, and their chance.
    fn judged(values: &[f64]) -> Option<f64> {
        let jumps = values.iter().filter(|value| JUMP_DEVIATIONS < value.abs()).count();
        (FEWEST_JUMPS <= jumps).then(|| chance_beyond(values, JUMP_DEVIATIONS, jumps))
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
                judged(&white).is_some_and(|chance| chance < SIGNIFICANCE)
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
            assert!(chance < SIGNIFICANCE / 12.0, "{chance}");
        }
    }
}
