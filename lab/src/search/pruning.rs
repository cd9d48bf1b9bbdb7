//! Effects that have become superfluous: what joins the model last may take another's place.

use super::starts::worth_alone;
use crate::hypotheses::{above_hunting, matters};
use crate::model::{
    Component, JointCovariance, Problem, State, helps_unseen, joint_covariance, settle_beside,
};
use crate::noise::swift_rms;
use crate::numerics::least_squares::covariance_rows;
use crate::numerics::{chi_squared_tail, in_parallel};
use crate::policy::chance::{EXACT_STANDARD_ERRORS, STANDARD_ERRORS};
use crate::policy::evidence::{SURE_ON_MEANS, WHOLE};

/// An effect taken out of a model again.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Dropped {
    /// Its name.
    pub(crate) name: String,
    /// Why.
    pub(crate) reason: String,
}

/// A model without the effects that the data do not need, and what was dropped, in order.
///
/// Each is judged with all others kept and everything fitted anew: it must be beyond chance, large
/// against the noise, helpful on unseen data, two standard errors from zero, and whole if it counts
/// something.
#[must_use]
pub(crate) fn pruned(problem: &Problem, state: State) -> (State, Vec<Dropped>) {
    let (mut state, mut dropped) = counting(problem, state);
    while let Some((smaller, one)) = weakest(problem, &state) {
        state = smaller;
        dropped.push(one);
    }
    (state, dropped)
}

/// The same for all rows behind the means that a search has worked on, where these leave a doubt.
///
/// All rows tell more of an effect than means do, and it takes long to ask them: one that is worth many times
/// its price to the means stays, unless it is small beside what the rows scatter.
pub(crate) fn pruned_in_doubt(
    problem: &Problem,
    state: &State,
    (means, of_means): (&Problem, &State),
) -> (State, Vec<Dropped>) {
    let is_needed = |index: usize| {
        let Some(fewer) = of_means.settled_without(means, &[index]) else { return false };
        let gain = gain(means, of_means, &fewer, index);
        let price = state.components[index].price(problem);
        SURE_ON_MEANS * price < gain && too_small(problem, state, index, gain).is_none()
    };
    if state.components.len() == of_means.components.len()
        && (0..state.components.len()).all(is_needed)
    {
        return (state.clone(), Vec::new());
    }
    pruned(problem, state.clone())
}

/// The model without its weakest effect, if that one is superfluous.
fn weakest(problem: &Problem, state: &State) -> Option<(State, Dropped)> {
    let covariance = joint_covariance(problem, state);
    let found = in_parallel(0..state.components.len(), |index| {
        let smaller = state.settled_without(problem, &[index])?;
        let reason = superfluous(problem, state, &smaller, index)
            .or_else(|| no_better(problem, state, &smaller))
            .or_else(|| useless(state, &covariance, index))?;
        let name = state.components[index].term.name.clone();
        Some((smaller, Dropped { name, reason }))
    });
    found
        .into_iter()
        .flatten()
        .max_by(|a, b| a.0.fit.log_likelihood.total_cmp(&b.0.fit.log_likelihood))
}

/// Why an effect is not needed; `None` when it is.
fn superfluous(problem: &Problem, state: &State, fewer: &State, index: usize) -> Option<String> {
    too_small(problem, state, index, gain(problem, state, fewer, index))
}

/// What a state is better than one without an effect, in twice the log likelihood, beyond what its passes' first
/// values would be worth alone.
fn gain(problem: &Problem, state: &State, fewer: &State, index: usize) -> f64 {
    let fit = settle_beside(problem, &state.columns, &state.fit.noises, &fewer.fit.noises);
    let alone = worth_alone(problem, fewer, &state.components[index], &state.fit.noises);
    let best = fit.log_likelihood.max(state.fit.log_likelihood);
    2.0 * (best - fewer.fit.log_likelihood) - alone
}

/// Why an effect that gains so much is not needed; `None` when it is.
fn too_small(problem: &Problem, state: &State, index: usize, gain: f64) -> Option<String> {
    let component = &state.components[index];
    let size = component.size_um(problem, state.coefficients(index).0);
    let after = swift_rms(&problem.layout, &state.fit.left);
    let unit = problem.measurement.unit();
    let chance = chi_squared_tail(gain, component.freedom());
    if gain < component.price(problem) {
        return Some(format!("superfluous beside the others: evidence {gain:.1} only"));
    }
    if !matters(problem, &state.fit, size, chance) || !above_hunting(problem, size) {
        return Some(format!(
            "superfluous: {size:.4} {unit} of {after:.4} {unit} noise, p {chance:.1e}"
        ));
    }
    None
}

/// Why an effect is not needed when the model without it is as good on unseen data.
fn no_better(problem: &Problem, state: &State, fewer: &State) -> Option<String> {
    let with_it = (&state.columns, state.fit.noises.as_slice());
    let without = (&fewer.columns, fewer.fit.noises.as_slice());
    (!helps_unseen(problem, with_it, without))
        .then(|| "superfluous: no better on held-out data without the noise".to_owned())
}

/// A model without the effects that count something and count no whole number: before the others
/// were known, they may have covered that.
fn counting(problem: &Problem, state: State) -> (State, Vec<Dropped>) {
    let out = no_counts(problem, &state);
    if out.is_empty() {
        return (state, Vec::new());
    }
    let indices: Vec<usize> = out.iter().map(|(index, _)| *index).collect();
    let Some(fewer) = state.settled_without(problem, &indices) else { return (state, Vec::new()) };
    let name = |index: usize| state.components[index].term.name.clone();
    let dropped = out.into_iter().map(|(index, reason)| Dropped { name: name(index), reason });
    (fewer, dropped.collect())
}

/// Places of the effects whose count is no whole number, and what it is.
pub(super) fn no_counts(problem: &Problem, state: &State) -> Vec<(usize, String)> {
    let mut counts = counts(problem, state);
    counts.retain(|one| one.slack() < (one.found - one.whole).abs());
    let reason = |one: &Count| format!("no whole number: {:.3} ± {:.3}", one.found, one.stderr);
    counts.iter().map(|one| (one.index, reason(one))).collect()
}

/// How many of something an effect counts, and what is found when all counts of a model are left free.
pub(super) struct Count {
    /// Place of the effect.
    pub(super) index: usize,
    whole: f64,
    found: f64,
    stderr: f64,
}

impl Count {
    /// How far from whole it may be found.
    fn slack(&self) -> f64 {
        EXACT_STANDARD_ERRORS * self.stderr + WHOLE
    }

    /// True where any number would pass for whole.
    pub(super) fn is_of_any_size(&self) -> bool {
        0.5 <= self.slack()
    }
}

/// Per effect the standard error of its count where any number would pass for it.
pub(crate) fn errors_of_counts(problem: &Problem, state: &State) -> Vec<Option<f64>> {
    let mut errors = vec![None; state.components.len()];
    for one in counts(problem, state).iter().filter(|one| one.is_of_any_size()) {
        errors[one.index] = Some(one.stderr);
    }
    errors
}

/// The counts of a model.
pub(super) fn counts(problem: &Problem, state: &State) -> Vec<Count> {
    let is_counted = |one: &Component| one.whole.iter().any(Option::is_some);
    if !state.components.iter().any(is_counted) {
        return Vec::new();
    }
    let mut components = state.components.clone();
    for one in &mut components {
        one.whole.fill(None);
    }
    let Some(free) = State::of(problem, components, &state.fit.noises) else { return Vec::new() };
    let covariance = joint_covariance(problem, &free).linear;
    let of = |index: usize| {
        let held = &state.components[index].whole;
        let column = held.iter().position(Option::is_some)?;
        let in_use = free.components[index].used_before(column);
        let (used, from) = free.coefficients(index);
        let stderr = covariance[(from + in_use, from + in_use)].max(0.0).sqrt();
        Some(Count { index, whole: held[column]?, found: *used.get(in_use)?, stderr })
    };
    (0..state.components.len()).filter_map(of).collect()
}

/// Why an effect is not needed when each of its coefficients may be zero by its standard error, or
/// a time or a way that it has in place of coefficients nearly so.
///
/// Such a time has no sign, and does nothing at all at zero: what gains much by one that is hardly
/// known gains it otherwise, as a lag that smooths the steps of a rounded position.
fn useless(state: &State, covariance: &JointCovariance, index: usize) -> Option<String> {
    let component = &state.components[index];
    let (used, from) = state.coefficients(index);
    // That the file's effect has gone is as good a correction as any.
    if component.term.instead_of.is_some() {
        return None;
    }
    if component.is_of_one_size() {
        let mut values = component.term.nonlinear().into_iter().zip(&covariance.nonlinear[index]);
        let is_open = |(value, stderr): (f64, &Option<f64>)| {
            stderr.is_some_and(|stderr| value.abs() < EXACT_STANDARD_ERRORS * stderr)
        };
        return values.any(is_open).then(|| {
            "useless: what it has in place of a size is not four standard errors from zero"
                .to_owned()
        });
    }
    if used.is_empty() {
        return None;
    }
    let covariance = covariance_rows(&covariance.linear, from, component.width());
    let sizes = component.estimates(used, &covariance);
    let phase = |parameter: usize| {
        component.term.parameters[parameter].role == helixlock_plant::Role::Phase
    };
    sizes
        .iter()
        .filter(|estimate| !phase(estimate.parameter))
        .all(|estimate| estimate.value.abs() < STANDARD_ERRORS * estimate.stderr)
        .then(|| "useless: no coefficient is two standard errors from zero".to_owned())
}
