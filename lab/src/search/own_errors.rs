//! Own errors of targets in the place of effects.
//!
//! A scale or a rack has at each target an error of its own, which every visit repeats. At few
//! targets such errors are followed by a curve or a wave more often than noise is; so they stand
//! before the same judge as one hypothesis with one free number, their common size.

use std::slice;

use super::analysis::Step;
use super::court::{Price, groups};
use super::refusal::Refusal;
use crate::hypotheses::{Structure, at_targets, is_left};
use crate::model::{Columns, Component, Fit, Judged, Problem, Stage, State, settle};
use crate::noise::Noise;
use crate::numerics::least_squares::dot;
use crate::numerics::{chi_squared_tail, count, drawn_sizes_gain};
use crate::policy::chance::NAMED;
use crate::policy::evidence::MARGIN;

/// What targets show and a model of a search on few rows does not explain; of means, nothing.
#[must_use]
pub(crate) fn left_at_targets(
    problem: &Problem,
    small: &Problem,
    state: &State,
    shown: impl Fn(&Problem, &Columns, &Fit) -> Option<Structure>,
) -> Option<Structure> {
    if !small.has_rows_of(problem) {
        return None;
    }
    shown(small, &state.columns, &state.fit).filter(|told| is_left(small, &state.fit, told))
}

/// What targets show at every visit, where it explains as much as the effects of a model in whose
/// place it stands, or nearly so: then it cannot be known whether there are any.
#[must_use]
pub(crate) fn own_errors(problem: &Problem, steps: &[Step]) -> Option<Structure> {
    let state = &steps[steps.len() - 1].state;
    in_place_of(problem, state, |index| paid_at_targets(problem, state, steps, index))
}

/// The same, of components that have paid so much each.
#[must_use]
pub(crate) fn in_place_of(
    problem: &Problem,
    state: &State,
    paid: impl Fn(usize) -> f64,
) -> Option<Structure> {
    let targets = Columns::free(problem.columns_of_targets());
    if targets.raw.is_empty() {
        return None;
    }
    let rivalled = groups(state.components.len()).into_iter().filter(|group| !group.is_empty());
    let bare = rivalled.filter_map(|group| {
        let others = State::of(problem, state.without(&group), &state.fit.noises)?;
        let saved: f64 = group.iter().map(|&index| paid(index)).sum();
        let ahead = 2.0 * (log_likelihood(problem, &others, &targets) - state.fit.log_likelihood)
            - problem.price_of_a_number()
            + saved;
        (-MARGIN < ahead).then_some(others)
    });
    bare.filter_map(|others| at_targets(problem, &others.columns, &others.fit))
        .min_by(|a, b| a.p_value.total_cmp(&b.p_value))
}

/// Refused where the targets' own errors each way, of one law, show by chance what an effect does: a reversal that is
/// alike at all is told by how much they scatter, and not by how well visits agree.
#[must_use]
pub(crate) fn scatters_as_targets(
    problem: &Problem,
    now: &State,
    judged: &Judged,
) -> Option<Refusal> {
    if !problem.are_ways_free() {
        return None;
    }
    let ways = problem.free_ways();
    let own = Columns::of(problem, slice::from_ref(&judged.component)).ok()?;
    let others = problem.without_ways(&now.columns);
    let stage = Stage::new(problem, &others, &judged.fit.noises);
    let gain = 2.0 * (stage.with_sizes_of_and(&ways, &own) - stage.with_sizes_of(&ways));
    let chance = chi_squared_tail(gain, judged.component.freedom());
    let p_value = (chance * judged.looks.max(1.0) * judged.tried).min(1.0);
    (NAMED <= p_value).then_some(Refusal::Scatter { p_value })
}

/// What an effect of a model pays against errors of targets: its sizes are of one law, as theirs are, and a place or a
/// width that fits them has been chosen among as many as a size.
fn paid_at_targets(problem: &Problem, state: &State, steps: &[Step], index: usize) -> f64 {
    let component = &state.components[index];
    let looks = looks(steps, component);
    let whole = Price::of(problem, component, looks).whole();
    let others = Columns::of_model(problem, &state.without(&[index]));
    let own = Columns::of_model(problem, slice::from_ref(component));
    let (Ok(others), Ok(own)) = (others, own) else { return whole };
    let sizes = paid_for_sizes(problem, &others, &state.fit.noises, &own);
    let turning =
        component.term.parameters.iter().filter(|what| what.is_nonlinear() && !what.is_listed());
    let chosen = sizes * count(turning.count()) / count(own.raw.len().max(1));
    let sizes = sizes + problem.price_of_a_number();
    whole.max(sizes + chosen.max(2.0 * libm::log(looks)))
}

/// What a formula that was looked for at so many places pays against errors of targets: its sizes, as theirs, are of
/// one law.
#[must_use]
pub(crate) fn paid_by_formula(
    problem: &Problem,
    others: &Columns,
    noises: &[Noise],
    (own, looks): (&Columns, f64),
) -> f64 {
    let sizes = paid_for_sizes(problem, others, noises, own);
    sizes + problem.price_of_a_number() + 2.0 * libm::log(looks)
}

/// What some columns pay for sizes of one law: how much less they explain than with any. A few targets let nearly as
/// many numbers follow anything, and noise is no measure of that.
fn paid_for_sizes(problem: &Problem, others: &Columns, noises: &[Noise], own: &Columns) -> f64 {
    let stage = Stage::new(problem, others, noises);
    // Of one length, for a law of theirs has one size.
    let span = stage.span(own);
    let best: f64 = span.iter().map(|one| dot(one, &stage.target).powi(2)).sum();
    best - drawn_sizes_gain(&span, &stage.target)
}

/// What an effect of a model pays.
pub(crate) fn paid(problem: &Problem, state: &State, steps: &[Step], index: usize) -> f64 {
    let component = &state.components[index];
    Price::of(problem, component, looks(steps, component)).whole()
}

/// Places among which an effect was found.
fn looks(steps: &[Step], component: &Component) -> f64 {
    let tried = steps.iter().flat_map(|step| &step.tried);
    let own = tried.filter(|judged| judged.component.term.name == component.term.name);
    own.map(|judged| judged.looks).fold(1.0, f64::max)
}

/// Log likelihood of a model beside which every target has an error of its own, all of one size.
///
/// The noise is the model's, or what the targets leave; what they take of its rows is given back.
fn log_likelihood(problem: &Problem, model: &State, targets: &Columns) -> f64 {
    let columns = model.columns.and(targets);
    let free = settle(problem, &columns, &model.fit.noises);
    let rows = count(problem.samples.len());
    let kept = (rows - count(targets.raw.len())).max(1.0) / rows;
    let of_targets: Vec<Noise> = free.noises.iter().map(|noise| noise.scaled(1.0 / kept)).collect();
    [&model.fit.noises, &of_targets]
        .into_iter()
        .map(|noises| Stage::new(problem, &model.columns, noises).with_sizes_of(targets))
        .fold(f64::NEG_INFINITY, f64::max)
}
