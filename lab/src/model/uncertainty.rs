//! Standard errors of all parameters together, linear and nonlinear.

use helixlock_plant::Column;
use nalgebra::DMatrix;

use super::columns::Columns;
use super::component::{Component, shown_um};
use super::problem::Problem;
use super::state::State;
use super::{left_out, unsure};
use crate::noise::{Noise, Whitener};
use crate::numerics::least_squares;

/// Covariance of a joint fit under its noise.
#[derive(Debug, Clone)]
pub(crate) struct JointCovariance {
    /// Of the stacked linear coefficients, nonlinear parameters free.
    pub(crate) linear: DMatrix<f64>,
    /// Per component and nonlinear parameter: the standard error, `None` for one from a list.
    pub(crate) nonlinear: Vec<Vec<Option<f64>>>,
}

/// Linearises the model about its fit (Gauss–Newton): a column a coefficient and one a
/// continuous nonlinear parameter, whose derivative is taken by a central difference.
#[must_use]
pub(crate) fn joint_covariance(problem: &Problem, state: &State) -> JointCovariance {
    let linearised = Linearised::of(problem, state);
    linearised.parted(state, &linearised.under_fitted(problem, state))
}

/// Two covariances as they are told: of the values in use; and where a value that was left at 0 for want
/// of evidence may be another one. Both with what is not known of the noise.
#[must_use]
pub(crate) fn told_covariances(problem: &Problem, state: &State) -> [JointCovariance; 2] {
    let linearised = Linearised::of(problem, state);
    let of_used = linearised.under_any(problem, state);
    let of_all = if state.components.iter().any(Component::leaves_out) {
        widened(&of_used, &left_out::widening(problem, state, &linearised.columns))
    } else {
        of_used.clone()
    };
    [of_used, of_all].map(|covariance| linearised.parted(state, &covariance))
}

/// A model's columns, and how it changes with its nonlinear values.
struct Linearised {
    /// Those of the model, a slope each, and others.
    columns: Columns,
    slopes: Vec<Slope>,
    /// Number of the model's own.
    linear_width: usize,
}

impl Linearised {
    fn of(problem: &Problem, state: &State) -> Self {
        let mut columns = state.columns.clone();
        columns.fixed = None;
        let linear_width = columns.raw.len();
        let slopes = slopes(problem, state);
        let raw = slopes.iter().map(|slope| slope.column.clone());
        Self { columns: columns.and(&Columns::free(raw)), slopes, linear_width }
    }

    /// Covariance of all coefficients under the fitted noise.
    fn under_fitted(&self, problem: &Problem, state: &State) -> DMatrix<f64> {
        covariance(problem, &self.columns, &state.fit.noises)
    }

    /// The same with what is not known of the noise.
    fn under_any(&self, problem: &Problem, state: &State) -> DMatrix<f64> {
        let fitted = self.under_fitted(problem, state);
        if state.components.is_empty() {
            return fitted;
        }
        widened(&fitted, &unsure::widening(problem, state, &self.columns))
    }

    /// A covariance of all coefficients as that of the linear ones and errors of the others.
    fn parted(&self, state: &State, covariance: &DMatrix<f64>) -> JointCovariance {
        let of = |component: &Component| vec![None; component.term.nonlinear_indices().len()];
        let mut nonlinear: Vec<Vec<Option<f64>>> = state.components.iter().map(of).collect();
        for (offset, slope) in self.slopes.iter().enumerate() {
            let at = self.linear_width + offset;
            nonlinear[slope.component][slope.place] = Some(covariance[(at, at)].max(0.0).sqrt());
        }
        let own = (self.linear_width, self.linear_width);
        JointCovariance { linear: covariance.view((0, 0), own).into_owned(), nonlinear }
    }
}

/// A covariance whose standard errors are so many times as large.
fn widened(covariance: &DMatrix<f64>, by: &[f64]) -> DMatrix<f64> {
    DMatrix::from_fn(covariance.nrows(), covariance.ncols(), |i, j| {
        by[i] * covariance[(i, j)] * by[j]
    })
}

fn covariance(problem: &Problem, columns: &Columns, noises: &[Noise]) -> DMatrix<f64> {
    if columns.raw.is_empty() {
        return DMatrix::zeros(0, 0);
    }
    let white = columns.whitened(&Whitener::new(&problem.layout, noises));
    let views: Vec<&[f64]> = white.iter().map(Vec::as_slice).collect();
    let nothing = vec![0.0; white.first().map_or(0, Vec::len)];
    least_squares::fit(&views, &nothing).covariance
}

/// How the fitted model changes with one nonlinear value.
#[derive(Debug)]
pub(crate) struct Slope {
    /// Index of the component.
    pub(crate) component: usize,
    /// Which of its nonlinear values.
    pub(crate) place: usize,
    /// Change of the model a unit of the value, row by row.
    pub(crate) column: Column,
}

/// A slope for every continuous nonlinear value of a model that shows in the data.
#[must_use]
pub(crate) fn slopes(problem: &Problem, state: &State) -> Vec<Slope> {
    let mut slopes = Vec::new();
    for (index, component) in state.components.iter().enumerate() {
        for place in 0..component.term.nonlinear_indices().len() {
            if let Some(column) = slope(problem, state, index, component, place) {
                slopes.push(Slope { component: index, place, column: column.into() });
            }
        }
    }
    slopes
}

/// Change of a component's fitted pattern with one nonlinear parameter; `None` for a parameter
/// that only takes listed values.
fn slope(
    problem: &Problem,
    state: &State,
    index: usize,
    component: &Component,
    place: usize,
) -> Option<Vec<f64>> {
    let parameter = &component.term.parameters[component.term.nonlinear_indices()[place]];
    if parameter.is_listed() {
        return None;
    }
    let value = component.term.nonlinear()[place];
    let range = parameter.range.end() - parameter.range.start();
    let step = 1e-4 * if value == 0.0 { range.abs() } else { value.abs() };
    let at = |value| shown_with(problem, state, index, component.with_value(place, value));
    let (up, down) = (at(value + step)?, at(value - step)?);
    let slope: Vec<f64> = up.iter().zip(&down).map(|(a, b)| (a - b) / (2.0 * step)).collect();
    slope.iter().any(|value| *value != 0.0).then_some(slope)
}

/// What a component shows at its fitted sizes and other values; with what it makes of the others if
/// it delays them.
fn shown_with(
    problem: &Problem,
    state: &State,
    index: usize,
    changed: Component,
) -> Option<Vec<f64>> {
    if !changed.term.nature().delays {
        return changed.shown_um(problem, state.coefficients(index).0);
    }
    let mut all = state.components.clone();
    all[index] = changed;
    let width = all.iter().map(Component::width).sum();
    shown_um(problem, &all, &state.fit.linear.coefficients[..width])
}
