//! Waves that an order of the spindle explains as well, or a little beside the listed one better.

use helixlock_plant::{Column, Parameter, Search};

use super::likeness;
use super::refusal::Refusal;
use crate::hypotheses::{gain_at, turn_scan};
use crate::model::{Columns, Component, Judged, Problem, Stage, State};
use crate::numerics::{golden_maximum, spread};
use crate::policy::evidence::{IN_STEP, MARGIN, TIME_LOCK, WAVES_A_PASS};
use crate::spectrum::wave;

/// Steps to the best order near one.
const STEPS: usize = 16;

/// Share of a wave, over all of a record, that another order is ahead or behind by at most: beyond it lies another
/// line.
const FARTHEST: f64 = 0.5;

/// Refused when a frequency in time was found that an order of the spindle explains as well.
///
/// In one pass at one speed the two are one: such a line is nobody's until the speed is changed, or the axis
/// turns back.
pub(super) fn turns_as_well(problem: &Problem, now: &State, judged: &Judged) -> Option<Refusal> {
    judged.component.term.parameters.iter().position(Parameter::is_frequency)?;
    let (order, ahead) = ahead_of_orders(problem, now, judged)?;
    (ahead <= TIME_LOCK).then_some(Refusal::Angle { order, ahead })
}

/// Refused when a wave at few targets is explained as well by a longer one, though uneven targets tell
/// it from all others if it is large enough.
pub(super) fn not_told_by_targets(
    problem: &Problem,
    now: &State,
    judged: &Judged,
) -> Option<Refusal> {
    if likeness::resolved(problem, &judged.component) {
        return None;
    }
    let is_told = ahead_of_orders(problem, now, judged).is_some_and(|(_, ahead)| MARGIN < ahead);
    (!is_told).then_some(Refusal::Targets)
}

/// Refused where the same wave at an order between the listed ones explains more, and the listed one's, a part of a
/// wave off at the ends of the record, does not make most of it. One that is shifted on the way, as of a mount that
/// is turned over, is the listed one's still.
pub(super) fn out_of_step(problem: &Problem, now: &State, judged: &Judged) -> Option<Refusal> {
    let component = &judged.component;
    let term = &component.term;
    let is_listed = |what: &Parameter| matches!(what.search, Search::Whole | Search::GearOrder);
    let listed = term.parameters.iter().position(is_listed)?;
    let order = component.waves_a_turn(problem);
    let waves = order * spread(&problem.record.turns().collect::<Vec<f64>>());
    if waves < WAVES_A_PASS {
        return None;
    }
    let stage = Stage::new(problem, &now.columns, &judged.fit.noises);
    let mut off_by = |share: f64| {
        let mut term = term.clone();
        term.values[listed] *= 1.0 + share / waves;
        gain_at(&stage, &Component { term, ..component.clone() }).map_or(0.0, |gain| gain.gain)
    };
    let own = off_by(0.0);
    let (share, best) = golden_maximum(&mut off_by, (-FARTHEST, FARTHEST), STEPS);
    let (order, ahead) = (order * (1.0 + share / waves), best - own);
    let is_off = own < IN_STEP * best && MARGIN < ahead;
    (is_off && of_two_halves(&stage, component) < best)
        .then_some(Refusal::OutOfStep { order, ahead })
}

/// What a wave explains that has a size and a phase of its own in each half of a record.
fn of_two_halves(stage: &Stage<'_>, component: &Component) -> f64 {
    let Ok(whole) = Columns::of(stage.problem, std::slice::from_ref(component)) else { return 0.0 };
    let half = |column: &Column, is_in: &dyn Fn(usize) -> bool| -> Column {
        let values = column.iter().zip(&stage.problem.samples);
        values.map(|(value, &sample)| if is_in(sample) { *value } else { 0.0 }).collect()
    };
    let middle = stage.problem.record.len() / 2;
    let halves = whole.raw.iter().flat_map(|column| {
        [half(column, &|sample| sample < middle), half(column, &|sample| middle <= sample)]
    });
    let halves = Columns { fixed: whole.fixed.clone(), ..Columns::free(halves) };
    stage.gain(&halves).gain
}

/// The order of the spindle that explains most in the place of an effect, and by how much the effect is ahead of it:
/// that of the strongest line, or what the frequency of the effect is at the record's own speed.
fn ahead_of_orders(problem: &Problem, now: &State, judged: &Judged) -> Option<(f64, f64)> {
    let stage = Stage::new(problem, &now.columns, &judged.fit.noises);
    let own = gain_at(&stage, &judged.component).map_or(0.0, |gain| gain.gain);
    let turns: Vec<f64> = problem.record.turns().collect();
    let of_row: Vec<f64> = problem.samples.iter().map(|&sample| turns[sample]).collect();
    let scan = turn_scan(&stage, &of_row);
    let line = scan.strongest_anywhere(&stage.target[..of_row.len()]).map(|line| line.frequency);
    let mut explained = |order: f64| stage.gain(&waves(problem, &turns, order)).gain;
    let orders = line.into_iter().chain(order_of_a_frequency(problem, judged, &turns));
    let best = orders.map(|order| {
        let near = (order - scan.resolution(), order + scan.resolution());
        golden_maximum(&mut explained, near, STEPS)
    });
    let (order, gain) = best.max_by(|a, b| a.1.total_cmp(&b.1))?;
    Some((order, own - gain))
}

/// What a frequency in time is as an order at the record's own speed.
fn order_of_a_frequency(problem: &Problem, judged: &Judged, turns: &[f64]) -> Option<f64> {
    let term = &judged.component.term;
    let hertz = term.parameters.iter().position(Parameter::is_frequency)?;
    let passes = problem.record.passes();
    let of = |values: &[f64]| passes.iter().map(|rows| spread(&values[rows.clone()])).sum::<f64>();
    let order = term.values[hertz] * of(&problem.record.time_s) / of(turns);
    order.is_finite().then_some(order)
}

/// Waves of an order, of any size and phase for each sensor.
fn waves(problem: &Problem, turns: &[f64], order: f64) -> Columns {
    let each = (0..problem.sensors.len()).map(|sensor| wave(problem, sensor, turns, order));
    Columns::free(each.flat_map(|columns| columns.raw))
}
