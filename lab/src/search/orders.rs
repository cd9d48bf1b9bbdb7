//! Waves that an order of the spindle explains as well.

use std::ops::Range;

use super::likeness;
use super::refusal::Refusal;
use crate::hypotheses::{gain_at, turn_scan};
use crate::model::{Columns, Judged, Problem, Stage, State};
use crate::numerics::{
    count, golden_maximum, in_parallel, least_squares, median, spread, usual_rate,
};
use crate::policy::evidence::{HELD_FOR, MARGIN, OFF_AN_EVEN_MOTION, TIME_LOCK};
use crate::policy::extent::{MEASURED_FOR_A_LISTED_ONE, MEASURED_ORDERS};
use crate::spectrum::{Point, Scan, strongest_first, wave};

/// Steps to the best order near one.
const STEPS: usize = 16;

/// Refused when a frequency in time was found that an order of the spindle explains as well.
///
/// In one pass at one speed the two are one: such a line is nobody's until the speed is changed, or the axis
/// turns back.
pub(super) fn turns_as_well(problem: &Problem, now: &State, judged: &Judged) -> Option<Refusal> {
    judged.component.term.frequency_hz()?;
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

/// The order of the spindle that explains most in the place of an effect, and by how much the effect is ahead of it:
/// that of the strongest line, or what the frequency of the effect is at the record's own speed.
fn ahead_of_orders(problem: &Problem, now: &State, judged: &Judged) -> Option<(f64, f64)> {
    let stage = Stage::new(problem, &now.columns, &judged.fit.noises);
    let own = gain_at(&stage, &judged.component).map_or(0.0, |gain| gain.gain);
    let turns: Vec<f64> = problem.record.turns().collect();
    let of_row: Vec<f64> = problem.samples.iter().map(|&sample| turns[sample]).collect();
    let unit = problem.unit_column(judged.component.term.entry);
    let scan = turn_scan(&stage, &of_row, &unit);
    let (highest, measured) = match judged.component.term.frequency_hz() {
        Some(hertz) => (as_many_a_row(problem, hertz, &turns), MEASURED_ORDERS),
        None => (0.0, MEASURED_FOR_A_LISTED_ONE),
    };
    let scan = Scan { highest: scan.highest.max(highest), ..scan };
    let line = strongest_anywhere(&scan, &stage.target[..of_row.len()], measured);
    let best_near = |order: f64, turns: &[f64]| {
        let mut explained = |order: f64| stage.gain(&waves(problem, turns, order)).gain;
        let near = (order - scan.resolution(), order + scan.resolution());
        golden_maximum(&mut explained, near, STEPS)
    };
    let of_line = line.map(|order| best_near(order, &turns));
    let of_frequency =
        order_of_a_frequency(problem, judged, &turns).into_iter().flat_map(|order| {
            [best_near(order, &turns), best_near(order, &even_turns(problem, &turns, order))]
        });
    let best = of_line.into_iter().chain(of_frequency);
    let (order, gain) = best.max_by(|a, b| a.1.total_cmp(&b.1))?;
    Some((order, own - gain))
}

/// The frequency that explains most of those that are the strongest by a scan: where targets are visited by turns, a scan
/// takes many others for stronger.
fn strongest_anywhere(scan: &Scan<'_>, white: &[f64], measured: usize) -> Option<f64> {
    let points: Vec<Point> = strongest_first(scan.spectrum(white)).take(measured).collect();
    let gains = in_parallel(&points, |point| scan.gain(white, point.frequency));
    let best = points.iter().zip(gains).max_by(|a, b| a.1.total_cmp(&b.1))?;
    Some(best.0.frequency)
}

/// Orders up to here are as often aliases of others, from row to row, as frequencies up to one in time: among so many,
/// chance draws a frequency that is as good as a wave of the travel.
fn as_many_a_row(problem: &Problem, hertz: f64, turns: &[f64]) -> f64 {
    (hertz / usual_rate(&problem.record.time_s) + 1.5) * usual_rate(turns)
}

/// Turns as an even motion through each pass makes them, as far as rows lie within a part of a wave of it, or within
/// a step of a column that is held: angles that are stamped unevenly, or seldom, draw a wave of the spindle worse
/// than the clock does.
fn even_turns(problem: &Problem, turns: &[f64], order: f64) -> Vec<f64> {
    let record = &problem.record;
    let mut even = turns.to_vec();
    for rows in stretches(problem) {
        let (time_s, own) = (&record.time_s[rows.clone()], &turns[rows.clone()]);
        let [ones, time] = [&vec![1.0; own.len()], &time_s.to_vec()];
        let fit = least_squares::fit(&[ones, time], own);
        let off = (fit.residual_square / count(own.len())).sqrt();
        if off * order < OFF_AN_EVEN_MOTION || off < held_step(time_s, own) {
            let left = least_squares::left(&[ones, time], own, &fit.coefficients);
            even[rows].iter_mut().zip(left).for_each(|(turn, left)| *turn -= left);
        }
    }
    even
}

/// Step of angles that stand for a quarter of the rows or more though readings go on evenly: who reads them looks
/// seldom, or sees whole steps. An axis that rests moves for longer than a reading; 0 without such steps.
fn held_step(time_s: &[f64], turns: &[f64]) -> f64 {
    let steps = turns.windows(2).map(|two| (two[1] - two[0]).abs());
    let intervals_s: Vec<f64> = time_s.windows(2).map(|two| two[1] - two[0]).collect();
    let usual_s = median(&mut intervals_s.clone());
    let (mut moves, taken_s): (Vec<f64>, Vec<f64>) =
        steps.zip(intervals_s).filter(|(step, _)| 0.0 < *step).unzip();
    let stands = 4 * moves.len() < 3 * turns.len();
    let at_once = taken_s.iter().all(|taken_s| *taken_s < HELD_FOR * usual_s);
    if stands && at_once { median(&mut moves) } else { 0.0 }
}

/// Rows of each pass that go one way.
fn stretches(problem: &Problem) -> Vec<Range<usize>> {
    let direction = &problem.record.direction;
    let of_pass = |rows: Range<usize>| {
        let turned =
            (rows.start + 1..rows.end).filter(|&row| direction[row] * direction[row - 1] < 0.0);
        let starts: Vec<usize> = std::iter::once(rows.start).chain(turned).collect();
        let ends = starts.clone().into_iter().skip(1).chain([rows.end]);
        starts.into_iter().zip(ends).map(|(start, end)| start..end).collect::<Vec<_>>()
    };
    problem.record.passes().into_iter().flat_map(of_pass).collect()
}

/// What a frequency in time is as an order at the record's own speed.
fn order_of_a_frequency(problem: &Problem, judged: &Judged, turns: &[f64]) -> Option<f64> {
    let hertz = judged.component.term.frequency_hz()?;
    let passes = problem.record.passes();
    let of = |values: &[f64]| passes.iter().map(|rows| spread(&values[rows.clone()])).sum::<f64>();
    let order = hertz * of(&problem.record.time_s) / of(turns);
    order.is_finite().then_some(order)
}

/// Waves of an order, of any size and phase for each sensor.
fn waves(problem: &Problem, turns: &[f64], order: f64) -> Columns {
    let each = (0..problem.sensors.len()).map(|sensor| wave(problem, sensor, turns, order));
    Columns::free(each.flat_map(|columns| columns.raw))
}
