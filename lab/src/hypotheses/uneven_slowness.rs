//! Noise that is slow in some passes and not in others: a knock, a draught, a hand on the bed.
//!
//! One noise is fitted to all passes, which gives each of them its part of what moved in one. Here every pass,
//! or stretch of it, has a slow part of a size of its own against its own white one, all of one length; the
//! likelihood of that is held against that of one ratio for all, by its law and by noise drawn from the fit.
//! Likelihoods are Whittle's, of the periodogram of each stretch (1953, *Estimation and information in stationary
//! time series*, Arkiv för Matematik 2:423), means of neighbouring frequencies farther up.

use helixlock_fourier::{Complex, forward};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::drawn::{OwnNoise, clearest, surest_share};
use super::excursions::are_readings;
use crate::model::{Fit, Problem};
use crate::noise::without_outliers;
use crate::numerics::least_squares::dot;
use crate::numerics::{by_factors, chi_squared_tail, count, mean, median};
use crate::policy::extent::{FEWEST_ROWS_OF_A_STRETCH, STRETCHES_OF_A_PASS};
use crate::policy::reading::FAR_OUT;

/// Variances of a slow part against the white one that are tried, by factors of one and a half: less is none, more
/// hides the white part.
const RATIOS: [f64; 2] = [3e-3, 3e2];

/// What it forgets a row: as long as a stretch of two hundred rows, to hardly longer than a row.
const FORGETS: [f64; 2] = [5e-3, 0.7];

/// Root mean square of what is slow in some stretches alone, µm (arcsec), and the chance of as much in noise; `None`
/// where there are no two stretches, or the file says how sure each reading is.
#[must_use]
pub(super) fn uneven_slowness(problem: &Problem, fit: &Fit) -> Option<(f64, f64)> {
    surest_share(problem, fit, |sensor| of_sensor(problem, fit, sensor))
}

/// Share of the square that stretches have beyond the usual one, and the chance of one sensor.
fn of_sensor(problem: &Problem, fit: &Fit, sensor: usize) -> Option<(f64, f64)> {
    let (own, rows) = OwnNoise::of(problem, fit, sensor);
    let finest = problem.least_variance[sensor].sqrt();
    let cut = |values: &[f64], parts: usize| -> Vec<Spectrum> {
        let read = own.passes(values).filter(|pass| are_readings(pass, finest));
        let stretches = read.flat_map(|pass| {
            pass.chunks(pass.len().div_ceil(parts).max(1)).map(Spectrum::of).collect::<Vec<_>>()
        });
        stretches.flatten().collect()
    };
    let figures = |values: &[f64]| -> Vec<f64> {
        STRETCHES_OF_A_PASS.iter().map(|parts| against_one_ratio(&cut(values, *parts))).collect()
    };
    let values = &fit.left[rows];
    let found = figures(values);
    let drawn = |seed| figures(&own.drawn(&mut ChaCha8Rng::seed_from_u64(seed)));
    let (place, chance) = clearest(&found, drawn)?;
    let stretches = cut(values, STRETCHES_OF_A_PASS[place]);
    let freedom = count(stretches.len().saturating_sub(1));
    let by_law = count(found.len()) * chi_squared_tail(found[place], freedom);
    Some((beyond_the_usual(&stretches), chance.max(by_law.min(1.0))))
}

/// Share of the square that is beyond what a usual stretch has.
fn beyond_the_usual(stretches: &[Spectrum]) -> f64 {
    let mut squares: Vec<f64> = stretches.iter().map(|one| one.square).collect();
    let all = mean(&squares);
    1.0 - (median(&mut squares) / all.max(f64::MIN_POSITIVE)).min(1.0)
}

/// Twice the gain in log likelihood by a ratio of slow to white of its own for each stretch.
fn against_one_ratio(stretches: &[Spectrum]) -> f64 {
    if stretches.len() < 2 {
        return 0.0;
    }
    let [least, most] = RATIOS;
    let ratios: Vec<f64> = std::iter::once(0.0).chain(by_factors(least, most, 24)).collect();
    let (mut one_for_all, mut each_its_own) = (f64::INFINITY, f64::INFINITY);
    let [slowest, swiftest] = FORGETS;
    for forgets in by_factors(slowest, swiftest, 10) {
        let mut sums = vec![0.0; ratios.len()];
        let mut best = 0.0;
        for stretch in stretches {
            let losses: Vec<f64> =
                ratios.iter().map(|ratio| stretch.loss(forgets, *ratio)).collect();
            sums.iter_mut().zip(&losses).for_each(|(sum, loss)| *sum += loss);
            best += losses.into_iter().fold(f64::INFINITY, f64::min);
        }
        one_for_all = sums.into_iter().fold(one_for_all, f64::min);
        each_its_own = each_its_own.min(best);
    }
    2.0 * (one_for_all - each_its_own)
}

/// A band of frequencies is wider by one in so many before it: over less than a sixth no slow part changes.
const WIDENS: usize = 6;

/// The periodogram of a stretch about its mean, in bands.
struct Spectrum {
    /// Per band: frequencies in it, mean power, `2 − 2·cos` of its middle.
    numbers: Vec<f64>,
    powers: Vec<f64>,
    swiftness: Vec<f64>,
    /// Mean square of its values.
    square: f64,
}

impl Spectrum {
    /// None of a stretch too short to tell.
    fn of(values: &[f64]) -> Option<Self> {
        if values.len() < FEWEST_ROWS_OF_A_STRETCH {
            return None;
        }
        let kept = without_outliers(values, FAR_OUT);
        let middle = mean(&kept);
        let mut cells: Vec<Complex<f64>> =
            kept.iter().map(|value| Complex::new(value - middle, 0.0)).collect();
        forward(&mut cells);
        let rows = count(kept.len());
        let powers: Vec<f64> =
            cells[1..kept.len().div_ceil(2)].iter().map(|cell| cell.norm_sqr() / rows).collect();
        let mut spectrum =
            Self { numbers: Vec::new(), powers: Vec::new(), swiftness: Vec::new(), square: 0.0 };
        spectrum.square = 2.0 * powers.iter().sum::<f64>() / rows;
        let mut from = 0;
        while from < powers.len() {
            let to = (from + 1 + from / WIDENS).min(powers.len());
            let middle = 0.5 * count(from + to + 1) / rows;
            spectrum.numbers.push(count(to - from));
            spectrum.powers.push(mean(&powers[from..to]));
            spectrum.swiftness.push(2.0 - 2.0 * libm::cos(std::f64::consts::TAU * middle));
            from = to;
        }
        Some(spectrum)
    }

    /// Minus the log likelihood of white noise of any size and a slow part that forgets so much a row, its variance
    /// in that ratio to the white one's.
    fn loss(&self, forgets: f64, ratio: f64) -> f64 {
        let kept = 1.0 - forgets;
        let slow = ratio * (1.0 - kept * kept);
        let shape =
            self.swiftness.iter().map(|swift| 1.0 + slow / (forgets * forgets + kept * swift));
        let shape: Vec<f64> = shape.collect();
        let whitened = self.powers.iter().zip(&shape).map(|(power, shape)| power / shape);
        let whitened: Vec<f64> = whitened.collect();
        let logs: Vec<f64> = shape.iter().map(|shape| libm::log(*shape)).collect();
        let all: f64 = self.numbers.iter().sum();
        let scale = (dot(&self.numbers, &whitened) / all).max(f64::MIN_POSITIVE);
        all * libm::log(scale) + dot(&self.numbers, &logs)
    }
}

#[cfg(test)]
mod tests {
    use super::super::made_noise::{normal, slow};
    use super::*;

    /// Rows of a pass.
    const ROWS: usize = 240;

    /// The gain of three passes, and its chance by the law.
    fn chance_of(passes: &[Vec<f64>]) -> f64 {
        let spectra: Vec<Spectrum> = passes.iter().filter_map(|pass| Spectrum::of(pass)).collect();
        chi_squared_tail(against_one_ratio(&spectra), count(spectra.len() - 1))
    }

    #[test]
    fn passes_of_one_noise_are_alike_however_loud() {
        for seed in 0..100 {
            let mut random = ChaCha8Rng::seed_from_u64(seed);
            let mut slow = slow();
            let passes = [1.0, 3.0, 0.2].map(|loud| {
                (0..ROWS).map(|row| loud * slow(&mut random, row)).collect::<Vec<f64>>()
            });
            assert!(1e-4 < chance_of(&passes), "{seed}: {}", chance_of(&passes));
        }
    }

    #[test]
    fn a_pass_that_wanders_among_others_that_do_not_is_told() {
        for seed in 0..10 {
            let mut random = ChaCha8Rng::seed_from_u64(seed);
            let mut wandered = 0.0;
            let passes = [0.0, 0.6, 0.0].map(|step| {
                let mut value = || {
                    wandered = 0.95 * wandered + step * normal(&mut random);
                    wandered + normal(&mut random)
                };
                std::iter::repeat_with(&mut value).take(ROWS).collect::<Vec<f64>>()
            });
            assert!(chance_of(&passes) < 1e-5, "{seed}: {}", chance_of(&passes));
        }
    }
}
