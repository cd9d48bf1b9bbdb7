//! What the deviation of a screw may be, given readings with noise.
//!
//! What bends by chance, beside a line or what else it begins with up to a cubic, and waves of a turn: how often
//! integrated, how strong, and with how many waves is not chosen. Each is weighed by how probable it makes the
//! readings (Bayesian model averaging, Hoeting et al., *Statistical Science* 14, 1999, 382), and curves are drawn of
//! all. What bends by chance has no steps, kinks, waves or bumps: where they make the readings more probable, with
//! all places that they might have, they are among what every curve has (de Jong and Penzer, *Diagnosing shocks in
//! time series*, JASA 93, 1998, 796).

mod feature;
mod features;
mod gains;

use std::f64::consts::TAU;

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::smooth_process::{Order, Process, Wandering};
use super::{Curve, Weighting, fit_mean_line};
use crate::banded::{Banded, Factor};
use crate::number::{dot, long_dot, mean, number};

/// Level, slope, and two terms that bend; of what bends, as of steps and waves, it is known how large it may be.
const CUBIC: usize = 4;
const UNKNOWN: usize = 2;
/// Most waves a turn. Chosen: a turn that is eccentric, oval, and one more. Doubled: more than eight samples show.
const MOST_WAVES: usize = 3;
/// Cosine and sine of a wave, or of how it grows evenly along the travel.
const A_PAIR: usize = 2;
/// Pairs of a wave of a turn that grows.
const GROWING: usize = 2;
/// Samples that a wave needs, lest two or three a turn be one.
const SAMPLES_A_WAVE: f64 = 2.5;
/// A process is too weak to be seen whose deviation at the end is a tenth of what the mean of all readings leaves.
const UNSEEN: f64 = 0.01;
/// Steps of the logarithm of a strength, rough ones to compare by, halved towards the most probable, and finer ones
/// about it, to a quarter: a record of hundreds of readings tells the logarithm to about as much.
const STEP: f64 = 2.0;
const ROUGH_STEP: f64 = 4.0;
const ROUGH_HALVINGS: i32 = 4;
const FINE_STEP: f64 = 0.15;
const FINE_STEPS: i8 = 10;
/// Models that are less probable than the most probable by this much, of the logarithm, are drawn once in
/// millions of curves.
const NEVER_DRAWN: f64 = 15.0;
/// Most places by which the models are weighed. Of a longer record, means of neighbours are.
const MOST_PLACES: usize = 4000;

/// A process, if any, with its strength, and how many pairs of columns of waves.
#[derive(Clone, Copy, Debug)]
struct Model {
    process: Option<(Order, f64)>,
    pairs: usize,
}

/// Models of one order by the logarithm of its strength.
type Strengths = Vec<(f64, Vec<(Model, f64)>)>;

/// Readings in units of their noise, and what every model may have beside its process.
#[derive(Clone)]
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
    /// A turn, as a share of the travel, where its wave is shown.
    turn: Option<f64>,
    /// How strongly the sizes of the wave of a turn change by chance, where they do.
    wandering: Option<f64>,
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
        let turn = (1.0 <= a_turn).then(|| lead_mm / curve.length_mm());
        let of_curve = mean(&values.iter().map(|value| value * value).collect::<Vec<_>>()).max(1.0);
        Self {
            places,
            values,
            variance: 1.0,
            columns,
            every: CUBIC,
            turn,
            wandering: None,
            of_curve,
        }
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
            turn: self.turn,
            wandering: self.wandering,
            of_curve: self.of_curve,
        }
    }

    /// A process with the wave of a turn that wanders beside it, if it does.
    fn process(&self, process: Option<(Order, f64)>) -> Option<Box<dyn Process>> {
        let wave = [0, 1].map(|part| self.every + part);
        let wandering = self.wandering.map(|strength| Wandering {
            strength,
            wave: wave.map(|part| self.columns[part].as_slice()),
        });
        let (order, strength) = process.or(wandering.as_ref().map(|_| (Order::First, 0.0)))?;
        Some(order.process(strength, &self.places, self.variance, wandering.as_ref()))
    }

    /// Columns that stand beside a process: of the cubic what the process begins with, and no less than a line.
    fn beside(&self, process: Option<(Order, f64)>) -> impl Iterator<Item = &Vec<f64>> {
        let begins = process.map_or(UNKNOWN, |(order, _)| UNKNOWN.max(order as usize));
        self.columns[..begins].iter().chain(&self.columns[CUBIC..])
    }

    fn most_pairs(&self) -> usize {
        (self.columns.len() - self.every) / A_PAIR
    }

    /// All models with the logarithms of how probable they make the readings, finely where they may be drawn.
    fn weighed(&self) -> Vec<(Model, f64)> {
        let mut models = self.evidence_of(None, 1.0);
        let coarse = Order::ALL.map(|order| (order, self.coarsely_of_order(order, STEP)));
        let most = |coarse: &Strengths| {
            let each = coarse.iter().map(|(_, found)| most_probable(found).1);
            each.fold(f64::NEG_INFINITY, f64::max)
        };
        let of_orders = coarse.iter().map(|(_, coarse)| most(coarse));
        let bar = of_orders.fold(most_probable(&models).1, f64::max) - NEVER_DRAWN;
        for (order, coarse) in coarse {
            if most(&coarse) < bar {
                models.extend(coarse.into_iter().flat_map(|(_, found)| found));
            } else {
                models.extend(self.of_order(order, coarse));
            }
        }
        models
    }

    /// The same by coarse steps of the strength, and closer ones towards the most probable, to compare readings with
    /// more columns and fewer: a strength that is far off makes of any feature that brings it nearer a gain.
    fn roughly_weighed(&self) -> Vec<(Model, f64)> {
        let without = self.evidence_of(None, 1.0);
        let orders =
            Order::ALL.into_iter().flat_map(|order| self.coarsely_of_order(order, ROUGH_STEP));
        let mut models: Vec<(Model, f64)> =
            without.into_iter().chain(orders.flat_map(|(_, found)| found)).collect();
        for halving in 1..=ROUGH_HALVINGS {
            let Some((order, strength)) = most_probable(&models).0.process else { break };
            let (from, to) = self.range(order);
            let step = libm::ldexp(ROUGH_STEP, -halving);
            for nearer in [-step, step] {
                let strength = strength * libm::exp(nearer);
                let share = ROUGH_STEP / (to - from);
                models.extend(self.evidence_of(Some((order, strength)), share));
            }
        }
        models
    }

    /// The models of one order by coarse steps of the logarithm of its strength, up to where they are never drawn.
    fn coarsely_of_order(&self, order: Order, step: f64) -> Strengths {
        let (from, to) = self.range(order);
        let steps = ((to - from) / step).ceil();
        let at = |log: f64| self.evidence_of(Some((order, libm::exp(log))), 1.0 / steps);
        let (mut coarse, mut middle, mut most) = (Vec::new(), 0.5, f64::NEG_INFINITY);
        while middle < steps {
            let strength = from + (to - from) * middle / steps;
            let found = at(strength);
            let here = most_probable(&found).1;
            coarse.push((strength, found));
            if here < most - NEVER_DRAWN {
                break;
            }
            (most, middle) = (most.max(here), middle + 1.0);
        }
        coarse
    }

    /// The models of one order, by coarse steps of their strength, and by finer ones about the most probable.
    fn of_order(&self, order: Order, coarse: Strengths) -> Vec<(Model, f64)> {
        let (from, to) = self.range(order);
        let at = |step: f64, share: f64| self.evidence_of(Some((order, libm::exp(step))), share);
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
        self.range_within(order, 1.0 / number(self.values.len()))
    }

    /// The same to one that is all there is within a distance.
    fn range_within(&self, order: Order, distance: f64) -> (f64, f64) {
        let unseen = UNSEEN / number(self.values.len()) / order.variance(1.0);
        let all = self.of_curve / order.variance(distance);
        (libm::log(unseen), libm::log(all))
    }

    /// Logarithm of how probable a process makes the readings, by the number of pairs beside it, times a share.
    fn evidence_of(&self, process: Option<(Order, f64)>, share: f64) -> Vec<(Model, f64)> {
        let whitened = Whitened::of(self, process);
        // A wave that wanders begins with one that grows evenly.
        let fewest = if self.wandering.is_some() { GROWING } else { 0 };
        let kinds = fewest..=self.most_pairs();
        let share = libm::log(share / number(kinds.clone().count()));
        let each = kinds.map(|pairs| {
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
            let terms = self.beside(model.process).zip(&sizes);
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
        let mut whitened = Self {
            readings,
            process: readings.process(process),
            values: Vec::new(),
            columns: Vec::new(),
            products: Vec::new(),
            squares: Vec::new(),
        };
        whitened.values = whitened.white(0, &readings.values);
        for column in readings.beside(process) {
            let column = whitened.white(0, column);
            whitened.products.push(long_dot(&column, &whitened.values));
            whitened.columns.push(column);
            let (this, all) = (whitened.columns.len() - 1, &whitened.columns);
            whitened.squares.push(all.iter().map(|other| long_dot(&all[this], other)).collect());
        }
        whitened
    }

    /// Values from a place on, those before it being zero.
    fn white(&self, from: usize, values: &[f64]) -> Vec<f64> {
        match &self.process {
            Some(process) => process.innovations(from, values),
            None => values.iter().map(|value| value / self.readings.variance.sqrt()).collect(),
        }
    }

    /// The inverse of the covariance times values.
    fn weighted(&self, values: &[f64]) -> Vec<f64> {
        let smoothed = self.process.as_ref().map(|process| process.smoothed(values));
        let bent = smoothed.unwrap_or_else(|| vec![0.0; values.len()]);
        let left = values.iter().zip(bent).map(|(value, bent)| value - bent);
        left.map(|left| left / self.readings.variance).collect()
    }

    fn log_variances(&self) -> f64 {
        let samples = number(self.values.len());
        let process = self.process.as_ref().map(|process| process.log_variances());
        process.unwrap_or(samples * libm::log(self.readings.variance))
    }

    /// Beside so many pairs; `None` where the columns are not told apart.
    fn beside(&self, pairs: usize) -> Option<Beside> {
        let others = self.readings.most_pairs() - pairs;
        let width = self.columns.len() - A_PAIR * others;
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
