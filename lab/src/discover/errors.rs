//! Standard errors of a formula's parameters from the likelihood itself, which steps and relays
//! have and slopes of theirs have not.

use crate::hypotheses::gain_at;
use crate::model::{Columns, Component, Gain, Problem, Stage, State};

/// Halvings of the interval in which the likelihood falls by one standard error.
const HALVINGS: usize = 8;

/// Doublings that look for such an interval.
const DOUBLINGS: usize = 40;

/// First step, against a value.
const FIRST: f64 = 1e-6;

/// Strongest correlation of two parameters that is told from a full one.
const STRONGEST: f64 = 0.9995;

/// Standard error of every parameter of a component, in their order; `None` where the data do not
/// hold it.
#[must_use]
pub(super) fn errors(problem: &Problem, state: &State, index: usize) -> Vec<Option<f64>> {
    let component = &state.components[index];
    let mut others = state.components.clone();
    others.remove(index);
    let Ok(base) = Columns::of_model(problem, &others) else { return Vec::new() };
    let before = Stage::new(problem, &base, &state.fit.noises);
    let Some(best) = gain_at(&before, component) else { return Vec::new() };
    let likelihood = Likelihood { stage: before, component, best };
    let sizes = likelihood.sizes();
    let nonlinear = likelihood.correlated(&sizes);
    let linear = likelihood.linear(&sizes, &nonlinear);
    let (mut linear, mut sizes) = (linear.into_iter(), sizes.into_iter());
    let parameters = component.term.parameters.iter();
    let mut place = 0;
    let mut of_next = |is_nonlinear: bool| {
        if !is_nonlinear {
            return linear.next();
        }
        let size = sizes.next().flatten()?;
        place += 1;
        Some(size * nonlinear[place - 1][place - 1].max(0.0).sqrt())
    };
    parameters.map(|what| of_next(what.is_nonlinear())).collect()
}

/// The likelihood of a component near its best.
struct Likelihood<'a> {
    stage: Stage<'a>,
    component: &'a Component,
    best: Gain,
}

impl Likelihood<'_> {
    /// The fit with some nonlinear values moved.
    fn moved(&self, moves: &[(usize, f64)]) -> Option<Gain> {
        let mut values = self.component.term.nonlinear();
        for (place, by) in moves {
            values[*place] += by;
        }
        let term = self.component.term.with_nonlinear(&values);
        gain_at(&self.stage, &Component { term, ..self.component.clone() })
    }

    fn loss(&self, moves: &[(usize, f64)]) -> f64 {
        self.moved(moves).map_or(f64::INFINITY, |gain| self.best.gain - gain.gain)
    }

    /// Per nonlinear value: how far it goes either way before twice the log likelihood falls by 1,
    /// the others held; `None` when it never does.
    fn sizes(&self) -> Vec<Option<f64>> {
        let values = self.component.term.nonlinear();
        let size = |(place, value): (usize, &f64)| {
            let falls =
                |by: f64| 1.0 <= 0.5 * (self.loss(&[(place, by)]) + self.loss(&[(place, -by)]));
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
        };
        values.iter().enumerate().map(size).collect()
    }

    /// Covariance of the nonlinear values in units of those sizes.
    fn correlated(&self, sizes: &[Option<f64>]) -> Vec<Vec<f64>> {
        let held: Vec<(usize, f64)> =
            sizes.iter().enumerate().filter_map(|(i, size)| size.map(|size| (i, size))).collect();
        let mut curvature = nalgebra::DMatrix::identity(held.len(), held.len());
        for row in 0..held.len() {
            for column in 0..row {
                let ((i, a), (j, b)) = (held[row], held[column]);
                let at = |x: f64, y: f64| self.loss(&[(i, 0.5 * x * a), (j, 0.5 * y * b)]);
                let mixed = at(1.0, 1.0) + at(-1.0, -1.0) - at(1.0, -1.0) - at(-1.0, 1.0);
                let mixed = if mixed.is_finite() { 0.5 * mixed } else { 0.0 };
                curvature[(row, column)] = mixed.clamp(-STRONGEST, STRONGEST);
                curvature[(column, row)] = curvature[(row, column)];
            }
        }
        let inverse = curvature.try_inverse();
        let one = |row: usize, column: usize| f64::from(u8::from(row == column));
        let of = |row, column| match &inverse {
            // The error with the others held is the least it can be.
            Some(inverse) if row == column => inverse[(row, column)].max(1.0),
            Some(inverse) => inverse[(row, column)],
            None => one(row, column),
        };
        (0..held.len()).map(|row| (0..held.len()).map(|column| of(row, column)).collect()).collect()
    }

    /// Standard errors of the coefficients, the nonlinear values free.
    fn linear(&self, sizes: &[Option<f64>], nonlinear: &[Vec<f64>]) -> Vec<f64> {
        let held = sizes.iter().enumerate().filter_map(|(i, size)| size.map(|size| (i, size)));
        let slopes: Vec<Vec<f64>> = held
            .map(|(place, size)| {
                let of = |by: f64| self.moved(&[(place, by)]).map(|gain| gain.fit.coefficients);
                let (up, down) = (of(size), of(-size));
                let pairs = up.iter().flatten().zip(down.iter().flatten());
                pairs.map(|(up, down)| 0.5 * (up - down)).collect()
            })
            .collect();
        let fixed = &self.best.fit.covariance;
        let of = |column: usize| {
            let slope = |place: usize| slopes[place].get(column).copied().unwrap_or_default();
            let moved: f64 = (0..slopes.len())
                .flat_map(|a| (0..slopes.len()).map(move |b| (a, b)))
                .map(|(a, b)| slope(a) * nonlinear[a][b] * slope(b))
                .sum();
            (fixed[(column, column)] + moved.max(0.0)).max(0.0).sqrt()
        };
        (0..self.best.fit.coefficients.len()).map(of).collect()
    }
}
