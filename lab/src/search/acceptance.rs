//! Whether the best effect of a round may be taken into a model.

use std::ops::Range;

use helixlock_plant::{Role, Search, Term};

use super::orders::{not_told_by_targets, turns_as_well};
use super::own_errors::scatters_as_targets;
use super::refusal::Refusal;
use super::uneven::Taken;
use super::{likeness, other_spectrum, uneven};
use crate::hypotheses::{chance_in_noise, chance_with_tails, gain_at, least_above_hunting};
use crate::model::{
    Columns, Component, Fit, Judged, Problem, Stage, State, helps_unseen, holdout_rms_where,
};
use crate::noise::{effective_samples, rms, swift_rms};
use crate::numerics::least_squares::covariance_rows;
use crate::numerics::{chi_squared_tail, longest};
use crate::policy::chance::{
    FEW_SAMPLES, NAMED, NAMED_IN_OTHER_NOISE, NO_ALL_CLEAR, STANDARD_ERRORS,
};
use crate::policy::evidence::{LARGEST_RIVAL, MOST_OF_A_NAME, MOST_WHOLE_WAVES};
use crate::policy::extent::{STROKES_A_SHORT_ONE, TAKEN_UP_OF_A_STROKE};
use crate::policy::size::{SHARE_OF_NOISE, TRUE_TO};

/// Step from the end of a range to a value inside, against the range.
const STEP_INSIDE: f64 = 0.01;

/// Share of a gain that is rounding.
const AS_GOOD: f64 = 1e-6;

/// The clause that keeps the best effect of a round out of a model; `None` when it may join: it is
/// beyond chance, helps on unseen data and is large enough to matter.
#[must_use]
pub(crate) fn refusal(problem: &Problem, now: &State, judged: &Judged) -> Option<Refusal> {
    let component = &judged.component;
    let (used, _) = judged.coefficients();
    too_small(problem, judged, component.size_um(problem, used))
        .or_else(|| undone(problem, now, judged))
        .or_else(|| no_better_unseen(problem, now, judged))
        .or_else(|| implausible(problem, judged, 1.0))
        .or_else(|| (!likeness::turns_once(problem, component)).then_some(Refusal::Turn))
        .or_else(|| (!likeness::turns_enough(problem, component, used)).then_some(Refusal::Piece))
        .or_else(|| (!likeness::has_both_sides(problem, component, used)).then_some(Refusal::Edge))
        .or_else(|| (!likeness::by_the_clock(problem, component)).then_some(Refusal::Clock))
        .or_else(|| (!likeness::has_its_time(problem, component)).then_some(Refusal::Untimed))
        .or_else(|| not_told_by_targets(problem, now, judged))
        .or_else(|| likeness::at_one_target(problem, component, used).then_some(Refusal::OneTarget))
        .or_else(|| (!likeness::lets_motion_through(problem, component)).then_some(Refusal::Play))
        .or_else(|| scatters_as_targets(problem, now, judged))
        .or_else(|| at_an_end(problem, now, judged))
        .or_else(|| (!repeats(judged, now)).then_some(Refusal::Again))
        .or_else(|| turns_as_well(problem, now, judged))
        .or_else(|| rests_on_one_sample(problem, now, judged))
        .or_else(|| follows_slow_noise(problem, now, judged))
        .or_else(|| follows_uneven_noise(problem, now, judged))
}

/// Refused as chance, or as too small to change a figure.
fn too_small(problem: &Problem, judged: &Judged, size_um: f64) -> Option<Refusal> {
    let p_value = judged.p_value;
    let least_um = SHARE_OF_NOISE * swift_rms(&problem.layout, &judged.fit.left);
    let hunting_um = least_above_hunting(problem);
    if NAMED <= p_value {
        return Some(Refusal::Chance { p_value });
    }
    if size_um <= least_um || size_um.is_nan() {
        return Some(Refusal::Small { size_um, least_um });
    }
    (size_um < hunting_um).then_some(Refusal::Hunting { size_um, least_um: hunting_um })
}

/// Refused when the effects of the model have grown to undo nearly all of an effect: what it explains
/// then is what no formula is true to. Where targets scatter each way, that is what a reversal is told by.
fn undone(problem: &Problem, now: &State, judged: &Judged) -> Option<Refusal> {
    if problem.are_ways_free() {
        return None;
    }
    let size_um = judged.component.size_um(problem, judged.coefficients().0);
    let before = now.fit.left.iter().zip(&judged.fit.left);
    let explained: Vec<f64> = before.map(|(before, left)| before - left).collect();
    let own_um = rms(&problem.layout, &explained);
    (own_um < TRUE_TO * size_um).then_some(Refusal::Undone { size_um, own_um })
}

/// Refused when the model with an effect does no better on unseen data than without it.
fn no_better_unseen(problem: &Problem, now: &State, judged: &Judged) -> Option<Refusal> {
    // What targets show each way is no better known on unseen data for what is alike at all.
    let others = problem.without_ways(&now.columns);
    let columns = others.and(&own_columns(problem, judged)?);
    let model = (&columns, judged.fit.noises.as_slice());
    let without = (&others, now.fit.noises.as_slice());
    (!helps_unseen(problem, model, without)).then(|| Refusal::Unseen {
        with_um: judged.holdout_rms_um,
        without_um: holdout_rms_where(problem, &columns, without),
    })
}

/// Refused when one sample alone speaks for an effect, which the tails of the noise explain too. A reversal against
/// the scatter of targets is in no row.
fn rests_on_one_sample(problem: &Problem, now: &State, judged: &Judged) -> Option<Refusal> {
    if problem.are_ways_free() {
        return None;
    }
    let chance = chance_without_one_sample(problem, now, judged);
    is_too_much(judged, chance).then_some(Refusal::OneSample { chance })
}

/// True for a chance in noise of another kind that is larger than in the noise of the model, and too
/// large for a name.
fn is_too_much(judged: &Judged, chance: f64) -> bool {
    judged.p_value < chance && NAMED_IN_OTHER_NOISE <= chance
}

/// Refused when drawn noise, as slow as what is left without an effect, is followed as well by its
/// columns.
fn follows_slow_noise(problem: &Problem, now: &State, judged: &Judged) -> Option<Refusal> {
    let p_value = chance_in_slow_noise(problem, now, judged, NAMED);
    (NAMED <= p_value).then_some(Refusal::Chance { p_value })
}

/// Refused when noise that is louder in places, or smoother, than the model of the noise can be does
/// as much.
fn follows_uneven_noise(problem: &Problem, now: &State, judged: &Judged) -> Option<Refusal> {
    let p_value = chance_in_uneven_noise(problem, now, judged);
    is_too_much(judged, p_value).then_some(Refusal::Chance { p_value })
}

/// The chance of an effect's gain in whatever kind of noise makes as much most often.
#[must_use]
pub(crate) fn chance_in_any_noise(problem: &Problem, now: &State, judged: &Judged) -> f64 {
    let slow = chance_in_slow_noise(problem, now, judged, NO_ALL_CLEAR);
    let laws = [chance_without_one_sample, chance_in_uneven_noise];
    laws.iter().map(|law| law(problem, now, judged)).fold(slow, f64::max)
}

fn chance_without_one_sample(problem: &Problem, now: &State, judged: &Judged) -> f64 {
    let freedom = judged.component.freedom();
    let other_samples = |gain| chi_squared_tail(gain, freedom) * judged.looks;
    chance_with_tails(problem, [&now.fit, &judged.fit], other_samples)
}

/// Samples that a record is worth under the noise of a fit, of the sensor with the slowest.
pub(super) fn worth(problem: &Problem, fit: &Fit) -> f64 {
    let of = |sensor: usize| {
        let (layout, _) = problem.layout.of_sensor(sensor);
        effective_samples(&layout, &fit.noises[sensor])
    };
    (0..problem.sensors.len()).map(of).fold(f64::INFINITY, f64::min)
}

/// Of a record that is worth few samples χ² promises too much: drawn noise says more, as far as it
/// must to tell the chance from a limit.
fn chance_in_slow_noise(problem: &Problem, now: &State, judged: &Judged, limit: f64) -> f64 {
    if judged.component.is_of_one_size() {
        return judged.p_value;
    }
    let Some(columns) = own_columns(problem, judged) else { return judged.p_value };
    if FEW_SAMPLES <= worth(problem, &now.fit) {
        return judged.p_value;
    }
    let looks = judged.looks.max(1.0) * judged.tried;
    let model = (&now.columns, &now.fit);
    let drawn = chance_in_noise(problem, model, &columns.raw, judged.gain, limit / looks);
    (looks * drawn).min(1.0)
}

fn chance_in_uneven_noise(problem: &Problem, now: &State, judged: &Judged) -> f64 {
    let itself = judged.component.without_starts();
    let Ok(columns) = Columns::of(problem, &[itself]) else { return judged.p_value };
    let taken = Taken::by(problem, now, &columns, &judged.fit);
    let inflation = uneven::inflation(problem, now, &judged.fit, &taken)
        .max(other_spectrum::inflation(problem, &taken));
    let freedom = judged.component.freedom();
    let of_gain = |gain| chi_squared_tail(gain, freedom) * judged.looks.max(1.0);
    if inflation <= 1.0 { judged.p_value } else { of_gain(judged.gain / inflation).min(1.0) }
}

fn own_columns(problem: &Problem, judged: &Judged) -> Option<Columns> {
    Columns::of(problem, std::slice::from_ref(&judged.component)).ok()
}

/// True unless an effect that is there would be added once too often.
///
/// Lines come in numbers, and so do slips; of curves and bumps a sum can imitate anything. Whole waves
/// of a turn and those of listed gears are few to choose from, and a shape that they are the
/// harmonics of stands before the same judge in their place.
fn repeats(judged: &Judged, now: &State) -> bool {
    let term = &judged.component.term;
    let periodic =
        term.parameters.iter().any(|what| what.role == Role::Amplitude || what.name == "count");
    let most = if is_of_whole_waves(term) { MOST_WHOLE_WAVES } else { MOST_OF_A_NAME };
    let before = now.components.iter().filter(|other| other.term.name == term.name).count();
    before == 0 || (periodic && before < most)
}

/// True for whole waves of a turn and those of listed gears, which are few to choose from.
pub(super) fn is_of_whole_waves(term: &Term) -> bool {
    term.parameters.iter().any(|what| matches!(what.search, Search::Whole | Search::GearOrder))
}

/// True when nothing in an effect's values and shape speaks against it as a rival: a size that nobody has met makes no
/// name, but it does not make another one sure.
#[must_use]
pub(crate) fn may_rival(problem: &Problem, judged: &Judged) -> bool {
    implausible(problem, judged, LARGEST_RIVAL).is_none()
}

/// Refused unless all parameters lie in their plausible ranges, those that begin at nothing so many times as wide, to
/// within two standard errors, and the shape shows enough of itself.
fn implausible(problem: &Problem, judged: &Judged, reach: f64) -> Option<Refusal> {
    let component = &judged.component;
    if !likeness::shows_both_flanks(problem, component) {
        return Some(Refusal::Flank);
    }
    let (used, from) = judged.coefficients();
    let covariance = covariance_rows(&judged.fit.linear.covariance, from, component.width());
    component.estimates(used, &covariance).iter().find_map(|estimate| {
        let what = &component.term.parameters[estimate.parameter];
        // A square that would have to be negative is fitted as 0.
        if what.role == Role::Squared && estimate.value <= 0.0 {
            return Some(Refusal::NegativeSquare { parameter: what.key() });
        }
        let reach = if what.range.contains(&0.0) { reach } else { 1.0 };
        let (low, high) = (reach * *what.range.start(), reach * *what.range.end());
        let slack = STANDARD_ERRORS * estimate.stderr;
        let inside =
            high <= low || (low <= estimate.value + slack && estimate.value - slack <= high);
        let (value, stderr) = (estimate.value, estimate.stderr);
        (!inside).then(|| Refusal::Range { parameter: what.key(), value, stderr })
    })
}

/// Refused when the fit would go on beyond the range of a nonlinear parameter, or a way beyond what reversals are
/// followed by: what it follows there is another shape than the one the effect is named for, and what was not taken up
/// is carried over the next reversal.
pub(super) fn at_an_end(problem: &Problem, now: &State, judged: &Judged) -> Option<Refusal> {
    let term = &judged.component.term;
    term.nonlinear_indices().iter().enumerate().find_map(|(place, &index)| {
        let (what, value) = (&term.parameters[index], term.values[index]);
        let low = *what.range.start();
        let mut high = *what.range.end();
        if what.of_way && what.may_be_none() {
            let part = if begins_otherwise(term) { TAKEN_UP_OF_A_STROKE } else { 1.0 };
            high = high.min(part * gone_by_most(problem));
        }
        // What is taken up within less than the shortest way is taken up at once.
        let inside = (what.of_way || low < value) && value < high;
        let next = match what.search {
            Search::Logarithmic if value <= low => 2.0 * low,
            Search::Logarithmic => 0.5 * high,
            Search::Linear if value <= low => low + STEP_INSIDE * (high - low),
            Search::Linear => high - STEP_INSIDE * (high - low),
            _ => return None,
        };
        let refused = low < high && !inside && changes(problem, now, judged, (place, next));
        refused.then(|| Refusal::End { parameter: what.key(), value })
    })
}

/// True of an effect whose passes do not begin as they mostly do.
fn begins_otherwise(term: &Term) -> bool {
    let mut values = term.parameters.iter().zip(&term.values);
    values.any(|(what, value)| what.search == Search::Switch && what.default != Some(*value))
}

/// The way that three in four strokes between two reversals go, mm; where none is, the longest behind a reversal.
fn gone_by_most(problem: &Problem) -> f64 {
    let gone = &problem.record.since_turn_mm;
    let of_pass = |rows: Range<usize>| {
        let ends = gone[rows].windows(2).filter(|two| two[1] < two[0] && two[0].is_finite());
        ends.map(|two| two[0]).collect::<Vec<_>>()
    };
    let mut strokes: Vec<f64> = problem.record.passes().into_iter().flat_map(of_pass).collect();
    strokes.sort_unstable_by(f64::total_cmp);
    strokes.get(strokes.len() / STROKES_A_SHORT_ONE).copied().unwrap_or_else(|| longest(gone))
}

/// True unless the fit is as good with another value of a nonlinear parameter: a way that is shorter
/// than samples lie apart has no length.
fn changes(problem: &Problem, now: &State, judged: &Judged, (place, value): (usize, f64)) -> bool {
    let component = &judged.component;
    let mut values = component.term.nonlinear();
    values[place] = value;
    let other = Component { term: component.term.with_nonlinear(&values), ..component.clone() };
    let stage = Stage::new(problem, &now.columns, &judged.fit.noises);
    let gain = |component: &Component| gain_at(&stage, component).map_or(0.0, |gain| gain.gain);
    let own = gain(component);
    AS_GOOD * own < (own - gain(&other)).abs()
}
