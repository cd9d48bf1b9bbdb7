//! Whether the best effect of a round may be taken into a model.

use helixlock_plant::{Parameter, Role, Search};

use super::likeness;
use crate::hypotheses::{
    SIGNIFICANCE, above_hunting, chance_with_tails, gain_at, matters, turn_scan,
};
use crate::model::{Columns, Component, Judged, Problem, Stage, State, helps_unseen};
use crate::noise::swift_rms;
use crate::numerics::least_squares::covariance_rows;
use crate::numerics::{chi_squared_tail, count};

/// True when an effect is beyond chance, helps on unseen data and is large enough to matter.
#[must_use]
pub(crate) fn acceptable(problem: &Problem, now: &State, judged: &Judged) -> bool {
    let component = &judged.component;
    let (used, _) = judged.coefficients();
    let size = component.size_um(problem, used);
    matters(size, swift_rms(&problem.layout, &judged.fit.left), judged.p_value)
        && above_hunting(problem, size)
        && better_unseen(problem, now, judged)
        && plausible(problem, judged)
        && likeness::turns_enough(problem, component, used)
        && likeness::lets_motion_through(problem, component)
        && !at_an_end(component)
        && repeats(judged, now)
        && locked_to_time(problem, now, judged)
        && !rests_on_one_sample(problem, now, judged)
}

/// True when the model with an effect does better on unseen data than without it.
fn better_unseen(problem: &Problem, now: &State, judged: &Judged) -> bool {
    let Ok(more) = Columns::of(problem, std::slice::from_ref(&judged.component)) else {
        return false;
    };
    let columns = now.columns.and(&more);
    helps_unseen(problem, (&columns, &judged.fit.noises), (&now.columns, &now.fit.noises))
}

/// True unless a frequency in time was found that an order of the spindle explains as well.
///
/// At one speed the two are one: such a line is nobody's until the speed is changed.
fn locked_to_time(problem: &Problem, now: &State, judged: &Judged) -> bool {
    if !judged.component.term.parameters.iter().any(Parameter::is_frequency) {
        return true;
    }
    let stage = Stage::new(problem, &now.columns, &judged.fit.noises);
    let own = gain_at(&stage, &judged.component).map_or(0.0, |gain| gain.gain);
    let turns: Vec<f64> = problem.record.turns().collect();
    let of_row: Vec<f64> = problem.rows.iter().map(|row| turns[row.sample]).collect();
    let scan = turn_scan(&stage, &of_row);
    let line = scan.strongest(&stage.target[..of_row.len()]);
    line.is_none_or(|line| line.gain + TIME_LOCK < own)
}

/// Evidence that tells time from angle.
const TIME_LOCK: f64 = 12.0;

/// True for an effect that one sample alone speaks for, which the tails of the noise explain too.
fn rests_on_one_sample(problem: &Problem, now: &State, judged: &Judged) -> bool {
    let freedom = count(judged.component.width().max(1));
    let other_samples = |gain| chi_squared_tail(gain, freedom) * judged.looks;
    SIGNIFICANCE < chance_with_tails(problem, [&now.fit, &judged.fit], other_samples)
}

/// True unless an effect that is there once would be added a second time.
///
/// Lines come in numbers, and so do slips; of curves and bumps a sum can imitate anything.
fn repeats(judged: &Judged, now: &State) -> bool {
    let term = &judged.component.term;
    let periodic =
        term.parameters.iter().any(|what| what.role == Role::Amplitude || what.name == "count");
    let before = now.components.iter().filter(|other| other.term.name == term.name).count();
    before == 0 || (periodic && before < 3)
}

/// True when all parameters lie in their plausible ranges, to within two standard errors, and the
/// shape shows enough of itself.
#[must_use]
pub(crate) fn plausible(problem: &Problem, judged: &Judged) -> bool {
    let component = &judged.component;
    if !likeness::shows_both_flanks(problem, component) {
        return false;
    }
    let (used, from) = judged.coefficients();
    let covariance = covariance_rows(&judged.fit.linear.covariance, from, component.width());
    component.estimates(used, &covariance).iter().all(|estimate| {
        // A square that would have to be negative is fitted as 0.
        if component.term.parameters[estimate.parameter].role == Role::Squared
            && estimate.value <= 0.0
        {
            return false;
        }
        let range = &component.term.parameters[estimate.parameter].range;
        let slack = 2.0 * estimate.stderr;
        range.start() >= range.end()
            || (*range.start() <= estimate.value + slack && estimate.value - slack <= *range.end())
    })
}

/// True when the fit would go on beyond the range of a nonlinear parameter: what it follows there
/// is another shape than the one the effect is named for.
fn at_an_end(component: &Component) -> bool {
    let term = &component.term;
    term.nonlinear_indices().iter().any(|&index| {
        let (what, value) = (&term.parameters[index], term.values[index]);
        let (low, high) = (*what.range.start(), *what.range.end());
        matches!(what.search, Search::Linear | Search::Logarithmic)
            && low < high
            && !(low < value && value < high)
    })
}
