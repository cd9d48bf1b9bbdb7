//! Whether the data hold a formula that was granted: its sizes against their errors, and against what
//! least squares make of it.

use helixlock_plant::Role;

use super::errors::errors;
use crate::model::{Columns, Problem, State, with_noise};
use crate::noise::weighed_rms;
use crate::policy::chance::STANDARD_ERRORS;
use crate::policy::size::LEAST_TAKEN;
use crate::search::plain_noises;

/// True for a component of which a size is beyond its error, and which takes its share.
#[must_use]
pub(super) fn is_held(problem: &Problem, state: &State, index: usize) -> bool {
    has_a_size(problem, state, index) && takes_its_share(problem, state, index)
}

/// True unless every size of a component is lost in its error, as where the samples meet a wave always
/// at the same two phases.
fn has_a_size(problem: &Problem, state: &State, index: usize) -> bool {
    let term = state.components[index].valued(state.coefficients(index).0);
    let sizes = term.parameters.iter().zip(&term.values).zip(errors(problem, state, index));
    let mut sizes =
        sizes.filter(|((what, _), _)| matches!(what.role, Role::Linear | Role::Amplitude));
    sizes.any(|((_, value), stderr)| {
        stderr.is_some_and(|stderr| STANDARD_ERRORS * stderr < value.abs())
    })
}

/// True where the sizes of a component take most of what its columns take by least squares.
///
/// Slow noise leaves a fit little but the changes from row to row. Where these are of another size or sign
/// than the curve itself, it is another curve, and its size far from any that explains the data.
#[must_use]
pub(super) fn takes_its_share(problem: &Problem, state: &State, index: usize) -> bool {
    let (sizes, from) = state.coefficients(index);
    let raw = &state.columns.raw[from..from + sizes.len()];
    let own = Columns::free(raw.iter().cloned());
    let undone: Vec<f64> = sizes.iter().map(|size| -size).collect();
    let without = own.left(&state.fit.left, &undone);
    let noises = plain_noises(problem, &state.fit);
    let least = with_noise(&problem.layout, &own, &without, &noises).left;
    let [all, least, left] = [&without, &least, &state.fit.left]
        .map(|left| weighed_rms(&problem.layout, left))
        .map(|rms_um| rms_um * rms_um);
    LEAST_TAKEN * (all - least) <= all - left
}
