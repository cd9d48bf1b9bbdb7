//! How far figures of a residual stand out of those of noise drawn from its fit.

use std::ops::Range;

use rand_chacha::ChaCha8Rng;
use statrs::distribution::{ContinuousCDF, Gamma};

use super::calibration::draw;
use crate::model::{Fit, Problem};
use crate::noise::{Layout, Noise, weighed_rms};
use crate::numerics::{count, in_parallel};
use crate::policy::chance::{DRAWS, MOST_DRAWS, WORTH_DRAWING};

/// Rows of one sensor, all of one weight, and the noise that was fitted to them.
pub(super) struct OwnNoise<'a> {
    pub(super) layout: Layout,
    pub(super) noise: &'a Noise,
}

impl<'a> OwnNoise<'a> {
    /// That of a sensor, and the rows it has in the fit.
    pub(super) fn of(problem: &Problem, fit: &'a Fit, sensor: usize) -> (Self, Range<usize>) {
        let (mut layout, rows) = problem.layout.of_sensor(sensor);
        layout.inflation = vec![1.0; layout.len()].into();
        (Self { layout, noise: &fit.noises[sensor] }, rows)
    }

    /// The part of some values that each pass has.
    pub(super) fn passes<'v>(&self, values: &'v [f64]) -> impl Iterator<Item = &'v [f64]> {
        self.layout.blocks.iter().map(|block| &values[block.rows.clone()])
    }

    /// Another draw of it.
    pub(super) fn drawn(&self, random: &mut ChaCha8Rng) -> Vec<f64> {
        draw(&self.layout, std::slice::from_ref(self.noise), random)
    }
}

/// The surest of some findings with its chance, for which each of them was a look.
pub(super) fn surest<T: Copy>(found: &[(T, f64)]) -> Option<(T, f64)> {
    let (one, chance) = found.iter().copied().min_by(|a, b| a.1.total_cmp(&b.1))?;
    Some((one, (count(found.len()) * chance).min(1.0)))
}

/// Root mean square, µm (arcsec), of the surest share of the square that a sensor shows, wild readings weighing
/// little, and its chance; `None` where the file says how sure each reading is, so that neighbours need not be alike.
pub(super) fn surest_share(
    problem: &Problem,
    fit: &Fit,
    of_sensor: impl Fn(usize) -> Option<(f64, f64)>,
) -> Option<(f64, f64)> {
    surest_share_of(problem, weighed_rms(&problem.layout, &fit.left), of_sensor)
}

/// The same of another root mean square.
pub(super) fn surest_share_of(
    problem: &Problem,
    rms_um: f64,
    of_sensor: impl Fn(usize) -> Option<(f64, f64)>,
) -> Option<(f64, f64)> {
    if problem.measurement.deviations.is_some() {
        return None;
    }
    let found: Vec<(f64, f64)> = (0..problem.sensors.len()).filter_map(of_sensor).collect();
    let (share, chance) = surest(&found)?;
    Some((rms_um * share.max(0.0).sqrt(), chance))
}

/// Which figure stands out most, and the chance that any does so in noise, of which `drawn` gives the
/// figures by its seed; `None` without any figure.
pub(super) fn clearest(
    found: &[f64],
    drawn: impl Fn(u64) -> Vec<f64> + Sync,
) -> Option<(usize, f64)> {
    let mut all: Vec<Vec<f64>> = Vec::new();
    for most in [DRAWS, MOST_DRAWS] {
        all.extend(in_parallel(all.len() as u64..most, &drawn));
        let laws: Vec<Law> = (0..found.len()).map(|place| Law::of(&all, place)).collect();
        let beyond = laws.iter().zip(found).map(|(law, one)| law.deviations(*one));
        let furthest = beyond.fold(f64::NEG_INFINITY, f64::max);
        if furthest < *WORTH_DRAWING.start() {
            break;
        }
        if *WORTH_DRAWING.end() < furthest || most == MOST_DRAWS {
            let chances = laws.iter().zip(found).map(|(law, one)| law.chance(*one)).enumerate();
            let (place, chance) = chances.min_by(|a, b| a.1.total_cmp(&b.1))?;
            return Some((place, (count(found.len()) * chance).min(1.0)));
        }
    }
    (!found.is_empty()).then_some((0, 1.0))
}

/// The law of Pearson's third type that has the mean, variance and skewness of what was drawn: of a
/// skewed figure the tail would be too short thirtyfold by a normal law.
struct Law {
    mean: f64,
    deviation: f64,
    skewness: f64,
}

/// Least skewness of it; below, it is the normal law.
const LEAST_SKEWNESS: f64 = 0.1;

impl Law {
    fn of(drawn: &[Vec<f64>], place: usize) -> Self {
        let number = count(drawn.len());
        let mean_of =
            |of: &dyn Fn(f64) -> f64| drawn.iter().map(|one| of(one[place])).sum::<f64>() / number;
        let mean = mean_of(&|figure| figure);
        let deviation = mean_of(&|figure| (figure - mean).powi(2)).sqrt().max(f64::MIN_POSITIVE);
        let skewness = mean_of(&|figure| ((figure - mean) / deviation).powi(3)).max(LEAST_SKEWNESS);
        Self { mean, deviation, skewness }
    }

    /// Standard deviations above the mean.
    fn deviations(&self, value: f64) -> f64 {
        (value - self.mean) / self.deviation
    }

    /// Chance of as much or more.
    fn chance(&self, value: f64) -> f64 {
        let shape = 4.0 / (self.skewness * self.skewness);
        let place = (shape + self.deviations(value) * shape.sqrt()).max(0.0);
        Gamma::new(shape, 1.0).map_or(1.0, |law| law.sf(place))
    }
}
