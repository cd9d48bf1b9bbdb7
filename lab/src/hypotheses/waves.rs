//! Waves that a fit leaves: lines, and bands of frequencies that are none.

use super::probes::{Structure, matters, probes};
use helixlock_plant::Column;

use crate::model::{Columns, Fit, Problem, settle};
use crate::policy::chance::SIGNIFICANCE;
use crate::policy::extent::LISTED_LINES;
use crate::spectrum::{Line, LineSearch, wave};

/// Lines over the spindle angle and over time, sensor by sensor.
pub(super) fn lines(problem: &Problem, model: &Columns, fit: &Fit) -> Vec<Structure> {
    let mut found = Vec::new();
    for sensor in 0..problem.sensors.len() {
        for (along, coordinate, highest) in cyclic(problem) {
            let of = |fit: &Fit| {
                let search = LineSearch { problem, fit, sensor, coordinate: &coordinate, highest };
                Some(of_line(problem, along, search.strongest()?))
            };
            let taken_out = |order| wave(problem, sensor, &coordinate, order);
            found.extend(clearest_that_matters(problem, (model, fit), &of, &taken_out));
        }
    }
    found
}

/// The strongest line that is large enough to matter, or the strongest one where none is: a fine
/// line that is clear in low noise stands before no large one in slow noise.
fn clearest_that_matters(
    problem: &Problem,
    (model, fit): (&Columns, &Fit),
    strongest: &impl Fn(&Fit) -> Option<Structure>,
    taken_out: &impl Fn(f64) -> Columns,
) -> Option<Structure> {
    let first = strongest(fit)?;
    let (mut columns, mut now, mut line) = (model.clone(), fit.clone(), first.clone());
    for _ in 1..LISTED_LINES {
        if SIGNIFICANCE <= line.p_value || matters(problem, fit, line.rms_um, line.p_value) {
            break;
        }
        columns = columns.and(&taken_out(line.at?));
        now = settle(problem, &columns, &now.noises);
        line = strongest(&now)?;
    }
    Some(if matters(problem, fit, line.rms_um, line.p_value) { line } else { first })
}

fn of_line(problem: &Problem, along: &str, line: Line) -> Structure {
    Structure {
        along: along.to_owned(),
        shape: format!("sinusoid of amplitude {:.3}", line.amplitude),
        rms_um: line.amplitude / std::f64::consts::SQRT_2,
        p_value: (probes(problem) * line.p_value).min(1.0),
        at: Some(line.frequency),
        at_stderr: Some(line.frequency_stderr),
        line: Some(line),
    }
}

/// Bands over the spindle angle and over time, sensor by sensor.
pub(super) fn bands(problem: &Problem, fit: &Fit) -> Vec<Structure> {
    let mut found = Vec::new();
    for sensor in 0..problem.sensors.len() {
        for (along, coordinate, highest) in cyclic(problem) {
            let search = LineSearch { problem, fit, sensor, coordinate: &coordinate, highest };
            let Some(band) = search.band() else { continue };
            let p_value = (probes(problem) * band.p_value).min(1.0);
            let shape =
                format!("uneven waves, or of changing length, in a band {:.3} wide", band.width);
            let told = Structure::without_place(along, &shape, band.rms, p_value);
            found.push(Structure { at: Some(band.frequency), ..told });
        }
    }
    found
}

/// Name, values and highest frequency of every coordinate that lines are looked for in.
fn cyclic(problem: &Problem) -> Vec<(&'static str, Column, f64)> {
    let mut axes = vec![("spindle order", problem.record.turns().collect(), problem.highest_order)];
    if 1 < problem.record.passes().len() && problem.measurement.timed {
        axes.push(("frequency in time", problem.record.time_s.clone(), problem.highest_hz));
    }
    axes
}
