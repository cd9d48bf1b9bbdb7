//! The learned machine run clock by clock in its closed loop, against what was measured there.
//!
//! A search fits closed forms, which take the loop to be perfect. The run has the loop's hunting,
//! lag and slew in it, and shows whether the learned effects do in the machine what the fit says.

use helixlock_plant::prediction::Sensor;
use helixlock_plant::{Column, Model};
use helixlock_sim::{Error, Options, Simulation, Trace, simulate};

use crate::model::Problem;
use crate::numerics::count;
use crate::policy::extent::PULLING_IN;

/// What the run shows of one sensor.
#[derive(Debug, Clone)]
pub struct SensorCheck {
    /// The sensor.
    pub sensor: Sensor,
    /// Samples compared.
    pub samples: usize,
    /// Root mean square of measured less simulated with the file's machine, µm.
    pub before_um: f64,
    /// The same with the learned machine, µm.
    pub after_um: f64,
    /// Travel, measured and simulated, both about their mean: mm, µm, µm.
    pub points: Vec<[f64; 3]>,
}

/// What the run shows.
#[derive(Debug, Clone)]
pub struct FinalCheck {
    /// Name of the pass that was simulated.
    pub pass: f64,
    /// Root mean square of measured less simulated hunting, µm: the two are not in step, and both
    /// stand at an end of their swing whenever a comparison is made. Less cannot be expected of
    /// what was sampled at comparisons.
    pub hunting_um: f64,
    /// One entry a sensor.
    pub sensors: Vec<SensorCheck>,
    /// Effects that the run could not contain, because they need a log.
    pub left_out: Vec<String>,
}

/// Simulates both machines in closed loop and compares them with the first forward pass.
///
/// `None` when no pass runs forward all the way.
///
/// # Errors
///
/// [`Error`] when the device cannot serve the machine.
pub fn final_check(
    problem: &Problem,
    file: &Model,
    learned: &Model,
) -> Result<Option<FinalCheck>, Error> {
    let Some(rows) = forward_pass(problem) else { return Ok(None) };
    let end_mm = problem.record.position_mm[rows.end - 1];
    let before = run(file, end_mm)?;
    let after = run(learned, end_mm)?;
    let check = |(sensor, values): (Sensor, Column)| {
        let series = Series { problem, rows: rows.clone(), values: &values };
        let step_um = learned.drive.step_um;
        let points = series.against(&shown(&after.closed.trace, sensor, step_um));
        (PULLING_IN < points.len()).then(|| SensorCheck {
            sensor,
            samples: points.len(),
            before_um: distance_um(&series.against(&shown(&before.closed.trace, sensor, step_um))),
            after_um: distance_um(&points),
            points,
        })
    };
    Ok(Some(FinalCheck {
        pass: problem.measurement.pass_names[problem.record.pass[rows.start]],
        hunting_um: after.course.swing_um / f64::sqrt(2.0),
        sensors: measured(problem).into_iter().filter_map(check).collect(),
        left_out: after.left_out.into_iter().map(|one| one.effect).collect(),
    }))
}

fn run(model: &Model, end_mm: f64) -> Result<Simulation, Error> {
    let mut model = model.clone();
    model.machine.loop_closed = true;
    let options = Options { length_mm: Some(end_mm) };
    simulate(&model, &options, &mut |_| {})
}

/// Samples of the first pass whose travel never falls.
fn forward_pass(problem: &Problem) -> Option<std::ops::Range<usize>> {
    let position_mm = &problem.record.position_mm;
    problem.record.passes().into_iter().find(|rows| {
        let steps = position_mm[rows.clone()].windows(2);
        let (mut forward, mut moves) = (true, false);
        for pair in steps {
            forward &= pair[0] <= pair[1];
            moves |= pair[0] < pair[1];
        }
        forward && moves
    })
}

/// Values of each sensor in µm; steps that a capture knows count as a counter.
fn measured(problem: &Problem) -> Vec<(Sensor, Column)> {
    let measurement = &problem.measurement;
    if let Some(steps) = measurement.covariates.get("steps") {
        let step_um = problem.model.drive.step_um;
        return vec![(Sensor::Counter, steps.iter().map(|steps| steps * step_um).collect())];
    }
    measurement.observations.iter().map(|(sensor, values)| (*sensor, values.clone())).collect()
}

/// `(travel, reading)` of a run, in µm, once the loop has pulled in.
fn shown(trace: &Trace, sensor: Sensor, step_um: f64) -> Vec<[f64; 2]> {
    let value = |row: usize| match sensor {
        Sensor::Recorder => trace.filtered_error_um[row],
        Sensor::Counter => step_um * steps(trace.steps[row]),
        Sensor::Thread => trace.lead_error_um[row],
    };
    (PULLING_IN..trace.position_mm.len()).map(|row| [trace.position_mm[row], value(row)]).collect()
}

#[expect(clippy::cast_precision_loss, reason = "the counter holds 4095 steps")]
fn steps(steps: i64) -> f64 {
    steps as f64
}

/// What one sensor measured in one pass.
struct Series<'a> {
    problem: &'a Problem,
    rows: std::ops::Range<usize>,
    values: &'a [f64],
}

impl Series<'_> {
    /// Travel, measured, simulated; the last two about their mean.
    fn against(&self, shown: &[[f64; 2]]) -> Vec<[f64; 3]> {
        let position_mm = &self.problem.record.position_mm;
        let mut points: Vec<[f64; 3]> = self
            .rows
            .clone()
            .filter(|&row| self.values[row].is_finite())
            .filter_map(|row| {
                let simulated = interpolated(shown, position_mm[row])?;
                Some([position_mm[row], self.values[row], simulated])
            })
            .collect();
        for column in [1, 2] {
            let mean = points.iter().map(|point| point[column]).sum::<f64>() / count(points.len());
            for point in &mut points {
                point[column] -= mean;
            }
        }
        points
    }
}

/// Straight between the two neighbours; `None` outside.
fn interpolated(points: &[[f64; 2]], x: f64) -> Option<f64> {
    let after = points.partition_point(|point| point[0] < x);
    let ([x0, y0], [x1, y1]) = (*points.get(after.checked_sub(1)?)?, *points.get(after)?);
    Some(y0 + (y1 - y0) * (x - x0) / (x1 - x0))
}

fn distance_um(points: &[[f64; 3]]) -> f64 {
    let square: f64 = points.iter().map(|[_, seen, said]| (seen - said) * (seen - said)).sum();
    (square / count(points.len().max(1))).sqrt()
}
