//! Waves that a fit leaves: lines, bands of frequencies that are none, and combs of them.

use super::probes::{Structure, asked, matters, of_all, probes};
use helixlock_plant::Column;

use crate::model::{Columns, Fit, Problem, settle};
use crate::numerics::{spread, usual_rate};
use crate::policy::chance::SIGNIFICANCE;
use crate::policy::extent::LISTED_LINES;
use crate::spectrum::{Line, LineSearch, wave};

/// Lines over the spindle angle and over time, sensor by sensor.
pub(super) fn lines(problem: &Problem, model: &Columns, fit: &Fit) -> Vec<Structure> {
    let mut found = Vec::new();
    for sensor in 0..problem.sensors.len() {
        for Cyclic { frequency, values, highest, .. } in cyclic(problem) {
            let of = |fit: &Fit| {
                let search = LineSearch { problem, fit, sensor, coordinate: &values, highest };
                let line = search.strongest()?;
                let drawn_by = wave(problem, sensor, &values, line.frequency).raw;
                Some(of_line(problem, frequency, line).drawn_by(drawn_by))
            };
            found.extend(clearest_that_matters(problem, (model, fit), &of));
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
) -> Option<Structure> {
    let first = strongest(fit)?;
    let (mut columns, mut now, mut line) = (model.clone(), fit.clone(), first.clone());
    for _ in 1..LISTED_LINES {
        if SIGNIFICANCE <= line.p_value || matters(problem, fit, line.rms_um, line.p_value) {
            break;
        }
        columns = columns.and(&Columns::free(line.drawn_by));
        now = settle(problem, &columns, &now.noises);
        line = strongest(&now)?;
    }
    Some(if matters(problem, fit, line.rms_um, line.p_value) { line } else { first })
}

fn of_line(problem: &Problem, along: &str, line: Line) -> Structure {
    let shape = format!("sinusoid of amplitude {:.3}", line.amplitude);
    let rms_um = line.amplitude / std::f64::consts::SQRT_2;
    let p_value = of_all(problem, line.p_value);
    let told = Structure::without_place(along, &shape, rms_um, p_value);
    let (at, at_stderr) = (Some(line.frequency), Some(line.frequency_stderr));
    Structure { at, at_stderr, line: Some(line), ..told }
}

/// Bands over the spindle angle and over time, sensor by sensor; where a clock begins anew in each pass also over
/// the time that has gone, for a wave with a phase of its own in each is a band there.
pub(super) fn bands(problem: &Problem, fit: &Fit) -> Vec<Structure> {
    let axes: Vec<Cyclic> = cyclic(problem).into_iter().chain(time_gone(problem)).collect();
    let mut found = Vec::new();
    for sensor in 0..problem.sensors.len() {
        for &Cyclic { frequency, ref values, highest, .. } in &axes {
            let search = LineSearch { problem, fit, sensor, coordinate: values, highest };
            let Some(band) = search.band() else { continue };
            let p_value = of_all(problem, band.p_value);
            let shape =
                format!("uneven waves, or of changing length, in a band {:.3} wide", band.width);
            let told = Structure::without_place(frequency, &shape, band.rms, p_value);
            found.push(Structure { at: Some(band.frequency), ..told });
        }
    }
    found
}

/// Combs of frequencies over the spindle angle, over time and over the way, sensor by sensor: what all harmonics show
/// beside the strongest, the noise fitted anew.
pub(super) fn combs(problem: &Problem, model: &Columns, fit: &Fit) -> Vec<Structure> {
    let axes: Vec<Cyclic> = cyclic(problem).into_iter().chain(way(problem)).collect();
    let of = |sensor: usize, axis: &Cyclic| {
        let Cyclic { frequency, values, highest, .. } = axis;
        let search = LineSearch { problem, fit, sensor, coordinate: values, highest: *highest };
        let comb = search.comb()?;
        let harmonic =
            |times: &u32| wave(problem, sensor, values, f64::from(*times) * comb.frequency);
        let with_one = model.and(&harmonic(&comb.strongest));
        let before = settle(problem, &with_one, &fit.noises);
        let others: Vec<Column> =
            comb.others.iter().flat_map(|times| harmonic(times).raw).collect();
        let looks = (probes(problem) * comb.looks, SIGNIFICANCE);
        let (rms_um, p_value) = asked(problem, (&with_one, &before), &others, looks);
        let shape = "comes again evenly, in no smooth shape";
        let told = Structure::without_place(frequency, shape, rms_um, p_value);
        Some(Structure { at: Some(comb.frequency), ..told })
    };
    let sensors = 0..problem.sensors.len();
    sensors.flat_map(|sensor| axes.iter().filter_map(move |axis| of(sensor, axis))).collect()
}

/// A coordinate that waves are looked for in.
pub(super) struct Cyclic {
    /// What it is, and what a frequency over it is called.
    pub(super) along: &'static str,
    pub(super) frequency: &'static str,
    pub(super) values: Column,
    /// Highest frequency that its samples resolve.
    pub(super) highest: f64,
}

/// The spindle's turns, and time, which is travel in a single pass of one way and speed.
pub(super) fn cyclic(problem: &Problem) -> Vec<Cyclic> {
    let mut axes = vec![Cyclic {
        along: "position",
        frequency: "spindle order",
        values: problem.record.turns().collect(),
        highest: problem.highest_order(),
    }];
    if problem.measurement.timed && !time_is_travel(problem) {
        axes.push(Cyclic {
            along: "time",
            frequency: "frequency in time",
            values: problem.record.time_s.clone(),
            highest: problem.highest_hz(),
        });
    }
    axes
}

/// The way that the axis has gone since the record began, in turns, where it is not the angle.
fn way(problem: &Problem) -> Option<Cyclic> {
    let once = problem.record.passes().len() == 1 && spread(&problem.record.direction) <= 0.0;
    if once {
        return None;
    }
    let values = gone_through(problem.record.turns());
    let highest = 0.5 * usual_rate(&values);
    let frequency = "order of the way";
    Some(Cyclic { along: "way", frequency, values: values.into(), highest })
}

/// The time that has gone since the record began, where a clock begins anew in each pass.
fn time_gone(problem: &Problem) -> Option<Cyclic> {
    let measurement = &problem.measurement;
    (measurement.timed && !measurement.tells_pauses()).then(|| Cyclic {
        along: "time",
        frequency: "frequency in time",
        values: gone_through(problem.record.time_s.iter().copied()).into(),
        highest: problem.highest_hz(),
    })
}

/// The sum of all steps up to each value.
fn gone_through(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut before = None;
    let mut gone = 0.0;
    values
        .map(|value| {
            gone += before.replace(value).map_or(0.0, |before: f64| (value - before).abs());
            gone
        })
        .collect()
}

fn time_is_travel(problem: &Problem) -> bool {
    let one_way = problem.record.direction.windows(2).all(|pair| 0.0 <= pair[0] * pair[1]);
    problem.record.passes().len() == 1 && one_way && problem.velocity_rpm().is_none()
}
