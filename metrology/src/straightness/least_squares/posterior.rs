//! Every smoothness and every number of waves, each weighed by how probable it makes the readings.

use super::super::separated::without_line;
use super::system::{Smooth, System};
use super::waves::{Prior, Search, Waves, fit};
use crate::number::{dot, number};

/// Most waves that are looked for.
const MOST_WAVES: usize = 5;
/// Mean squares of waves that are expected, in parts of that of the bar: every order of magnitude alike.
const WAVE_SIZES: [f64; 4] = [1.0, 0.1, 0.01, 0.001];
/// Above these the work grows beyond seconds: places, and places times those between the probes.
const MOST_PLACES: usize = 600;
const MOST_WORK: usize = 60_000;
/// Weights below this change nothing that is printed.
const LEAST_WEIGHT: f64 = 1e-4;

/// What is known of the bar.
pub(super) struct Posterior {
    /// The bar at every place touched, µm.
    pub(super) places_um: Vec<f64>,
    /// Covariance at the places of the first probe, the line removed, µm².
    pub(super) covariance_um2: Vec<Vec<f64>>,
}

/// True when the waves of the bar can be looked for in reasonable time.
pub(super) fn affordable(system: &System<'_>) -> bool {
    let places = system.places();
    places <= MOST_PLACES && places * system.before() <= MOST_WORK
}

/// The mean over all smoothness weights and numbers of waves, and what is left unknown: the mean of
/// their variances and the variance of their means.
pub(super) fn posterior(
    system: &System<'_>,
    noise_um2: f64,
    smoothness: &[f64],
) -> Option<Posterior> {
    let size_um2 = mean_square_um2(system, noise_um2, smoothness)?;
    let prior = Prior { noise_um2, size_um2 };
    // Small waves that the readings hardly show are found, and weigh, only where small ones are expected.
    let models: Vec<(Prior, Vec<f64>)> = WAVE_SIZES
        .iter()
        .map(|part| Prior { size_um2: size_um2 * part, ..prior })
        .flat_map(|prior| models(system, prior, smoothness).into_iter().map(move |m| (prior, m)))
        .collect();
    // Half decades are fine enough for a mean over all of them.
    let smoothness: Vec<f64> = smoothness.iter().copied().step_by(2).collect();
    let mut judged = Vec::new();
    for (level, smoothness) in smoothness.iter().enumerate() {
        let Some(smooth) = system.smooth(*smoothness) else { continue };
        for (model, (prior, waves)) in models.iter().enumerate() {
            let found = fit(system, &smooth, *prior, waves);
            judged.extend(found.map(|found| (found.misfit, level, model)));
        }
    }
    let least = judged.iter().map(|one| one.0).min_by(f64::total_cmp)?;
    let weight = |misfit: f64| libm::exp((least - misfit) / 2.0);
    let sum: f64 = judged.iter().map(|one| weight(one.0)).sum();
    let kept = judged.iter().map(|(misfit, level, model)| (weight(*misfit) / sum, *level, *model));
    let kept: Vec<_> = kept.filter(|(weight, ..)| LEAST_WEIGHT < *weight).collect();
    let mut mixture = Mixture::new(system, noise_um2);
    for (level, smoothness) in smoothness.iter().enumerate() {
        let models_here = || kept.iter().filter(|(_, at, _)| *at == level);
        if models_here().next().is_none() {
            continue;
        }
        let smooth = system.smooth(*smoothness)?;
        let of_smooth = covariance_of_smooth(system, &smooth, noise_um2);
        for (weight, _, model) in models_here() {
            let (prior, waves) = &models[*model];
            let waves = fit(system, &smooth, *prior, waves)?;
            mixture.add(*weight, &smooth, &waves, &of_smooth);
        }
    }
    Some(mixture.posterior())
}

/// Mean square of the smoothest bar alone, µm².
fn mean_square_um2(system: &System<'_>, noise_um2: f64, smoothness: &[f64]) -> Option<f64> {
    let fit = |smoothness: &f64| {
        let smooth = system.smooth(*smoothness)?;
        let squares_um2 = dot(&smooth.left(system, system.z_um), system.z_um);
        Some((squares_um2 / noise_um2 + smooth.cost, smooth.form(system, system.z_um)))
    };
    let fits = smoothness.iter().filter_map(fit).filter(|(misfit, _)| misfit.is_finite());
    let (_, form_um) = fits.min_by(|a, b| a.0.total_cmp(&b.0))?;
    let bar_um = without_line(form_um[system.before()..].to_vec());
    // A bar that is flat has waves no larger than the noise.
    Some((dot(&bar_um, &bar_um) / number(bar_um.len())).max(noise_um2))
}

/// No wave, the one that explains most, with the next one, and so on.
fn models(system: &System<'_>, prior: Prior, smoothness: &[f64]) -> Vec<Vec<f64>> {
    let search = Search::new(system, prior, smoothness.iter().copied().step_by(6));
    let mut models = vec![Vec::new()];
    while models.len() <= MOST_WAVES {
        let Some(more) = models.last().and_then(|waves| search.one_more(waves)) else { break };
        models.push(more);
    }
    models
}

/// Covariance of a smooth form at the places of the first probe, the line removed, µm².
fn covariance_of_smooth(system: &System<'_>, smooth: &Smooth, noise_um2: f64) -> Vec<Vec<f64>> {
    let (before, places) = (system.before(), system.places());
    let column = |place| without_line(smooth.column(system, place)[before..].to_vec());
    let columns: Vec<Vec<f64>> = (before..places).map(column).collect();
    // Rows of P·C; removing the line along the other side too gives P·C·P.
    let row = |sample: usize| {
        let row = without_line(columns.iter().map(|column| column[sample]).collect());
        row.iter().map(|value| value * noise_um2).collect()
    };
    (0..columns.len()).map(row).collect()
}

struct Mixture<'a> {
    system: &'a System<'a>,
    noise_um2: f64,
    weights: f64,
    places_um: Vec<f64>,
    /// Sums of the weighted squares about zero at the places of the first probe, µm².
    squares_um2: Vec<Vec<f64>>,
}

impl<'a> Mixture<'a> {
    fn new(system: &'a System<'a>, noise_um2: f64) -> Self {
        let samples = system.z_um.len();
        Self {
            system,
            noise_um2,
            weights: 0.0,
            places_um: vec![0.0; system.places()],
            squares_um2: vec![vec![0.0; samples]; samples],
        }
    }

    fn add(&mut self, weight: f64, smooth: &Smooth, waves: &Waves, of_smooth_um2: &[Vec<f64>]) {
        let (system, before, noise_um2) = (self.system, self.system.before(), self.noise_um2);
        let sum = |of: &[Vec<f64>], at: usize| {
            of.iter().zip(&waves.coefficients).map(|(column, c)| column[at] * c).sum::<f64>()
        };
        let left: Vec<f64> =
            system.z_um.iter().enumerate().map(|(at, z)| z - sum(&waves.seen, at)).collect();
        let form = smooth.form(system, &left);
        let places_um: Vec<f64> =
            form.iter().enumerate().map(|(at, form)| form + sum(&waves.columns, at)).collect();
        // What one unit of a coefficient changes of the bar, the smooth form giving way.
        let answers = waves.columns.iter().zip(&waves.seen).map(|(column, seen)| {
            let form = smooth.form(system, seen);
            without_line(column.iter().zip(form).skip(before).map(|(c, form)| c - form).collect())
        });
        let answers: Vec<Vec<f64>> = answers.collect();
        let row_of = |sample: usize| -> Vec<f64> { answers.iter().map(|a| a[sample]).collect() };
        let bar_um = without_line(places_um[before..].to_vec());
        for (sample, squares_um2) in self.squares_um2.iter_mut().enumerate() {
            let solved = waves.precision.solve(&row_of(sample));
            for (other, square_um2) in squares_um2.iter_mut().enumerate() {
                let of_waves = answers.iter().zip(&solved).map(|(a, s)| a[other] * s).sum::<f64>();
                let variance_um2 = of_smooth_um2[sample][other] + noise_um2 * of_waves;
                *square_um2 += weight * (variance_um2 + bar_um[sample] * bar_um[other]);
            }
        }
        for (mean, place) in self.places_um.iter_mut().zip(&places_um) {
            *mean += weight * place;
        }
        self.weights += weight;
    }

    fn posterior(self) -> Posterior {
        let weights = self.weights;
        let places_um: Vec<f64> = self.places_um.iter().map(|um| um / weights).collect();
        let bar_um = without_line(places_um[self.system.before()..].to_vec());
        let covariance = |(sample, row): (usize, Vec<f64>)| -> Vec<f64> {
            let each = row.iter().zip(&bar_um);
            each.map(|(square, other)| square / weights - bar_um[sample] * other).collect()
        };
        let mut covariance_um2: Vec<Vec<f64>> =
            self.squares_um2.into_iter().enumerate().map(covariance).collect();
        let lost_um2 = self.system.lost_in_noise(self.noise_um2);
        for (place, row) in covariance_um2.iter_mut().enumerate() {
            row[place] += lost_um2;
        }
        Posterior { places_um, covariance_um2 }
    }
}
