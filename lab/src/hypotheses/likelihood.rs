//! The likelihood of an effect near its best values, as it is: steps and relays have one, and no
//! slope of theirs says how wide it is.

use nalgebra::{Matrix2, Vector2};

use super::gain_at;
use crate::model::{Columns, Component, Gain, Problem, Stage, State};

/// Halvings of the interval in which the likelihood falls by one standard error.
const HALVINGS: usize = 8;

/// Doublings that look for such an interval.
const DOUBLINGS: i32 = 40;

/// Share of a gain that is rounding.
const NOTHING: f64 = 1e-9;

/// First step, against a value.
const FIRST: f64 = 1e-6;

/// Places either way at which a deviation is summed up, and how many of them such an interval has.
const PLACES: i16 = 160;
const IN_A_SIZE: f64 = 4.0;

/// Places either way along each of two axes at which a covariance is summed up, how many of its deviations they
/// reach, and how often it is found anew: it grows to what is there by as much as they reach.
const PLACES_OF_TWO: i16 = 5;
const REACHED: f64 = 3.0;
const ANEW: usize = 5;

/// The likelihood of a component near its best, the others of its model free to give way.
pub(crate) struct Likelihood<'a> {
    before: Stage<'a>,
    component: &'a Component,
    /// The fit at its best.
    pub(crate) best: Gain,
}

impl<'a> Likelihood<'a> {
    /// That of one component of a model; `None` when its columns cannot be made.
    #[must_use]
    pub(crate) fn of(problem: &'a Problem, state: &'a State, index: usize) -> Option<Self> {
        let others = Columns::of_model(problem, &state.without(&[index])).ok()?;
        let before = Stage::new(problem, &others, &state.fit.noises);
        let component = &state.components[index];
        let best = gain_at(&before, component)?;
        Some(Self { before, component, best })
    }

    /// The fit with some nonlinear values moved.
    #[must_use]
    pub(crate) fn moved(&self, moves: &[(usize, f64)]) -> Option<Gain> {
        let mut values = self.component.term.nonlinear();
        for (place, by) in moves {
            values[*place] += by;
        }
        let term = self.component.term.with_nonlinear(&values);
        gain_at(&self.before, &Component { term, ..self.component.clone() })
    }

    /// What twice the log likelihood loses by a move.
    #[must_use]
    pub(crate) fn loss(&self, moves: &[(usize, f64)]) -> f64 {
        self.moved(moves).map_or(f64::INFINITY, |gain| self.best.gain - gain.gain)
    }

    /// How far a nonlinear value lies from the middle of where it may be with nothing lost, as a step anywhere between
    /// two samples may.
    #[must_use]
    pub(crate) fn to_the_middle(&self, place: usize) -> f64 {
        let [up, down] = [1.0, -1.0].map(|way| self.free(place, way));
        0.5 * (up - down)
    }

    /// How far it may go one way; 0 where it never ends.
    fn free(&self, place: usize, way: f64) -> f64 {
        let is_free = |by: f64| self.loss(&[(place, way * by)]) <= NOTHING * self.best.gain;
        let values = self.component.term.nonlinear();
        let first = values.get(place).map_or(FIRST, |value| first_step(*value));
        let ends = |by: f64| !is_free(by);
        bracket(first, ends).map_or(0.0, |[low, _]| if low < first { 0.0 } else { low })
    }

    /// How far a nonlinear value goes either way before twice the log likelihood falls by 1, the
    /// others held; `None` when it never does.
    #[must_use]
    pub(crate) fn size(&self, place: usize) -> Option<f64> {
        // A step moves freely as far as the next sample one way, and not at all the other.
        let both_ways = |up: f64, down: f64| up.min(down);
        let on_the_whole = |up: f64, down: f64| 0.5 * (up + down);
        self.falling(place, both_ways).or_else(|| self.falling(place, on_the_whole))
    }

    /// The same, where the two ways together lose so much.
    fn falling(&self, place: usize, of: impl Fn(f64, f64) -> f64) -> Option<f64> {
        let value = *self.component.term.nonlinear().get(place)?;
        let falls = |by: f64| 1.0 <= of(self.loss(&[(place, by)]), self.loss(&[(place, -by)]));
        bracket(first_step(value), falls).map(|[_, high]| high)
    }

    /// Standard deviation of a nonlinear value about its best, each value of its range as probable as it
    /// makes the data: a play of less than nothing would be as good as its mirror image.
    #[must_use]
    pub(crate) fn deviation(&self, place: usize) -> Option<f64> {
        Some(self.summed_up(&self.along(place)?).nonlinear[place])
    }

    /// Standard deviations about the best of one or two nonlinear values and of the sizes beside them, each place as
    /// probable as it makes the data; `None` of other numbers, and where nothing holds a value.
    ///
    /// Where a shape has edges, the likelihood is a heap of small plateaus, and how wide the highest of them is tells
    /// nothing of how far the others lie.
    #[must_use]
    pub(crate) fn deviations(&self) -> Option<Deviations> {
        let places = match self.component.term.nonlinear().len() {
            1 => self.along(0)?,
            2 => self.about_two()?,
            _ => return None,
        };
        Some(self.summed_up(&places))
    }

    /// Places along one nonlinear value, within its range.
    fn along(&self, place: usize) -> Option<Vec<Moves>> {
        let step = self.size(place)? / IN_A_SIZE;
        let term = &self.component.term;
        let range = &term.parameters[*term.nonlinear_indices().get(place)?].range;
        let value = term.nonlinear()[place];
        let is_free = range.end() <= range.start();
        let is_open = |by: &f64| is_free || range.contains(&(value + by)) || *by == 0.0;
        let moves = (-PLACES..=PLACES).map(|number| f64::from(number) * step).filter(is_open);
        Some(moves.map(|by| vec![(place, by)]).collect())
    }

    /// Places about two nonlinear values, along the axes of their covariance.
    fn about_two(&self) -> Option<Vec<Moves>> {
        let held = Vector2::new(self.size(0)?, self.size(1)?);
        let mut places = places_along(&Matrix2::from_diagonal(&(REACHED * held)));
        for _ in 0..ANEW {
            let covariance = self.summed_up(&places).covariance_of_two()?;
            places = places_along(&(REACHED * covariance.cholesky()?.l()));
        }
        Some(places)
    }

    fn summed_up(&self, places: &[Moves]) -> Deviations {
        let best = &self.best.fit;
        let mut all = Deviations {
            nonlinear: vec![0.0; self.component.term.nonlinear().len()],
            together: 0.0,
            linear: vec![0.0; best.coefficients.len()],
        };
        let mut weights = 0.0;
        for moves in places {
            let Some(there) = self.moved(moves) else { continue };
            let weight = libm::exp(-0.5 * (self.best.gain - there.gain));
            weights += weight;
            for (place, by) in moves {
                all.nonlinear[*place] += weight * by * by;
            }
            if let [(_, one), (_, other)] = moves[..] {
                all.together += weight * one * other;
            }
            for (index, square) in all.linear.iter_mut().enumerate() {
                let off = there.fit.coefficients[index] - best.coefficients[index];
                *square += weight * (there.fit.covariance[(index, index)] + off * off);
            }
        }
        let deviation = |square: &mut f64| *square = (*square / weights).sqrt();
        all.nonlinear.iter_mut().chain(&mut all.linear).for_each(deviation);
        all.together /= weights;
        all
    }
}

/// The first step that is tried from a value.
fn first_step(value: f64) -> f64 {
    FIRST * value.abs().max(FIRST)
}

/// The interval in which something begins to hold, looked for from a first step on; `None` when it never does.
fn bracket(first: f64, holds: impl Fn(f64) -> bool) -> Option<[f64; 2]> {
    let doubled = (0..DOUBLINGS).find(|doubled| holds(libm::ldexp(first, *doubled)))?;
    let mut high = libm::ldexp(first, doubled);
    let mut low = if doubled == 0 { 0.0 } else { 0.5 * high };
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        *(if holds(middle) { &mut high } else { &mut low }) = middle;
    }
    Some([low, high])
}

/// By how much some nonlinear values are moved.
type Moves = Vec<(usize, f64)>;

/// Standard deviations about the best.
pub(crate) struct Deviations {
    pub(crate) nonlinear: Vec<f64>,
    /// Covariance of two nonlinear values.
    together: f64,
    /// Of the sizes.
    pub(crate) linear: Vec<f64>,
}

impl Deviations {
    fn covariance_of_two(&self) -> Option<Matrix2<f64>> {
        let [one, other] = *self.nonlinear.as_slice() else { return None };
        Some(Matrix2::new(one * one, self.together, self.together, other * other))
    }
}

/// Places about two values, evenly along two axes.
fn places_along(axes: &Matrix2<f64>) -> Vec<Moves> {
    let at = |number: i16| f64::from(number) / f64::from(PLACES_OF_TWO);
    let all = || (-PLACES_OF_TWO..=PLACES_OF_TWO).map(at);
    let by = |one, other| axes * Vector2::new(one, other);
    all()
        .flat_map(|one| all().map(move |other| by(one, other)))
        .map(|by| vec![(0, by[0]), (1, by[1])])
        .collect()
}
