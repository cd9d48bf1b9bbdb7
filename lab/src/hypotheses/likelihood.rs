//! The likelihood of an effect near its best values, as it is: steps and relays have one, and no
//! slope of theirs says how wide it is.

use nalgebra::{Matrix2, Vector2};

use super::gain_at;
use crate::model::{Columns, Component, Gain, Problem, Stage, State};

/// Halvings of the interval in which the likelihood falls by one standard error.
const HALVINGS: usize = 8;

/// Doublings that look for such an interval.
const DOUBLINGS: usize = 40;

/// First step, against a value.
const FIRST: f64 = 1e-6;

/// Places either way at which a deviation is summed up, and how many of them such an interval has.
const PLACES: i16 = 160;
const IN_A_SIZE: f64 = 4.0;

/// Places either way along each of two axes at which a covariance is summed up, how many of its deviations they
/// reach, and how often it is found anew: it grows to what is there by as much as they reach.
const PLACES_OF_TWO: i16 = 12;
const REACHED: f64 = 3.0;
const ANEW: usize = 8;

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
        let first = FIRST * value.abs().max(FIRST);
        let mut high = first;
        let doubled = (0..DOUBLINGS).find(|_| {
            let there = falls(high);
            high *= if there { 1.0 } else { 2.0 };
            there
        });
        doubled?;
        let mut low = if high <= first { 0.0 } else { 0.5 * high };
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            *(if falls(middle) { &mut high } else { &mut low }) = middle;
        }
        Some(high)
    }

    /// Standard deviation of a nonlinear value about its best, each value of its range as probable as it
    /// makes the data: a play of less than nothing would be as good as its mirror image.
    #[must_use]
    pub(crate) fn deviation(&self, place: usize) -> Option<f64> {
        let step = self.size(place)? / IN_A_SIZE;
        let term = &self.component.term;
        let range = &term.parameters[*term.nonlinear_indices().get(place)?].range;
        let value = term.nonlinear()[place];
        let is_free = range.end() <= range.start();
        let is_open = |by: &f64| is_free || range.contains(&(value + by)) || *by == 0.0;
        let moves = (-PLACES..=PLACES).map(|number| f64::from(number) * step).filter(is_open);
        let (all, square) = moves.fold((0.0, 0.0), |(all, square), by| {
            let weight = libm::exp(-0.5 * self.loss(&[(place, by)]));
            (all + weight, square + weight * by * by)
        });
        Some((square / all).sqrt())
    }

    /// Covariance of the only two nonlinear values about their best, each pair as probable as it makes the data.
    ///
    /// Where a shape has edges, the likelihood is a heap of small plateaus, and how wide the highest of them is tells
    /// nothing of how far the others lie.
    #[must_use]
    pub(crate) fn covariance_of_two(&self) -> Option<Matrix2<f64>> {
        let held = Vector2::new(self.size(0)?, self.size(1)?);
        let mut covariance = Matrix2::from_diagonal(&held.map(|size| size * size));
        for _ in 0..ANEW {
            covariance = self.covariance_along(&(REACHED * covariance.cholesky()?.l()));
        }
        Some(covariance)
    }

    /// The same, summed up over places along two axes.
    fn covariance_along(&self, axes: &Matrix2<f64>) -> Matrix2<f64> {
        let at = |number: i16| f64::from(number) / f64::from(PLACES_OF_TWO);
        let all = || (-PLACES_OF_TWO..=PLACES_OF_TWO).map(at);
        let moves = all().flat_map(|one| all().map(move |other| axes * Vector2::new(one, other)));
        let (all, square) = moves.fold((0.0, Matrix2::zeros()), |(all, square), by| {
            let weight = libm::exp(-0.5 * self.loss(&[(0, by[0]), (1, by[1])]));
            (all + weight, square + weight * by * by.transpose())
        });
        square / all
    }
}
