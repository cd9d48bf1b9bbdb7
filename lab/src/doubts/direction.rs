//! A direction that says the other way than the travel goes.

use super::doubt::recipe;
use super::hypothesis::Hypothesis;
use crate::measurement::Measurement;
use crate::model::Problem;

/// The direction turned, where it denies most of the way that was gone.
pub(super) fn turned(problem: &Problem) -> Option<Hypothesis> {
    let measurement = &problem.measurement;
    if 0.0 <= way_along(measurement) {
        return None;
    }
    let direction = measurement.direction.iter().map(|way| -way).collect();
    let mended = Measurement { direction, ..measurement.clone() };
    let says = "`direction` is -1 where the travel rises".to_owned();
    Hypothesis::of_measurement(problem, &mended, ("sign", says, recipe("direction", "sign = -1")))
}

/// Way inside the passes, counted as the direction has it.
fn way_along(measurement: &Measurement) -> f64 {
    let (place, pass) = (&measurement.angle_rev, &measurement.pass);
    let rows = 1..place.len();
    let inside = rows.filter(|&row| pass[row] == pass[row - 1]);
    inside.map(|row| measurement.direction[row] * (place[row] - place[row - 1])).sum()
}
