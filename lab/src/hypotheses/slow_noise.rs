//! Slow noise that may be an effect: what a fit calls noise though it hardly changes in a pass.
//!
//! A noise whose correlation is as long as the pass follows any smooth curve, so that no curve is
//! beyond chance against it. It has then been told from nothing, and nothing from it.

use super::flaws::above_flaws;
use super::probes::Structure;
use super::spoilt_pass::spoilt_pass;
use crate::model::{Fit, Judged, Problem, State};
use crate::noise::{
    Layout, Noise, effective_samples, is_surely_slow, rms, smooth_fit, weighed_rms,
};
use crate::numerics::count;
use crate::policy::chance::{NO_CHANCE, NO_CHANCE_BESIDE, NO_CHANCE_SWIFT};
use crate::policy::size::{
    BESIDE_EFFECTS, ROWS_OF_A_MEAN, SLOW_ENOUGH, SMOOTH_SHARE, SMOOTHER, SWIFT_FOR_ALL,
    SWIFT_WITH_IT, WORTH_A_PASS, WORTH_AN_ALL_CLEAR,
};

/// The smooth curve that a noise as slow as the pass has taken for its own, if it is most of what
/// is left; `all` is all that was looked for.
#[must_use]
pub(crate) fn taken_for_noise(
    problem: &Problem,
    fit: &Fit,
    all: &[Structure],
) -> Option<Structure> {
    let worth = samples_a_slow_pass(problem, fit);
    if WORTH_A_PASS <= worth {
        return None;
    }
    let least_um = SMOOTH_SHARE * weighed_rms(&problem.layout, &fit.left);
    let smooth = all.iter().filter(|one| one.shape == "smooth curve" && least_um < one.rms_um);
    let curve = smooth.max_by(|a, b| a.rms_um.total_cmp(&b.rms_um))?;
    let shape = format!("smooth curve, or noise so slow that a pass is worth {worth:.1} samples");
    Some(Structure { shape, ..curve.clone() })
}

/// What a model leaves, where nothing is `left` but noise, which is so slow that it may be a
/// cause, or a pass of it is.
///
/// Where effects explain a third as much such noise is believed; else the answer rests on it.
#[must_use]
pub(crate) fn no_all_clear(
    problem: &Problem,
    state: &State,
    left: &[Structure],
) -> Option<Structure> {
    let [before, now] =
        [&problem.residual(), &state.fit.left].map(|left| rms(&problem.layout, left));
    let is_beside = !state.components.is_empty() && now * now < BESIDE_EFFECTS * before * before;
    if !left.is_empty() {
        return None;
    }
    let slow = || (!is_beside).then(|| slow_cause(problem, &state.fit)).flatten();
    spoilt_pass(problem, &state.fit).or_else(slow)
}

/// What a fit leaves where that is so slow that it may be a cause.
#[must_use]
pub(crate) fn slow_cause(problem: &Problem, fit: &Fit) -> Option<Structure> {
    let is_slow = samples_a_slow_pass(problem, fit) < WORTH_AN_ALL_CLEAR;
    let cause = is_slow.then(|| slow(problem, fit, "a slow cause"));
    cause.filter(|cause| above_flaws(problem, fit, cause))
}

/// What a model leaves, where that is slow only without an effect, or too smooth for noise.
#[must_use]
pub(crate) fn slow_or_smooth(
    problem: &Problem,
    state: &State,
    tried: &[Judged],
) -> Option<Structure> {
    slow_without(problem, state, tried).or_else(|| smooth_cause(problem, &state.fit))
}

/// What a model leaves, where that is slow only without one of the effects that were `tried` beside it:
/// not sure enough to be named, each of these is as good an account of it as slow noise. One more of a kind
/// that the model has is none, for a sum of such curves follows anything.
fn slow_without(problem: &Problem, state: &State, tried: &[Judged]) -> Option<Structure> {
    let fit = &state.fit;
    let slow_worth = samples_a_slow_pass(problem, fit);
    let limit = if state.components.is_empty() { NO_CHANCE } else { NO_CHANCE_BESIDE };
    let is_new = |judged: &&Judged| {
        let name = &judged.component.term.name;
        judged.p_value < NO_CHANCE_SWIFT
            && state.components.iter().all(|one| one.term.name != *name)
    };
    let mut with =
        tried.iter().filter(is_new).map(|judged| (judged, samples_a_pass(problem, &judged.fit)));
    let (judged, worth) = with.find(|(judged, worth)| {
        let least = if judged.p_value < limit { SWIFT_WITH_IT } else { SWIFT_FOR_ALL };
        least * slow_worth < *worth
    })?;
    let name = &judged.component.term.name;
    Some(slow(problem, fit, &format!("{name}, beside which it is worth {worth:.0}")))
}

/// What a model leaves, where that is slow and too smooth for noise that forgets: what two worn places of opposite
/// sign draw in one pass looks slow, and beside either of them no less so.
fn smooth_cause(problem: &Problem, fit: &Fit) -> Option<Structure> {
    let of_sensor = |sensor: usize| {
        let (layout, rows) = problem.layout.of_sensor(sensor);
        let noise = &fit.noises[sensor];
        if SLOW_ENOUGH <= worth_of(&layout, noise) {
            return None;
        }
        let smooth = smooth_fit(&layout, &fit.left[rows], noise);
        (ROWS_OF_A_MEAN <= smooth.length && SMOOTHER < smooth.ahead).then_some(smooth.ahead)
    };
    let ahead = (0..problem.sensors.len()).filter_map(of_sensor).reduce(f64::max)?;
    let rms_um = weighed_rms(&problem.layout, &fit.left);
    let p_value = libm::exp(-0.5 * ahead);
    let cause = Structure::without_place("time", "slow and smoother than noise", rms_um, p_value);
    above_flaws(problem, fit, &cause).then_some(cause)
}

/// Noise that is slow, or something else.
fn slow(problem: &Problem, fit: &Fit, cause: &str) -> Structure {
    let worth = samples_a_pass(problem, fit);
    let shape = format!("noise so slow that a pass is worth {worth:.1} samples, or {cause}");
    Structure::without_place("time", &shape, weighed_rms(&problem.layout, &fit.left), 1.0)
}

/// Independent samples that a pass is worth about its mean, of the sensor that has the fewest.
#[must_use]
pub(crate) fn samples_a_pass(problem: &Problem, fit: &Fit) -> f64 {
    (0..problem.sensors.len())
        .map(|sensor| worth_of(&problem.layout.of_sensor(sensor).0, &fit.noises[sensor]))
        .fold(f64::INFINITY, f64::min)
}

/// The same of the sensors whose noise is slow beyond chance, infinite without one.
fn samples_a_slow_pass(problem: &Problem, fit: &Fit) -> f64 {
    let of_sensor = |sensor: usize| {
        let (layout, rows) = problem.layout.of_sensor(sensor);
        let noise = &fit.noises[sensor];
        let is_slow = is_surely_slow(&layout, &fit.left[rows], noise);
        is_slow.then(|| worth_of(&layout, noise))
    };
    (0..problem.sensors.len()).filter_map(of_sensor).fold(f64::INFINITY, f64::min)
}

fn worth_of(layout: &Layout, noise: &Noise) -> f64 {
    effective_samples(layout, noise) / count(layout.blocks.len().max(1))
}
