//! An effect drawn over the data before it is taken: as fitted, or as its sliders stand.

use std::collections::BTreeMap;

use anyhow::Context;
use helixlock_lab::{Problem, sensor_column};
use helixlock_plant::{MachineFile, Model};
use serde::{Deserialize, Serialize};

use super::frame::Frame;
use super::opened::{Opened, about_zero, count};
use super::refusal::Answered;

/// Values of the effect's parameters that differ from the fitted ones, by their keys.
#[derive(Debug, Default, Deserialize)]
pub(crate) struct Moved {
    values: BTreeMap<String, f64>,
}

#[derive(Serialize)]
struct TrialJson {
    sensors: Vec<SensorJson>,
    /// Values of the last effect as drawn.
    values: BTreeMap<String, f64>,
}

/// What one sensor's error becomes.
#[derive(Serialize)]
struct SensorJson {
    sensor: &'static str,
    rms_before: f64,
    rms_after: f64,
}

/// What a machine file with one more effect leaves.
pub(crate) fn trial(opened: &Opened, file: &MachineFile, moved: &Moved) -> Answered {
    let mut model = file.model.clone();
    let gained = opened.problem.model.effects.len() < model.effects.len();
    let values = if gained { turn(&mut model, moved) } else { BTreeMap::new() };
    let problem = Problem::new(&model, &opened.problem.measurement)
        .context("the effect cannot be drawn over these data")?;
    let after = problem.residual();
    let sizes = |residual: &[f64]| sizes(&opened.problem, residual);
    let (before, now) = (sizes(&opened.residual), sizes(&after));
    let rotary = problem.measurement.rotary;
    let sensors = problem.sensors.iter().zip(before.into_iter().zip(now));
    let sensors = sensors.map(|(sensor, (rms_before, rms_after))| SensorJson {
        sensor: sensor_column(*sensor, rotary),
        rms_before,
        rms_after,
    });
    let mut frame = Frame::default();
    frame.push_f32("residual", &after);
    frame.answer(&TrialJson { sensors: sensors.collect(), values })
}

/// Puts moved values into the last effect; gives all its values by their keys.
fn turn(model: &mut Model, moved: &Moved) -> BTreeMap<String, f64> {
    let Some(term) = model.effects.last_mut() else { return BTreeMap::new() };
    let keys: Vec<String> = term.parameters.iter().map(helixlock_plant::Parameter::key).collect();
    for (key, value) in keys.iter().zip(&mut term.values) {
        *value = moved.values.get(key).copied().unwrap_or(*value);
    }
    keys.into_iter().zip(term.values.iter().copied()).collect()
}

/// Root mean square of each sensor's rows about the zero of each pass.
fn sizes(problem: &Problem, residual: &[f64]) -> Vec<f64> {
    let centred = about_zero(problem, residual);
    let size = |sensor: usize| {
        let blocks = problem.layout.blocks.iter().filter(|block| block.sensor == sensor);
        let (mut square, mut rows) = (0.0, 0);
        for block in blocks {
            let part = &centred[block.rows.clone()];
            square += part.iter().map(|value| value * value).sum::<f64>();
            rows += part.len();
        }
        (square / count(rows)).sqrt()
    };
    (0..problem.sensors.len()).map(size).collect()
}
