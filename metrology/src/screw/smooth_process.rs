//! A deviation that bends by chance along the travel, read with noise: a Wiener process, or its integral of
//! some order (Wahba, *Improper priors, spline smoothing and the problem of guarding against model errors in
//! regression*, J. R. Stat. Soc. B 40, 1978, 364), filtered and drawn in one sweep each way (Durbin and
//! Koopman, *A simple and efficient simulation smoother*, Biometrika 89, 2002, 603).

use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::number::{dot, number};

/// A process that begins with nothing, given readings of it at some places.
pub(super) trait Process {
    /// Sum of the logarithms of the variances of what readings are off what is expected of them.
    fn log_variances(&self) -> f64;

    /// What readings from a place on are off what is expected of them, in standard deviations, those before
    /// it being zero.
    fn innovations(&self, from: usize, readings: &[f64]) -> Vec<f64>;

    /// The most probable values, given readings.
    fn smoothed(&self, readings: &[f64]) -> Vec<f64>;

    /// Values as they may have been, given readings.
    fn drawn(&self, readings: &[f64], random: &mut ChaCha8Rng) -> Vec<f64>;
}

/// How often what changes the size of a wave by chance is integrated: it has no kinks.
const WAVE_ORDER: usize = 2;

/// How many integrals a value is of what changes by chance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Order {
    First = 1,
    Second = 2,
    Third = 3,
    Fourth = 4,
}

impl Order {
    pub(super) const ALL: [Self; 4] = [Self::First, Self::Second, Self::Third, Self::Fourth];

    /// Variance of the value at a distance, for a strength of one.
    pub(super) fn variance(self, distance: f64) -> f64 {
        let order = self as usize;
        libm::pow(distance, number(2 * order - 1)) * share(order, 0, 0)
    }

    /// The process at places that never decrease, of readings with a variance.
    pub(super) fn process(
        self,
        strength: f64,
        places: &[f64],
        variance: f64,
        wandering: Option<&Wandering>,
    ) -> Box<dyn Process> {
        let of_order = match (self, wandering.is_some()) {
            (Self::First, false) => boxed::<1, 1>,
            (Self::Second, false) => boxed::<2, 2>,
            (Self::Third, false) => boxed::<3, 3>,
            (Self::Fourth, false) => boxed::<4, 4>,
            (Self::First, true) => boxed::<1, 5>,
            (Self::Second, true) => boxed::<2, 6>,
            (Self::Third, true) => boxed::<3, 7>,
            (Self::Fourth, true) => boxed::<4, 8>,
        };
        of_order(strength, places, variance, wandering)
    }
}

fn boxed<const N: usize, const ALL: usize>(
    strength: f64,
    places: &[f64],
    variance: f64,
    wandering: Option<&Wandering>,
) -> Box<dyn Process> {
    Box::new(Integral::<N, ALL>::new(strength, places, variance, wandering))
}

/// Covariance of two derivatives of the value at a distance of one, for a strength of one.
fn share(order: usize, one: usize, other: usize) -> f64 {
    let factorial = |of: usize| (1..=of).map(number).product::<f64>();
    let below = factorial(order - 1 - one) * factorial(order - 1 - other);
    1.0 / (number(2 * order - 1 - one - other) * below)
}

/// A wave whose cosine and sine go on as integrals of the second order of what changes by chance.
pub(super) struct Wandering<'a> {
    pub(super) strength: f64,
    /// Cosine and sine at the places.
    pub(super) wave: [&'a [f64]; 2],
}

/// A process whose state is its value and the derivatives of it that do not jump, and, beyond `N`, the sizes of
/// a wave's cosine and sine, each with its derivative.
struct Integral<const N: usize, const ALL: usize> {
    strengths: [f64; ALL],
    /// Variance of a reading.
    variance: f64,
    steps: Vec<Step<N, ALL>>,
}

/// One place: what its reading tells.
struct Step<const N: usize, const ALL: usize> {
    /// How much of each part is read.
    seen: [f64; ALL],
    /// Covariance of the value with the state, before the reading.
    before: [f64; ALL],
    /// The same by the variance of what the reading is off, which is what that tells of the state.
    gain: [f64; ALL],
    /// Variance of what the reading is off, and its root.
    variance: f64,
    deviation: f64,
    /// Distance to the next place.
    distance: f64,
}

impl<const N: usize, const ALL: usize> Step<N, ALL> {
    /// The value of a state.
    fn value(&self, state: &[f64; ALL]) -> f64 {
        (N..ALL).step_by(WAVE_ORDER).fold(state[0], |sum, part| sum + self.seen[part] * state[part])
    }

    /// The state at the next place, this reading so much off what was expected.
    fn next(&self, state: [f64; ALL], off: f64) -> [f64; ALL] {
        let state = std::array::from_fn(|part| state[part] + self.gain[part] * off);
        ahead::<N, ALL>(state, self.distance)
    }
}

impl<const N: usize, const ALL: usize> Integral<N, ALL> {
    fn new(strength: f64, places: &[f64], variance: f64, wandering: Option<&Wandering>) -> Self {
        let of_wave = wandering.map_or(0.0, |wandering| wandering.strength);
        let strengths = std::array::from_fn(|part| if part < N { strength } else { of_wave });
        let shares: [[f64; ALL]; ALL] =
            std::array::from_fn(|i| std::array::from_fn(|j| share_of::<N>(i, j)));
        let mut covariance = [[0.0; ALL]; ALL];
        let mut steps = Vec::with_capacity(places.len());
        for (row, place) in places.iter().enumerate() {
            let distance = places.get(row + 1).map_or(0.0, |next| next - place);
            let seen = std::array::from_fn(|part| match (part, wandering) {
                (0, _) => 1.0,
                (part, Some(wandering)) if part == N => wandering.wave[0][row],
                (part, Some(wandering)) if part == N + WAVE_ORDER => wandering.wave[1][row],
                _ => 0.0,
            });
            let none = [0.0; ALL];
            let mut step =
                Step { seen, before: none, gain: none, variance, deviation: 0.0, distance };
            step.before = std::array::from_fn(|part| step.value(&covariance[part]));
            step.variance += step.value(&step.before);
            step.deviation = step.variance.sqrt();
            step.gain = step.before.map(|before| before / step.variance);
            for (row, cross) in covariance.iter_mut().zip(step.before) {
                for (value, other) in row.iter_mut().zip(step.before) {
                    *value -= cross * other / step.variance;
                }
            }
            let rows = covariance.map(|row| ahead::<N, ALL>(row, distance));
            let columns: [[f64; ALL]; ALL] =
                std::array::from_fn(|j| ahead::<N, ALL>(rows.map(|row| row[j]), distance));
            let powers = powers::<N, ALL>(distance);
            covariance = std::array::from_fn(|i| {
                std::array::from_fn(|j| {
                    columns[j][i] + strengths[i] * distance * powers[i] * powers[j] * shares[i][j]
                })
            });
            steps.push(step);
        }
        Self { strengths, variance, steps }
    }

    /// Values as they may be without readings.
    fn unread(&self, random: &mut ChaCha8Rng) -> Vec<f64> {
        let roots = roots::<N, ALL>();
        let mut state = [0.0; ALL];
        let one = |step: &Step<N, ALL>| {
            let value = step.value(&state);
            let chance: [f64; ALL] = std::array::from_fn(|_| StandardNormal.sample(random));
            let powers = powers::<N, ALL>(step.distance);
            let carried = ahead::<N, ALL>(state, step.distance);
            state = std::array::from_fn(|part| {
                let size = (self.strengths[part] * step.distance).sqrt();
                carried[part] + size * powers[part] * dot(&roots[part], &chance)
            });
            value
        };
        self.steps.iter().map(one).collect()
    }
}

impl<const N: usize, const ALL: usize> Process for Integral<N, ALL> {
    fn log_variances(&self) -> f64 {
        self.steps.iter().map(|step| libm::log(step.variance)).sum()
    }

    fn innovations(&self, from: usize, readings: &[f64]) -> Vec<f64> {
        let mut state = [0.0; ALL];
        let one = |(step, reading): (&Step<N, ALL>, &f64)| {
            let off = reading - step.value(&state);
            state = step.next(state, off);
            off / step.deviation
        };
        self.steps[from..].iter().zip(readings).map(one).collect()
    }

    fn smoothed(&self, readings: &[f64]) -> Vec<f64> {
        let mut state = [0.0; ALL];
        let mut values: Vec<f64> = Vec::with_capacity(readings.len());
        for (step, reading) in self.steps.iter().zip(readings) {
            let value = step.value(&state);
            values.push(value);
            state = step.next(state, reading - value);
        }
        let mut later = [0.0; ALL];
        for ((step, reading), value) in self.steps.iter().zip(readings).zip(&mut values).rev() {
            let mut told = behind::<N, ALL>(later, step.distance);
            let off = (reading - *value - dot(&step.before, &told)) / step.variance;
            for (told, seen) in told.iter_mut().zip(step.seen) {
                *told += seen * off;
            }
            *value += dot(&step.before, &told);
            later = told;
        }
        values
    }

    fn drawn(&self, readings: &[f64], random: &mut ChaCha8Rng) -> Vec<f64> {
        let mut values = self.unread(random);
        let off = |(reading, value): (&f64, &f64)| {
            let noise: f64 = StandardNormal.sample(random);
            reading - value - self.variance.sqrt() * noise
        };
        let off: Vec<f64> = readings.iter().zip(&values).map(off).collect();
        for (value, told) in values.iter_mut().zip(self.smoothed(&off)) {
            *value += told;
        }
        values
    }
}

/// How often what changes by chance is integrated in a part of the state, and which derivative that part is.
fn place_of<const N: usize>(part: usize) -> (usize, usize) {
    if part < N { (N, part) } else { (WAVE_ORDER, (part - N) % WAVE_ORDER) }
}

/// Covariance of two parts of the state at a distance of one.
fn share_of<const N: usize>(one: usize, other: usize) -> f64 {
    let block = |part: usize| if part < N { 0 } else { 1 + (part - N) / WAVE_ORDER };
    if block(one) != block(other) {
        return 0.0;
    }
    share(place_of::<N>(one).0, place_of::<N>(one).1, place_of::<N>(other).1)
}

/// Lower triangle whose square the covariance at a distance of one is.
fn roots<const N: usize, const ALL: usize>() -> [[f64; ALL]; ALL] {
    let mut roots = [[0.0; ALL]; ALL];
    for row in 0..ALL {
        for column in 0..=row {
            let left = share_of::<N>(row, column) - dot(&roots[row], &roots[column]);
            roots[row][column] =
                if row == column { left.sqrt() } else { left / roots[column][column] };
        }
    }
    roots
}

/// By which power of the distance each part of the state grows, beside its root.
fn powers<const N: usize, const ALL: usize>(distance: f64) -> [f64; ALL] {
    std::array::from_fn(|part| {
        let (order, derivative) = place_of::<N>(part);
        (derivative + 1..order).fold(1.0, |power, _| power * distance)
    })
}

/// The state a distance on: the Taylor series of every part.
fn ahead<const N: usize, const ALL: usize>(state: [f64; ALL], distance: f64) -> [f64; ALL] {
    std::array::from_fn(|part| {
        let (order, derivative) = place_of::<N>(part);
        (part..part + order - derivative)
            .rev()
            .fold(0.0, |sum, later| state[later] + sum * distance / number(later + 1 - part))
    })
}

/// What is told of the state by what is told of it a distance on.
fn behind<const N: usize, const ALL: usize>(told: [f64; ALL], distance: f64) -> [f64; ALL] {
    std::array::from_fn(|part| {
        let first = part - place_of::<N>(part).1;
        (first..=part)
            .fold(0.0, |sum, earlier| told[earlier] + sum * distance / number(part + 1 - earlier))
    })
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;

    use super::*;
    use crate::number::mean;

    const PLACES: [f64; 4] = [0.0, 0.3, 0.4, 1.0];
    const READINGS: [f64; 4] = [0.1, -0.4, 0.9, 2.0];
    const STRENGTH: f64 = 40.0;
    const VARIANCE: f64 = 0.25;

    /// Covariance of an integral of the second order at two places, by its own integral.
    fn covariance(one: f64, other: f64) -> f64 {
        let (less, more) = (one.min(other), one.max(other));
        STRENGTH * less * less * (3.0 * more - less) / 6.0
    }

    /// The density of all readings together, by Cholesky's factor of their covariance.
    #[test]
    fn the_sweep_gives_the_density_of_all_readings_together() {
        let mut matrix = crate::banded::Banded::zeros(4, 3);
        for (row, one) in PLACES.iter().enumerate() {
            for (column, other) in PLACES[..=row].iter().enumerate() {
                matrix.add(row, column, covariance(*one, *other));
            }
            matrix.add(row, row, VARIANCE);
        }
        let factor = matrix.factor().expect("a covariance");
        let solved = factor.solve(&READINGS);
        let square: f64 = solved.iter().zip(READINGS).map(|(one, other)| one * other).sum();
        let process = Order::Second.process(STRENGTH, &PLACES, VARIANCE, None);
        let found: f64 = process.innovations(0, &READINGS).iter().map(|off| off * off).sum();
        assert!((found - square).abs() < 1e-9, "{found} {square}");
        let (found, all) = (process.log_variances(), factor.log_determinant());
        assert!((found - all).abs() < 1e-9, "{found} {all}");
        // Expected of the last value: its covariances with the readings times what was solved.
        let expected: f64 =
            PLACES.iter().zip(&solved).map(|(place, one)| covariance(*place, 1.0) * one).sum();
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let drawn: Vec<f64> = (0..4000).map(|_| process.drawn(&READINGS, &mut random)[3]).collect();
        assert!((mean(&drawn) - expected).abs() < 0.03, "{} {expected}", mean(&drawn));
    }

    /// Values that are not read have the variance of the process, whatever its order.
    #[test]
    fn what_is_drawn_has_the_variance_of_the_process() {
        for order in Order::ALL {
            let process = order.process(STRENGTH, &PLACES, 1e12, None);
            let mut random = ChaCha8Rng::seed_from_u64(2);
            let squares: Vec<f64> =
                (0..4000).map(|_| process.drawn(&READINGS, &mut random)[3].powi(2)).collect();
            let found = mean(&squares) / (STRENGTH * order.variance(1.0));
            assert!((found - 1.0).abs() < 0.1, "{order:?}: {found}");
        }
    }
}
