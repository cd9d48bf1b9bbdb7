//! A clock in another unit: between time, speed and travel then stands the factor of a unit.

use helixlock_plant::{HeaderUnit, LoggedColumn, Machine};

use super::column::others;
use super::doubt::{Doubt, recipe, said_by};
use super::law::{follows_from_clock, travel};
use crate::measurement::{Measurement, Restart};
use crate::numerics::median;
use crate::policy::mistakes::{A_ROW_AT_A_UNIT, AT_A_UNIT};

/// Rows from one to the next that a speed is read from: neighbours, and those so far apart that a clock
/// which is rounded in another unit tells them.
const ROWS_APART: [usize; 2] = [1, 16];

/// The doubt, where the table moves faster or slower than its speed by the factor of a unit of time.
///
/// Where the axis dwells, or the speed is nominal only, another factor would come out, and no one
/// factor in most rows.
pub(super) fn contradicted(measurement: &Measurement, machine: &Machine) -> Option<Doubt> {
    if !measurement.timed || follows_from_clock(measurement, machine) {
        return None;
    }
    ROWS_APART.iter().find_map(|apart| by_rows(measurement, machine, *apart))
}

fn by_rows(measurement: &Measurement, machine: &Machine, apart: usize) -> Option<Doubt> {
    let ratios = ratios(measurement, machine, apart);
    let usual = median(&mut ratios.clone());
    let off = |factor: f64| move |ratio: f64| libm::log(ratio / factor).abs();
    let is_at = |unit: &&&HeaderUnit| off(unit.1)(usual) < AT_A_UNIT;
    let units = others(LoggedColumn::named("time_s")?);
    let (word, factor, _) = **units.iter().find(is_at)?;
    let so = ratios.iter().filter(|ratio| off(factor)(**ratio) < A_ROW_AT_A_UNIT).count();
    if 2 * so < ratios.len() || travel_would_be(measurement, machine, factor) {
        return None;
    }
    let (says, mend) = said(measurement, machine, (word, factor));
    Some(Doubt { what: "unit", evidence: said_by(so), says, mend })
}

/// The doubt, where a clock began anew among the rows of a pass: which were taken one after the other, not by turns.
pub(super) fn restarted(measurement: &Measurement) -> Option<Doubt> {
    let Restart { pass, by_s } = measurement.restart?;
    Some(Doubt {
        what: "clock",
        evidence: said_by(measurement.time_s.len()),
        says: format!("the clock of pass {pass} falls by {by_s:.3} s and goes on from there"),
        mend: "give the rows from there on a `pass` of their own".to_owned(),
    })
}

/// Speed by travel and clock over the speed told, by its column or the machine file, from every so
/// many rows to the next.
fn ratios(measurement: &Measurement, machine: &Machine, apart: usize) -> Vec<f64> {
    let nominal = machine.spindle.speed_rpm;
    let ratio = |(row, rpm): (usize, f64)| rpm / measurement.told_rpm(row, nominal);
    let all = measurement.clocked(apart).map(ratio);
    all.filter(|ratio| ratio.is_finite() && 0.0 < *ratio).collect()
}

/// True when the travel in another unit would be nearer to the workpiece's: then it is that.
fn travel_would_be(measurement: &Measurement, machine: &Machine, factor: f64) -> bool {
    travel(measurement, machine, 1.0) < travel(measurement, machine, factor.recip())
}

/// What is in which unit. A minute for a second is a revolution a minute for one a second; a
/// column of speeds may be told by the machine file's.
fn said(
    measurement: &Measurement,
    machine: &Machine,
    (word, factor): (&str, f64),
) -> (String, String) {
    let time = format!("`time_s` is in {word}, not in s");
    let mend = recipe("time_s", &format!("unit = \"{word}\""));
    let speed = "`speed_rpm` is in rev/s, not in rpm";
    let minutes = (factor - 60.0).abs() < 1.0;
    let nominal = machine.spindle.speed_rpm;
    let told = median(&mut measurement.speed_rpm.clone());
    let is_nominal = |rpm: f64| libm::log(rpm / nominal).abs() < A_ROW_AT_A_UNIT;
    match (minutes, measurement.told.speed) {
        (true, true) if is_nominal(60.0 * told) => {
            (speed.to_owned(), recipe("speed_rpm", "unit = \"1/s\""))
        }
        (true, true) if !is_nominal(told) => (format!("{time}, or {speed}"), mend),
        (true, false) => {
            (format!("{time}, or the machine file's speed is in rev/s, not in rpm"), mend)
        }
        _ => (time, mend),
    }
}
