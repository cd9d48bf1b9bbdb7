//! How far figures of a residual stand out of those of noise drawn from its fit.

use rayon::prelude::*;
use statrs::distribution::{ContinuousCDF, Gamma};

use crate::numerics::count;
use crate::policy::chance::{DRAWS, MOST_DRAWS, WORTH_DRAWING};

/// Which figure stands out most, and the chance that any does so in noise, of which `drawn` gives the
/// figures by its seed; `None` without any figure.
pub(super) fn clearest(
    found: &[f64],
    drawn: impl Fn(u64) -> Vec<f64> + Sync,
) -> Option<(usize, f64)> {
    let mut all: Vec<Vec<f64>> = Vec::new();
    for most in [DRAWS, MOST_DRAWS] {
        let seeds = (all.len() as u64..most).into_par_iter();
        all.par_extend(seeds.map(&drawn));
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
