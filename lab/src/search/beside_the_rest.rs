//! Names that do not stand beside what nobody explains.
//!
//! Where structure is left, an effect may have taken a part of it: a drift of the laser a part of a
//! curve that is another one in each pass, wear one of several humps. So every structure that
//! columns draw is put beside the model in any size, and an effect that is not worth its price then,
//! or counts no whole number, is not told from it, unless what is left is hardly anything beside it. Nor is
//! one that is smaller than such a structure and has for most part its shape: what made the larger may have
//! made it all. A line is no such structure: beside an effect of the same frequency it is that effect's own
//! swelling. Nor is a shape beside a wave that is larger: it is the others of its harmonics.
//!
//! Whatever is left, the noise was fitted to it too, and is no judge of something faint: that keeps no name.

use std::collections::BTreeSet;

use super::analysis::Step;
use super::own_errors::paid;
use super::pruning::no_counts;
use super::span::{Span, shown};
use crate::hypotheses::Structure;
use crate::model::{Columns, Problem, State};
use crate::noise::rms;
use crate::numerics::{chi_squared_tail, in_parallel};
use crate::policy::evidence::{BESIDE_THE_REST, OWN_SHAPE};
use crate::policy::size::SHARE_OF_AN_EFFECT;

/// Places of the effects of a model that something left of it explains as well.
#[must_use]
pub(crate) fn not_told(problem: &Problem, steps: &[Step], left: &[Structure]) -> Vec<usize> {
    let state = &steps[steps.len() - 1].state;
    if state.components.is_empty() || left.is_empty() {
        return Vec::new();
    }
    let is_drawn = |one: &&Structure| one.line.is_none() && !one.drawn_by.is_empty();
    let rests: Vec<&Structure> = left.iter().filter(is_drawn).collect();
    let prices: Vec<f64> =
        (0..state.components.len()).map(|index| paid(problem, state, steps, index)).collect();
    let size = |index| shown(problem, state, index).map_or(0.0, |all| rms(&problem.layout, &all));
    let share = |index: usize| {
        if state.components[index].term.is_wave() { 1.0 } else { SHARE_OF_AN_EFFECT }
    };
    let least_um: Vec<f64> =
        (0..state.components.len()).map(|index| share(index) * size(index)).collect();
    let beside = |rest: &&Structure| {
        let columns = Columns::free(rest.drawn_by.iter().cloned());
        let mut places = not_told_beside(&problem.beside(&columns), state, &prices);
        places.retain(|index| least_um[*index] < rest.rms_um);
        places.extend(parts(problem, state, rest));
        places
    };
    let beaten: BTreeSet<usize> = in_parallel(&rests, beside).into_iter().flatten().collect();
    let is_faint =
        |index: &usize| gain(problem, state, *index).is_some_and(|gain| gain < BESIDE_THE_REST);
    (0..state.components.len()).filter(|index| beaten.contains(index) || is_faint(index)).collect()
}

/// What an effect takes out of twice the log likelihood.
pub(super) fn gain(problem: &Problem, state: &State, index: usize) -> Option<f64> {
    let fewer = State::of(problem, state.without(&[index]), &state.fit.noises)?;
    Some(2.0 * (state.fit.log_likelihood - fewer.fit.log_likelihood))
}

/// What an effect shows that is not told from what is left, beyond chance in what it is taken out of.
#[must_use]
pub(crate) fn untold(problem: &Problem, state: &State, index: usize) -> Option<Structure> {
    let component = &state.components[index];
    let size_um = component.size_um(problem, state.coefficients(index).0);
    let shape =
        format!("a curve like that of {}, not told from what else is left", component.term.name);
    let chance = chi_squared_tail(gain(problem, state, index)?, component.freedom());
    Some(Structure::without_place("travel and time", &shape, size_um, chance))
}

/// Places of the effects that are not worth their price on a problem that more is free on, or count
/// no whole number there.
pub(super) fn not_told_beside(problem: &Problem, state: &State, prices: &[f64]) -> Vec<usize> {
    let noises = &state.fit.noises;
    let Some(all) = State::of(problem, state.components.clone(), noises) else { return Vec::new() };
    let is_worth_it = |index: usize| {
        State::of(problem, state.without(&[index]), &all.fit.noises).is_none_or(|fewer| {
            prices[index] < 2.0 * (all.fit.log_likelihood - fewer.fit.log_likelihood)
        })
    };
    let worthless = (0..prices.len()).filter(|index| !is_worth_it(*index));
    worthless.chain(no_counts(problem, &all).into_iter().map(|(index, _)| index)).collect()
}

/// Places of the effects that are smaller than something left and have for most part its shape.
fn parts(problem: &Problem, state: &State, rest: &Structure) -> Vec<usize> {
    let span = Span::of(problem, &rest.drawn_by);
    let is_part = |index: &usize| {
        let Some(shown) = shown(problem, state, *index) else { return false };
        rms(&problem.layout, &shown) < rest.rms_um && span.has(&shown, OWN_SHAPE)
    };
    (0..state.components.len()).filter(is_part).collect()
}
