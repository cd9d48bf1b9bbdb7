//! Waves of a bar: sizes, phases and lengths fitted beside a smooth form.

use std::f64::consts::PI;

use super::system::{Smooth, System};
use crate::banded::{Banded, Factor};
use crate::number::{dot, number};

/// What is known of waves before anything is read.
#[derive(Clone, Copy, Debug)]
pub(super) struct Prior {
    /// Variance of a mean `z`, µm².
    pub(super) noise_um2: f64,
    /// Mean square of the bar: sizes of waves are of this order, µm².
    pub(super) size_um2: f64,
}

/// Waves with a smooth form, fitted together; linear about their frequencies.
pub(super) struct Waves {
    /// Sine, cosine of each wave, and then what a change of its frequency does, by place.
    pub(super) columns: Vec<Vec<f64>>,
    /// What the probes see of them.
    pub(super) seen: Vec<Vec<f64>>,
    /// Their coefficients.
    pub(super) coefficients: Vec<f64>,
    /// Precision of the coefficients.
    pub(super) precision: Factor,
    /// Minus twice the logarithm of the probability of `z` with this smoothness and these waves.
    pub(super) misfit: f64,
}

/// Sine and cosine, by place counted from the middle: radians a step.
fn pair(frequency: f64, places: usize) -> [Vec<f64>; 2] {
    let of = |function: fn(f64) -> f64| -> Vec<f64> {
        (0..places).map(|place| function(frequency * from_middle(place, places))).collect()
    };
    [of(libm::sin), of(libm::cos)]
}

fn from_middle(place: usize, places: usize) -> f64 {
    number(place) - number(places - 1) / 2.0
}

/// Forms, what the probes see of them, and what a smooth form leaves of that.
#[derive(Default)]
struct Columns {
    forms: Vec<Vec<f64>>,
    seen: Vec<Vec<f64>>,
    left: Vec<Vec<f64>>,
}

impl Columns {
    fn add(&mut self, system: &System<'_>, smooth: &Smooth, form: Vec<f64>) {
        let seen = system.seen(&form);
        self.left.push(smooth.left(system, &seen));
        self.seen.push(seen);
        self.forms.push(form);
    }

    /// Sines and cosines.
    fn of(system: &System<'_>, smooth: &Smooth, frequencies: &[f64]) -> Self {
        let mut columns = Self::default();
        for form in frequencies.iter().flat_map(|frequency| pair(*frequency, system.places())) {
            columns.add(system, smooth, form);
        }
        columns
    }

    /// Normal equations with a diagonal added: their factor, solution, and what it explains of z, µm².
    fn solved(&self, z_um: &[f64], diagonal: &[f64]) -> Option<(Factor, Vec<f64>, f64)> {
        let factor = products(&self.seen, &self.left, diagonal)?;
        let right: Vec<f64> = self.left.iter().map(|left| dot(left, z_um)).collect();
        let solved = factor.solve(&right);
        let explained_um2 = dot(&solved, &right);
        Some((factor, solved, explained_um2))
    }
}

/// `columnsᵀ·left`, with a diagonal added, factored.
fn products(columns: &[Vec<f64>], left: &[Vec<f64>], diagonal: &[f64]) -> Option<Factor> {
    let mut matrix = Banded::zeros(columns.len(), columns.len().saturating_sub(1));
    for (i, column) in columns.iter().enumerate() {
        for (j, left) in left.iter().enumerate().take(i + 1) {
            let more = if i == j { diagonal[i] } else { 0.0 };
            matrix.add(i, j, dot(column, left) + more);
        }
    }
    matrix.factor()
}

/// Waves of these frequencies with a smooth form.
pub(super) fn fit(
    system: &System<'_>,
    smooth: &Smooth,
    prior: Prior,
    frequencies: &[f64],
) -> Option<Waves> {
    let places = system.places();
    let mut columns = Columns::of(system, smooth, frequencies);
    let amplitudes = 2 * frequencies.len();
    let mut ridge = vec![prior.noise_um2 / prior.size_um2; amplitudes];
    let (_, sizes, _) = columns.solved(system.z_um, &ridge)?;
    for (wave, size) in sizes.chunks_exact(2).enumerate() {
        let (sine, cosine) = (&columns.forms[2 * wave], &columns.forms[2 * wave + 1]);
        let change = |place: usize| {
            from_middle(place, places) * (size[0] * cosine[place] - size[1] * sine[place])
        };
        let changes = (0..places).map(change).collect();
        columns.add(system, smooth, changes);
    }
    // A frequency may lie anywhere from 0 to π.
    ridge.resize(columns.forms.len(), prior.noise_um2 * 12.0 / (PI * PI));
    let (precision, coefficients, explained_um2) = columns.solved(system.z_um, &ridge)?;
    let squares_um2 = dot(&smooth.left(system, system.z_um), system.z_um);
    let narrowed = precision.log_determinant() - ridge.iter().map(|r| libm::log(*r)).sum::<f64>();
    let misfit = (squares_um2 - explained_um2) / prior.noise_um2 + narrowed + smooth.cost;
    let Columns { forms: columns, seen, .. } = columns;
    misfit.is_finite().then_some(Waves { columns, seen, coefficients, precision, misfit })
}

/// Smoothness weights with which waves are looked for.
pub(super) struct Search<'a> {
    system: &'a System<'a>,
    prior: Prior,
    levels: Vec<Level>,
    frequencies: Vec<f64>,
}

struct Level {
    smooth: Smooth,
    /// `zᵀ·left(z)`.
    squares_um2: f64,
    /// Sine and cosine of each frequency as seen, and what a smooth form leaves of them.
    waves: Vec<[(Vec<f64>, Vec<f64>); 2]>,
}

/// Frequencies tried, for one that can be told from its neighbour.
const DENSITY: f64 = 3.0;
/// Longest wave, in lengths of the bar: a longer one is a bow.
const LONGEST: f64 = 2.2;
/// Steps of a refinement.
const STEPS: usize = 8;

impl<'a> Search<'a> {
    /// Prepares a search with these smoothness weights.
    pub(super) fn new(
        system: &'a System<'a>,
        prior: Prior,
        smoothness: impl Iterator<Item = f64>,
    ) -> Self {
        let places = number(system.places());
        let step = 2.0 * PI / (DENSITY * places);
        let from = 2.0 * PI / (LONGEST * places);
        let frequencies: Vec<f64> = (0..2 * system.places())
            .map(|k| from + number(k) * step)
            .take_while(|f| *f < PI)
            .collect();
        let level = |smoothness: f64| {
            let smooth = system.smooth(smoothness)?;
            let column = |form: Vec<f64>| {
                let seen = system.seen(&form);
                let left = smooth.left(system, &seen);
                (seen, left)
            };
            let waves = frequencies.iter().map(|f| pair(*f, system.places()).map(column)).collect();
            let squares_um2 = dot(&smooth.left(system, system.z_um), system.z_um);
            Some(Level { smooth, squares_um2, waves })
        };
        let levels = smoothness.filter_map(level).collect();
        Self { system, prior, levels, frequencies }
    }

    /// The waves with one more, and all frequencies refined; `None` when no more can be told.
    pub(super) fn one_more(&self, waves: &[f64]) -> Option<Vec<f64>> {
        let best = self.levels.iter().filter_map(|level| Some((level, self.best(level, waves)?)));
        let (level, (_, frequency)) = best.min_by(|a, b| a.1.0.total_cmp(&b.1.0))?;
        let more = [waves, &[frequency]].concat();
        Some(self.refined(&level.smooth, more))
    }

    /// Least cost with one more wave, and its frequency.
    fn best(&self, level: &Level, waves: &[f64]) -> Option<(f64, f64)> {
        let ridge = self.prior.noise_um2 / self.prior.size_um2;
        let columns = Columns::of(self.system, &level.smooth, waves);
        let (known, fitted, explained_um2) =
            columns.solved(self.system.z_um, &vec![ridge; 2 * waves.len()])?;
        let left = &columns.left;
        let explained = |[(sine, sine_left), (cosine, cosine_left)]: &[(Vec<f64>, Vec<f64>); 2]| {
            let across = |column: &[f64]| -> Vec<f64> {
                left.iter().map(|left| dot(left, column)).collect()
            };
            let (to_sine, to_cosine) = (across(sine), across(cosine));
            let (by_sine, by_cosine) = (known.solve(&to_sine), known.solve(&to_cosine));
            let own = [
                dot(sine, sine_left) + ridge - dot(&to_sine, &by_sine),
                dot(sine, cosine_left) - dot(&to_sine, &by_cosine),
                dot(cosine, cosine_left) + ridge - dot(&to_cosine, &by_cosine),
            ];
            let z = [
                dot(sine_left, self.system.z_um) - dot(&to_sine, &fitted),
                dot(cosine_left, self.system.z_um) - dot(&to_cosine, &fitted),
            ];
            let determinant = own[0] * own[2] - own[1] * own[1];
            (own[2] * z[0] * z[0] - 2.0 * own[1] * z[0] * z[1] + own[0] * z[1] * z[1]) / determinant
        };
        let gap = (self.frequencies[1] - self.frequencies[0]) / 2.0;
        let apart = |frequency: &f64| waves.iter().all(|wave| gap <= (wave - frequency).abs());
        let candidates = self.frequencies.iter().zip(&level.waves).filter(|(f, _)| apart(f));
        let gains = candidates.map(|(frequency, wave)| (explained(wave), *frequency));
        let (gain, frequency) =
            gains.filter(|(g, _)| g.is_finite()).max_by(|a, b| a.0.total_cmp(&b.0))?;
        let squares_um2 = level.squares_um2 - explained_um2 - gain;
        Some((squares_um2 / self.prior.noise_um2 + level.smooth.cost, frequency))
    }

    /// Gauss-Newton steps in all frequencies, as long as they explain more.
    fn refined(&self, smooth: &Smooth, mut waves: Vec<f64>) -> Vec<f64> {
        let ridge = vec![self.prior.noise_um2 / self.prior.size_um2; 2 * waves.len()];
        let explained = |waves: &[f64]| -> Option<f64> {
            let columns = Columns::of(self.system, smooth, waves);
            Some(columns.solved(self.system.z_um, &ridge)?.2)
        };
        let longest_step = self.frequencies[1] - self.frequencies[0];
        let lowest = self.frequencies[0] / 3.0;
        let Some(mut best) = explained(&waves) else { return waves };
        for _ in 0..STEPS {
            let Some(fit) = fit(self.system, smooth, self.prior, &waves) else { break };
            let steps = &fit.coefficients[2 * waves.len()..];
            let moved = |part: f64| -> Vec<f64> {
                let step = |(wave, step): (&f64, &f64)| {
                    (wave + part * step.clamp(-longest_step, longest_step)).clamp(lowest, PI)
                };
                waves.iter().zip(steps).map(step).collect()
            };
            let tried = [1.0, 0.5, 0.25, 0.1].into_iter().map(moved);
            let better = tried.filter_map(|waves| Some((explained(&waves)?, waves)));
            let Some((more, next)) = better.max_by(|a, b| a.0.total_cmp(&b.0)) else { break };
            if more <= best {
                break;
            }
            (best, waves) = (more, next);
        }
        waves
    }
}
