//! What the deviation of a screw may be, given readings with noise.
//!
//! A cubic, waves of a turn, and what bends by chance: how often integrated, how strong, and with how many
//! waves is not chosen. Each is weighed by how probable it makes the readings (Bayesian model averaging, Hoeting
//! et al., *Statistical Science* 14, 1999, 382), and curves are drawn of all. What bends by chance has no steps,
//! waves or bumps: where they make the readings more probable, with all places that they might have, they are
//! among what every curve has (de Jong and Penzer, *Diagnosing shocks in time series*, JASA 93, 1998, 796).

mod features;

use std::f64::consts::TAU;

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::smooth_process::{Order, Process};
use super::{Curve, Weighting, fit_mean_line};
use crate::banded::{Banded, Factor};
use crate::number::{dot, mean, number};

/// Level, slope, and two terms that bend; of what bends, as of steps and waves, it is known how large it may be.
const CUBIC: usize = 4;
const UNKNOWN: usize = 2;
/// Most waves a turn. Chosen: a turn that is eccentric, oval, and one more. Doubled: more than eight samples show.
const MOST_WAVES: usize = 3;
/// Cosine and sine of a wave, or of how it grows evenly along the travel.
const A_PAIR: usize = 2;
/// Samples that a wave needs, lest two or three a turn be one.
const SAMPLES_A_WAVE: f64 = 2.5;
/// A process is too weak to be seen whose deviation at the end is a tenth of what the mean of all readings leaves.
const UNSEEN: f64 = 0.01;
/// Steps of the logarithm of a strength, rough ones to compare by, and finer ones about the most probable.
const STEP: f64 = 2.0;
const ROUGH_STEP: f64 = 4.0;
const FINE_STEP: f64 = 0.15;
const FINE_STEPS: i8 = 10;
/// Most places by which the models are weighed. Of a longer record, means of neighbours are.
const MOST_PLACES: usize = 4000;

/// A process, if any, with its strength, and how many pairs of columns of waves.
#[derive(Clone, Copy, Debug)]
struct Model {
    process: Option<(Order, f64)>,
    pairs: usize,
}

/// Readings in units of their noise, and what every model may have beside its process.
struct Readings {
    /// Share of the travel.
    places: Vec<f64>,
    values: Vec<f64>,
    /// Variance of a value.
    variance: f64,
    /// A cubic, steps and other features, then two pairs of each wave: even, and growing.
    columns: Vec<Vec<f64>>,
    /// What every curve has: the cubic and the features.
    every: usize,
    /// Variance of the readings about their mean line, which is what a bend or a wave may be.
    of_curve: f64,
}

/// Curves as they may have been without noise of `noise_um`.
pub(super) fn drawn(
    curve: &Curve,
    noise_um: f64,
    lead_mm: f64,
    number_of_curves: usize,
    random: &mut ChaCha8Rng,
) -> Vec<Curve> {
    let (readings, models) = Readings::of(curve, noise_um, lead_mm).with_features();
    let most = most_probable(&models).1;
    let models: Vec<(Model, f64)> =
        models.into_iter().map(|(model, log)| (model, libm::exp(log - most))).collect();
    let all: f64 = models.iter().map(|(_, weight)| weight).sum();
    let mut asked = vec![0; models.len()];
    for _ in 0..number_of_curves {
        let mut left = all * random.random_range(0.0..1.0);
        let chosen = models.iter().position(|(_, weight)| {
            left -= weight;
            left < 0.0
        });
        asked[chosen.unwrap_or(models.len() - 1)] += 1;
    }
    let models = models.iter().zip(asked).filter(|(_, times)| 0 < *times);
    let deviations = models.flat_map(|((model, _), times)| readings.drawn(*model, times, random));
    let line = fit_mean_line(curve, Weighting::Samples);
    let mut curves = Vec::with_capacity(number_of_curves);
    for deviations in deviations {
        let mut next = deviations.iter().zip(curve.travel_mm());
        let along_line = |(off, mm): (&f64, &f64)| line.at(*mm) + noise_um * off;
        curves.push(curve.changed(|um| next.next().map_or(*um, along_line)));
    }
    curves
}

impl Readings {
    fn of(curve: &Curve, noise_um: f64, lead_mm: f64) -> Self {
        let line = fit_mean_line(curve, Weighting::Samples);
        let travel = curve.travel_mm();
        let off = |(mm, um): (&f64, &f64)| (um - line.at(*mm)) / noise_um;
        let values: Vec<f64> = travel.iter().zip(curve.deviation_um()).map(off).collect();
        let places: Vec<f64> =
            travel.iter().map(|mm| (mm - curve.first_mm()) / curve.length_mm()).collect();
        let a_turn = lead_mm / curve.median_step_mm() / SAMPLES_A_WAVE;
        let waves = (1..=MOST_WAVES).filter(|wave| number(*wave) <= a_turn);
        let powers: [fn(f64) -> f64; CUBIC] =
            [|_| 1.0, |x| x, |x| 4.0 * x * x, |x| 8.0 * x * x * x];
        let mut columns: Vec<Vec<f64>> =
            powers.map(|power| places.iter().map(|x| power(x - 0.5)).collect()).to_vec();
        for wave in waves {
            let turns = number(wave) / lead_mm;
            let even = [libm::cos, libm::sin].map(|part: fn(f64) -> f64| {
                travel.iter().map(|mm| part(TAU * (mm * turns).fract())).collect::<Vec<f64>>()
            });
            let grows = even.clone().map(|even| {
                even.iter().zip(&places).map(|(one, x)| one * 2.0 * (x - 0.5)).collect()
            });
            columns.extend(even.into_iter().chain(grows));
        }
        let of_curve = mean(&values.iter().map(|value| value * value).collect::<Vec<_>>()).max(1.0);
        Self { places, values, variance: 1.0, columns, every: CUBIC, of_curve }
    }

    fn means_of_neighbours(&self) -> Self {
        let neighbours = self.values.len().div_ceil(MOST_PLACES);
        let means = |values: &Vec<f64>| values.chunks_exact(neighbours).map(mean).collect();
        Self {
            places: means(&self.places),
            values: means(&self.values),
            variance: 1.0 / number(neighbours),
            columns: self.columns.iter().map(means).collect(),
            every: self.every,
            of_curve: self.of_curve,
        }
    }

    fn most_pairs(&self) -> usize {
        (self.columns.len() - self.every) / A_PAIR
    }

    /// All models with the logarithms of how probable they make the readings.
    fn weighed(&self) -> Vec<(Model, f64)> {
        let without = self.evidence_of(None, 1.0);
        let orders = Order::ALL.into_iter().flat_map(|order| self.of_order(order));
        without.into_iter().chain(orders).collect()
    }

    /// The same by coarse steps of the strength, to compare readings with more columns and fewer.
    fn roughly_weighed(&self) -> Vec<(Model, f64)> {
        let without = self.evidence_of(None, 1.0);
        let orders =
            Order::ALL.into_iter().flat_map(|order| self.coarsely_of_order(order, ROUGH_STEP));
        without.into_iter().chain(orders.flat_map(|(_, found)| found)).collect()
    }

    /// The models of one order by coarse steps of the logarithm of its strength.
    fn coarsely_of_order(&self, order: Order, step: f64) -> Vec<(f64, Vec<(Model, f64)>)> {
        let (from, to) = self.range(order);
        let steps = ((to - from) / step).ceil();
        let at = |log: f64, share: f64| self.evidence_of(Some((order, libm::exp(log))), share);
        let middles = std::iter::successors(Some(0.5), |step| Some(step + 1.0));
        middles
            .take_while(|step| *step < steps)
            .map(|step| from + (to - from) * step / steps)
            .map(|strength| (strength, at(strength, 1.0 / steps)))
            .collect()
    }

    /// The models of one order, by steps of their strength, and by finer ones about the most probable.
    fn of_order(&self, order: Order) -> Vec<(Model, f64)> {
        let (from, to) = self.range(order);
        let at = |step: f64, share: f64| self.evidence_of(Some((order, libm::exp(step))), share);
        let coarse = self.coarsely_of_order(order, STEP);
        let most = |found: &[(Model, f64)]| most_probable(found).1;
        let best = coarse.iter().fold((f64::NEG_INFINITY, from), |best, (strength, found)| {
            if best.0 < most(found) { (most(found), *strength) } else { best }
        });
        let near = FINE_STEP * (f64::from(FINE_STEPS) + 0.5);
        let far = coarse.into_iter().filter(|(strength, _)| near < (strength - best.1).abs());
        let fine = (-FINE_STEPS..=FINE_STEPS)
            .flat_map(|step| at(best.1 + FINE_STEP * f64::from(step), FINE_STEP / (to - from)));
        far.flat_map(|(_, found)| found).chain(fine).collect()
    }

    /// Logarithms of the strengths from one that is not seen to one that is all there is from sample to sample.
    fn range(&self, order: Order) -> (f64, f64) {
        let samples = number(self.values.len());
        let unseen = UNSEEN / samples / order.variance(1.0);
        let all = self.of_curve / order.variance(1.0 / samples);
        (libm::log(unseen), libm::log(all))
    }

    /// Logarithm of how probable a process makes the readings, by the number of pairs beside it, times a share.
    fn evidence_of(&self, process: Option<(Order, f64)>, share: f64) -> Vec<(Model, f64)> {
        let whitened = Whitened::of(self, process);
        let kinds = self.most_pairs() + 1;
        let share = libm::log(share / number(kinds));
        let each = (0..kinds).map(|pairs| {
            let evidence =
                whitened.beside(pairs).map_or(f64::NEG_INFINITY, |beside| beside.evidence);
            (Model { process, pairs }, share + evidence)
        });
        each.collect()
    }

    /// So many curves of one model.
    fn drawn(&self, model: Model, times: usize, random: &mut ChaCha8Rng) -> Vec<Vec<f64>> {
        let whitened = Whitened::of(self, model.process);
        let Some(beside) = whitened.beside(model.pairs) else { return Vec::new() };
        let one = |_| {
            let sizes = beside.drawn(random);
            let terms = self.columns.iter().zip(&sizes);
            let mut drawn = vec![0.0; self.values.len()];
            for (column, size) in terms {
                for (value, part) in drawn.iter_mut().zip(column) {
                    *value += size * part;
                }
            }
            if let Some(process) = &whitened.process {
                let left: Vec<f64> =
                    self.values.iter().zip(&drawn).map(|(all, known)| all - known).collect();
                let bent = process.drawn(&left, random);
                for (value, bent) in drawn.iter_mut().zip(bent) {
                    *value += bent;
                }
            }
            drawn
        };
        (0..times).map(one).collect()
    }
}

fn most_probable(models: &[(Model, f64)]) -> (Model, f64) {
    let none = (Model { process: None, pairs: 0 }, f64::NEG_INFINITY);
    models.iter().fold(none, |most, one| if most.1 < one.1 { *one } else { most })
}

/// Logarithm of how probable all models together make the readings.
fn evidence(models: &[(Model, f64)]) -> f64 {
    let most = most_probable(models).1;
    most + libm::log(models.iter().map(|(_, log)| libm::exp(log - most)).sum())
}

/// Readings and columns with the covariance that a process gives them taken off.
struct Whitened<'a> {
    readings: &'a Readings,
    process: Option<Box<dyn Process>>,
    values: Vec<f64>,
    columns: Vec<Vec<f64>>,
    /// Of each column with the readings, and with those up to itself.
    products: Vec<f64>,
    squares: Vec<Vec<f64>>,
}

/// Cubic, features and waves of a turn beside a process.
struct Beside {
    best: Vec<f64>,
    precision: Factor,
    evidence: f64,
}

impl<'a> Whitened<'a> {
    fn of(readings: &'a Readings, process: Option<(Order, f64)>) -> Self {
        let process = process
            .map(|(order, strength)| order.process(strength, &readings.places, readings.variance));
        let mut whitened = Self {
            readings,
            process,
            values: Vec::new(),
            columns: Vec::new(),
            products: Vec::new(),
            squares: Vec::new(),
        };
        whitened.values = whitened.white(&readings.values);
        for column in &readings.columns {
            let column = whitened.white(column);
            whitened.products.push(dot(&column, &whitened.values));
            whitened.columns.push(column);
            let (this, all) = (whitened.columns.len() - 1, &whitened.columns);
            whitened.squares.push(all.iter().map(|other| dot(&all[this], other)).collect());
        }
        whitened
    }

    fn white(&self, values: &[f64]) -> Vec<f64> {
        match &self.process {
            Some(process) => process.innovations(values),
            None => values.iter().map(|value| value / self.readings.variance.sqrt()).collect(),
        }
    }

    fn log_variances(&self) -> f64 {
        let samples = number(self.values.len());
        let process = self.process.as_ref().map(|process| process.log_variances());
        process.unwrap_or(samples * libm::log(self.readings.variance))
    }

    /// Beside so many pairs; `None` where the columns are not told apart.
    fn beside(&self, pairs: usize) -> Option<Beside> {
        let width = self.readings.every + A_PAIR * pairs;
        let mut precision = Banded::zeros(width, width - 1);
        for (row, squares) in self.squares[..width].iter().enumerate() {
            for (column, square) in squares.iter().enumerate() {
                precision.add(row, column, *square);
            }
            if UNKNOWN <= row {
                precision.add(row, row, 1.0 / self.readings.of_curve);
            }
        }
        let precision = precision.factor()?;
        let best = precision.solve(&self.products[..width]);
        let left = dot(&self.values, &self.values) - dot(&best, &self.products[..width]);
        let sizes = number(width - UNKNOWN) * libm::log(self.readings.of_curve);
        let logs = self.log_variances() + precision.log_determinant() + sizes;
        Some(Beside { best, precision, evidence: -0.5 * (left + logs) })
    }

    /// What twice the log likelihood gains by columns beside others, up to two.
    fn gain(&self, beside: &Beside, columns: &[Vec<f64>]) -> f64 {
        let width = columns.len();
        let mut own = Banded::zeros(width, width.saturating_sub(1));
        let mut along = vec![0.0; width];
        for (row, column) in columns.iter().enumerate() {
            let others = self.columns.iter().take(beside.best.len());
            let shared: Vec<f64> = others.map(|one| dot(one, column)).collect();
            along[row] = dot(column, &self.values) - dot(&beside.best, &shared);
            let told = beside.precision.solve(&shared);
            for (place, other) in columns.iter().take(row + 1).enumerate() {
                let others = self.columns.iter().take(beside.best.len());
                let by_others: f64 =
                    others.zip(&told).map(|(one, told)| dot(one, other) * told).sum();
                let size = if place == row { 1.0 / self.readings.of_curve } else { 0.0 };
                own.add(row, place, dot(column, other) - by_others + size);
            }
        }
        own.factor().map_or(0.0, |own| dot(&own.solve(&along), &along))
    }

    /// What a model leaves of the readings.
    fn left(&self, beside: &Beside) -> Vec<f64> {
        let mut left = self.values.clone();
        for (column, size) in self.columns.iter().zip(&beside.best) {
            for (value, part) in left.iter_mut().zip(column) {
                *value -= size * part;
            }
        }
        left
    }
}

impl Beside {
    /// Sizes as they may be.
    fn drawn(&self, random: &mut ChaCha8Rng) -> Vec<f64> {
        let normal: Vec<f64> = self.best.iter().map(|_| StandardNormal.sample(random)).collect();
        let off = self.precision.drawn(normal);
        self.best.iter().zip(off).map(|(best, off)| best + off).collect()
    }
}
