//! Places that are all longer or shorter than the file's: what comes with turns is the farther off, the farther on.

use super::doubt::recipe;
use super::hypothesis::{Hypothesis, Words};
use super::law::follows_from_clock;
use super::shift::{a_place, best, moved, stages};
use crate::measurement::Measurement;
use crate::model::{Problem, Stage};
use crate::noise::Noise;
use crate::policy::mistakes::FARTHEST_STRETCH;

/// Finest grid of longer places, as a power of a half.
const FINEST: i32 = 16;

/// Most places of a grid either way, as a power of two: the finest then is 0.2 % wide.
const PLACES: i32 = 7;

/// The factor of the places that brings what the file predicts nearest to the data, under each noise.
pub(super) fn stretches(problem: &Problem, noises: &[Vec<Noise>]) -> Vec<Hypothesis> {
    if problem.model.effects.is_empty() {
        return Vec::new();
    }
    let stages = stages(problem, noises);
    stages.iter().filter_map(hypothesis).collect()
}

fn hypothesis(stage: &Stage<'_>) -> Option<Hypothesis> {
    let problem = stage.problem;
    let before = problem.predicted_of(&problem.measurement).ok()?;
    let by = |longer: f64| moved(problem, &stretched(&problem.measurement, longer), &before);
    let power = a_place(problem, &by, FARTHEST_STRETCH + 1..FINEST)?;
    let places = 1 << (power - FARTHEST_STRETCH).min(PLACES);
    let (longer, looks) = best(stage, &by, (libm::exp2(-f64::from(power)), places))?;
    let mended = stretched(&problem.measurement, longer);
    let one = Hypothesis::of_measurement(problem, &mended, words(problem, 1.0 + longer))?;
    Some(Hypothesis { numbers: 1.0, looks, usual: 0.0, ..one })
}

fn stretched(measurement: &Measurement, longer: f64) -> Measurement {
    let mut mended = measurement.clone();
    let samples = &mut mended.samples;
    let places = samples.position_mm.iter_mut().chain(samples.angle_rev.iter_mut());
    places.for_each(|place| *place *= 1.0 + longer);
    mended
}

fn words(problem: &Problem, times: f64) -> Words {
    let measurement = &problem.measurement;
    if follows_from_clock(measurement, &problem.model) {
        let says = format!("the axis turns {times:.5} times as fast as the file says");
        let rpm = times * problem.model.spindle.speed_rpm;
        return ("scale", says, format!("[spindle]\nspeed = \"{rpm:.5e} rpm\""));
    }
    let (column, unit) =
        if measurement.rotary { ("angle_rev", "rev") } else { ("position_mm", "mm") };
    let says = format!(
        "`{column}` is written in units of {times:.5} {unit}, or the leads and gears of the file are {times:.5} times the true ones"
    );
    ("scale", says, recipe(column, &format!("unit = \"{times:.6} {unit}\"")))
}
