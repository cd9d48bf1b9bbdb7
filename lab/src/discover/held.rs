//! Whether the data hold a formula that was granted: its sizes against their errors, and against what
//! least squares make of it.

use super::errors::errors;
use crate::formulas::Shape;
use crate::model::{Columns, Problem, State, plain_noises, with_noise};
use crate::noise::weighed_rms;
use crate::policy::chance::STANDARD_ERRORS;
use crate::policy::size::LEAST_TAKEN;

/// The part of a shape whose size is lost most in its error, as where the samples meet a wave always at the same
/// two phases; `None` where every size is beyond its own.
#[must_use]
pub(super) fn lost_part(
    problem: &Problem,
    state: &State,
    index: usize,
    shape: &Shape,
) -> Option<usize> {
    let values = state.components[index].valued(state.coefficients(index).0).values;
    let errors = errors(problem, state, index);
    let in_errors = |part: usize| {
        let place = shape.numbers_of(part).start;
        let stderr = errors.get(place).copied().flatten();
        stderr.map_or(0.0, |stderr| values[place].abs() / stderr)
    };
    let all = (0..shape.parts.len()).map(|part| (part, in_errors(part)));
    let least = all.min_by(|a, b| a.1.total_cmp(&b.1));
    least.filter(|(_, size)| *size <= STANDARD_ERRORS).map(|(part, _)| part)
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
    let noises = plain_noises(problem, &state.fit.left);
    let least = with_noise(&problem.layout, &own, &without, &noises).left;
    let [all, least, left] = [&without, &least, &state.fit.left]
        .map(|left| weighed_rms(&problem.layout, left))
        .map(|rms_um| rms_um * rms_um);
    LEAST_TAKEN * (all - least) <= all - left
}
