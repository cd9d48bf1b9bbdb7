//! Nonlinear values found on means of neighbouring samples, fitted once more to all rows.

use crate::model::{Columns, Component, Problem, State, slopes};
use crate::noise::Whitener;
use crate::numerics::least_squares;

/// Steps of Gauss and Newton; the means have come near already.
const STEPS: usize = 3;

/// Log likelihood that a step must gain for another one to be worth it.
const GAIN: f64 = 0.01;

/// The same effects with the nonlinear values that all rows like best.
#[must_use]
pub(crate) fn polished(problem: &Problem, state: State) -> State {
    let mut best = state;
    for _ in 0..STEPS {
        let Some(next) = stepped(problem, &best) else { break };
        let gained = next.fit.log_likelihood - best.fit.log_likelihood;
        if gained <= 0.0 {
            break;
        }
        best = next;
        if gained < GAIN {
            break;
        }
    }
    best
}

/// One step of Gauss and Newton; `None` when no value is free to move.
fn stepped(problem: &Problem, state: &State) -> Option<State> {
    let slopes = slopes(problem, state);
    if slopes.is_empty() {
        return None;
    }
    let mut components = state.components.clone();
    let raw = slopes.iter().map(|slope| slope.column.clone());
    let columns = state.columns.and(&Columns::free(raw));
    let whitener = Whitener::new(&problem.layout, &state.fit.noises);
    let white = columns.whitened(&whitener);
    let views: Vec<&[f64]> = white.iter().map(Vec::as_slice).collect();
    let moves = least_squares::fit(&views, &columns.target(&whitener, &problem.residual()));
    let width = state.columns.raw.len();
    for (slope, by) in slopes.iter().zip(&moves.coefficients[width..]) {
        let component = &mut components[slope.component];
        *component = component.with_value(slope.place, moved(component, slope.place, *by));
    }
    State::of(problem, components, &state.fit.noises)
}

/// A nonlinear value moved, within its range.
fn moved(component: &Component, place: usize, by: f64) -> f64 {
    let value = component.term.nonlinear()[place] + by;
    let range = &component.term.parameters[component.term.nonlinear_indices()[place]].range;
    if range.start() < range.end() { value.clamp(*range.start(), *range.end()) } else { value }
}
