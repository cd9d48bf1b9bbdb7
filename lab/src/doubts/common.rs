//! What every measurement has of its own: no mistake is seen by a slope, a curve or a drift.

use crate::model::{Columns, Problem};

/// Straight lines over the way, a sensor each.
pub(super) fn slopes(problem: &Problem) -> Columns {
    let turns: Vec<f64> = problem.record.turns().collect();
    a_sensor_each(problem, &[&|sample| turns[sample]])
}

/// Parabolas over the way, and straight lines in time, a sensor each.
pub(super) fn curves(problem: &Problem) -> Columns {
    let turns: Vec<f64> = problem.record.turns().collect();
    let time_s = &problem.record.time_s;
    a_sensor_each(problem, &[&|sample| turns[sample] * turns[sample], &|sample| time_s[sample]])
}

/// A straight line and a parabola over the way of one pass, a sensor each.
pub(super) fn curve_of(problem: &Problem, pass: usize) -> Columns {
    let turns: Vec<f64> = problem.record.turns().collect();
    let own = |sample: usize| problem.record.pass[sample] == pass;
    let line = |sample: usize| if own(sample) { turns[sample] } else { 0.0 };
    a_sensor_each(problem, &[&line, &|sample| turns[sample] * line(sample)])
}

fn a_sensor_each(problem: &Problem, shapes: &[&dyn Fn(usize) -> f64]) -> Columns {
    let sensors = 0..problem.sensors.len();
    let column = |sensor: usize| shapes.iter().map(move |shape| problem.alone(sensor, shape));
    Columns::free(sensors.flat_map(column))
}
