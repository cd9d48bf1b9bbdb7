//! Columns that stand under each other's names.

use super::column::physics;
use super::hypothesis::Hypothesis;
use super::law::usualness;
use crate::measurement::sensor_column;
use crate::model::Problem;

/// Columns of alike readings.
const ALIKE: [&str; 3] = ["air_temperature_c", "workpiece_temperature_c", "bed_temperature_c"];

/// Every exchange of two columns that nobody would notice by looking at them.
pub(super) fn swaps(problem: &Problem) -> Vec<Hypothesis> {
    let mut all = Vec::new();
    for (index, one) in ALIKE.iter().enumerate() {
        for other in &ALIKE[index + 1..] {
            all.extend(exchanged(problem, one, other));
        }
    }
    all.extend(place_for_error(problem));
    all
}

fn exchanged(problem: &Problem, one: &str, other: &str) -> Vec<Hypothesis> {
    let logged = &problem.measurement.covariates;
    let (Some(first), Some(second)) = (logged.get(one), logged.get(other)) else {
        return Vec::new();
    };
    let mut mended = problem.measurement.clone();
    mended.samples.covariates.insert(one.to_owned(), second.clone());
    mended.samples.covariates.insert(other.to_owned(), first.clone());
    let sets = std::iter::once(Vec::new()).chain(physics(problem, &[one, other]));
    sets.filter_map(|more| Hypothesis::with(problem, &mended, &more, words(one, other))).collect()
}

fn words(one: &str, other: &str) -> (&'static str, String, String) {
    let says = format!("columns `{one}` and `{other}` are exchanged (swapped)");
    let read = |from: &str, to: &str| format!("[[column]]\nfrom = \"{from}\"\nto = \"{to}\"");
    ("swap", says, format!("{}\n{}", read(one, other), read(other, one)))
}

/// The error under the position's name: told by the travel and the speed alone, for what such a
/// file was read as is no record of the machine.
fn place_for_error(problem: &Problem) -> Option<Hypothesis> {
    let measurement = &problem.measurement;
    let (&sensor, values) = measurement.observations.iter().next()?;
    if measurement.rotary || !measurement.timed || values.iter().any(|value| !value.is_finite()) {
        return None;
    }
    let lead_mm = problem.model.workpiece.lead.mm();
    let mut mended = measurement.clone();
    mended.samples.position_mm = values.clone();
    mended.samples.angle_rev = values.iter().map(|place| place / lead_mm).collect();
    let (what, says, mend) = words(sensor_column(sensor, false), "position_mm");
    Some(Hypothesis {
        what,
        says,
        mend,
        mended: problem.clone(),
        physics: false,
        scales: false,
        usual: usualness(&mended, &problem.model) - usualness(measurement, &problem.model),
        numbers: 0.0,
        looks: 1.0,
        evidence: 0.0,
    })
}
