//! Columns that stand under each other's names, and an error under another's.

use helixlock_plant::prediction::Sensor;
use helixlock_plant::{Bridging, LOGGED_COLUMNS, LoggedColumn, Part};

use super::column::physics;
use super::doubt::{Doubt, said_by};
use super::hypothesis::{Hypothesis, Words};
use crate::measurement::{Measurement, sensor_column};
use crate::model::Problem;
use crate::numerics::count;
use crate::policy::mistakes::{
    DOUBT, GOES_BY_THE_CLOCK, NEAR_A_SPEED, RARER_THAN_A_SIGN, STANDS_BY_THE_CLOCK,
};

/// Every exchange of two readings of instruments, and of the errors.
pub(super) fn swaps(problem: &Problem) -> Vec<Hypothesis> {
    let read = LOGGED_COLUMNS.iter().filter(|column| column.bridging != Bridging::Never);
    let read: Vec<&LoggedColumn> = read.collect();
    let mut all = Vec::new();
    for (index, one) in read.iter().enumerate() {
        for other in &read[index + 1..] {
            all.extend(exchanged(problem, one, other));
        }
    }
    all.extend(another_sensor(problem));
    all
}

/// Only readings of one unit, which nobody would miss by looking at them, may be exchanged where the file has no
/// effect of them: a pitch under the name of a temperature would make air of whatever leans.
fn exchanged(problem: &Problem, one: &LoggedColumn, other: &LoggedColumn) -> Vec<Hypothesis> {
    let is_alike = one.units.first() == other.units.first();
    let (one, other) = (one.name, other.name);
    let logged = &problem.measurement.covariates;
    let (Some(first), Some(second)) = (logged.get(one), logged.get(other)) else {
        return Vec::new();
    };
    let mut mended = problem.measurement.clone();
    mended.samples.covariates.insert(one.to_owned(), second.clone());
    mended.samples.covariates.insert(other.to_owned(), first.clone());
    let more = if is_alike { physics(problem, &[one, other]) } else { Vec::new() };
    let sets = std::iter::once(Vec::new()).chain(more);
    sets.filter_map(|more| Hypothesis::with(problem, &mended, &more, words(one, other))).collect()
}

fn words(one: &str, other: &str) -> Words {
    let says = format!("columns `{one}` and `{other}` are exchanged (swapped)");
    ("swap", says, format!("{}\n{}", read_as(one, other), read_as(other, one)))
}

fn read_as(from: &str, to: &str) -> String {
    format!("[[column]]\nfrom = \"{from}\"\nto = \"{to}\"")
}

/// The thread's error under the recorder's name, or the other way round.
fn another_sensor(problem: &Problem) -> Option<Hypothesis> {
    let [sensor] = *problem.sensors else { return None };
    let other = match sensor {
        Sensor::Recorder => Sensor::Thread,
        Sensor::Thread => Sensor::Recorder,
        Sensor::Counter => return None,
    };
    if problem.model.lacks(&[Part::Table, Part::Workpiece]).is_some() {
        return None;
    }
    let [found, meant] = [sensor, other].map(|sensor| sensor_column(sensor, false));
    let mut mended = problem.measurement.clone();
    let values = mended.observations.remove(&sensor)?;
    mended.observations.insert(other, values);
    let says = format!("`{found}` behaves as `{meant}` does: it has the other's name");
    let words = ("swap", says, read_as(found, meant));
    let one = Hypothesis::of_measurement(problem, &mended, words)?;
    Some(Hypothesis { usual: 2.0 * libm::log(RARER_THAN_A_SIGN), ..one })
}

/// The doubt, where the error goes as the clock says that the travel does, and the position does not.
pub(super) fn place_for_error(problem: &Problem) -> Option<Doubt> {
    let measurement = &problem.measurement;
    let (&sensor, values) = measurement.observations.iter().next()?;
    if !measurement.timed {
        return None;
    }
    let (place, a_turn) = if measurement.rotary {
        ("angle_rev", 1.0)
    } else {
        ("position_mm", problem.model.workpiece.lead.mm())
    };
    let turns: Vec<f64> = values.iter().map(|value| value / a_turn).collect();
    let nominal = problem.model.spindle.speed_rpm;
    let [error, own] = [&turns, &measurement.angle_rev]
        .map(|turns| rows_by_the_clock(measurement, nominal, turns));
    let rows = count(measurement.len());
    let is_so = GOES_BY_THE_CLOCK * rows < count(error) && count(own) < STANDS_BY_THE_CLOCK * rows;
    let (what, says, mend) = words(sensor_column(sensor, measurement.rotary), place);
    let evidence = said_by(error);
    (is_so && DOUBT < evidence).then_some(Doubt { what, evidence, says, mend })
}

/// Rows that are so far from the one before as the axis goes at its speed meanwhile.
fn rows_by_the_clock(measurement: &Measurement, nominal_rpm: f64, turns: &[f64]) -> usize {
    let (time_s, pass) = (&measurement.time_s, &measurement.pass);
    let is_so = |&row: &usize| {
        let rpm = 60.0 * (turns[row] - turns[row - 1]).abs() / (time_s[row] - time_s[row - 1]);
        let off = libm::log(rpm / measurement.told_rpm(row, nominal_rpm)).abs();
        pass[row] == pass[row - 1] && off < NEAR_A_SPEED
    };
    (1..turns.len()).filter(is_so).count()
}
