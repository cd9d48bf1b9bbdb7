//! Wrong sign or unit of a sensor's column.
//!
//! With noise of any size a column times k is as likely as the prediction divided by k.

use helixlock_plant::LoggedColumn;
use helixlock_plant::prediction::Sensor;

use super::column::others;
use super::common::{curves, slopes};
use super::doubt::recipe;
use super::hypothesis::Hypothesis;
use super::law::size_of_error;
use super::view::View;
use crate::measurement::sensor_column;
use crate::model::Problem;
use crate::noise::Noise;
use crate::numerics::count;
use crate::policy::mistakes::MACHINE_OF_EFFECTS;
use crate::policy::size::WORTHWHILE_UM;

/// Every sign and unit that a sensor's column may have been written with.
pub(super) fn factors(problem: &Problem) -> Vec<Hypothesis> {
    let rotary = problem.measurement.rotary;
    if !predicts_a_shape(problem) {
        return Vec::new();
    }
    let mut all = Vec::new();
    for (index, &sensor) in problem.sensors.iter().enumerate() {
        let column = sensor_column(sensor, rotary);
        let flipped = format!("`{column}` has the opposite sign of what the file predicts");
        all.push(scaled(problem, index, ("sign", flipped, "sign = -1".to_owned()), -1.0));
        if sensor == Sensor::Counter {
            continue;
        }
        let Some(known) = LoggedColumn::named(column) else { continue };
        if MACHINE_OF_EFFECTS <= problem.model.effects.len() {
            all.extend(slips(problem, index, known));
        }
        for (unit, factor, _) in others(known) {
            for (sign, turned) in [(1.0, ""), (-1.0, ", with the opposite sign")] {
                let written = known.units[0].0;
                let says =
                    format!("`{column}` is in {unit}, not in {written}: factor {factor}{turned}");
                let unit = format!("unit = \"{unit}\"");
                let how = if sign < 0.0 { format!("{unit}\nsign = -1") } else { unit };
                all.push(scaled(problem, index, ("unit", says, how), sign * factor));
            }
        }
    }
    all
}

/// A decimal point that slipped, a diameter for a radius, a beam that went there and back twice. One effect
/// alone may have grown by so much.
fn slips(problem: &Problem, sensor: usize, column: &LoggedColumn) -> [Hypothesis; 4] {
    let (name, written) = (column.name, column.units[0].0);
    let tens = |factor: f64| format!("`{name}` is written in units of {factor} {written}");
    let all = [
        (10.0, tens(10.0)),
        (0.1, tens(0.1)),
        (2.0, format!("`{name}` is half of what the file predicts: radii for diameters?")),
        (0.5, format!("`{name}` is twice what the file predicts: diameters for radii?")),
    ];
    all.map(|(factor, says)| {
        let how = format!("unit = \"{factor} {written}\"");
        scaled(problem, sensor, ("unit", says, how), factor)
    })
}

/// True when more than slopes and drifts is predicted: what is less than a sensor shows would,
/// times a million, be as large as anything.
fn predicts_a_shape(problem: &Problem) -> bool {
    let noises = vec![Noise::white(); problem.sensors.len()];
    let view = View::new(problem, &slopes(problem).and(&curves(problem)), &noises);
    let size_um = (view.square(problem.predicted.to_vec()) / count(problem.samples.len())).sqrt();
    WORTHWHILE_UM < size_um
}

fn scaled(
    problem: &Problem,
    sensor: usize,
    (what, says, how): (&'static str, String, String),
    k: f64,
) -> Hypothesis {
    let column = sensor_column(problem.sensors[sensor], problem.measurement.rotary);
    let mut mended = problem.clone();
    for block in problem.layout.blocks.iter().filter(|block| block.sensor == sensor) {
        mended.predicted[block.rows.clone()].iter_mut().for_each(|value| *value /= k);
    }
    let values = &problem.measurement.observations[&problem.sensors[sensor]];
    Hypothesis {
        what,
        says,
        mend: recipe(column, &how),
        mended,
        physics: false,
        scales: true,
        usual: size_of_error(values, k.abs()) - size_of_error(values, 1.0),
        numbers: 0.0,
        looks: 1.0,
        evidence: 0.0,
    }
}
