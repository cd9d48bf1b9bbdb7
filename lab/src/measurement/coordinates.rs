//! Where and when each row was taken; what is missing follows from lead and speed.

use helixlock_traces::Table;

use super::error::LabError;
use super::{Nominal, clock_ticks, headers};
use crate::numerics::spread;
use crate::policy::reading::{AS_FAR, CLOCK_S, LATE};

/// Coordinates of the rows of a table, in the order of the file; NaN where unknown.
#[derive(Debug, Clone)]
pub(crate) struct Coordinates {
    pub(crate) time_s: Vec<f64>,
    pub(crate) position_mm: Vec<f64>,
    pub(crate) angle_rev: Vec<f64>,
    pub(crate) timed: bool,
    pub(crate) placed: bool,
    pub(crate) notes: Vec<String>,
}

impl Coordinates {
    pub(crate) fn usable(&self, row: usize) -> bool {
        self.time_s[row].is_finite() && self.angle_rev[row].is_finite()
    }
}

/// Completes time, travel and angle from those that were measured.
pub(crate) fn complete(table: &Table, nominal: &Nominal) -> Result<Coordinates, LabError> {
    let time = table.column("time_s");
    let position = table.column("position_mm");
    let angle = table.column("angle_rev");
    let turns_per_second = nominal.speed_rpm / 60.0;
    let scaled =
        |values: &[f64], factor: f64| values.iter().map(|v| v * factor).collect::<Vec<_>>();
    let mut notes = Vec::new();
    let angle_rev = match (angle, position, time) {
        (Some(angle), _, _) => angle.to_vec(),
        (None, Some(position), _) if !nominal.rotary => scaled(position, 1.0 / nominal.lead_mm),
        (None, _, Some(time)) if turns_back(table) => {
            let note =
                "`direction` turns back, and nothing says how far: no angle follows from the clock";
            notes.push(note.to_owned());
            scaled(time, 0.0)
        }
        (None, _, Some(time)) => {
            notes.push("angle and travel follow from `time_s` and the spindle speed".to_owned());
            // From 1970 on the angle would be a matter of the last digit of the speed.
            scaled(&from_start(time), turns_per_second)
        }
        _ => {
            return Err(LabError::NoCoordinate {
                path: table.path.display().to_string(),
                found: super::samples::names(table),
            });
        }
    };
    let position_mm = match position {
        Some(position) => position.to_vec(),
        None => scaled(&angle_rev, if nominal.rotary { 0.0 } else { nominal.lead_mm }),
    };
    let placed = position.is_some() || angle.is_some();
    if !placed && !nominal.rotary {
        refuse_another_travel(table, &position_mm)?;
    }
    let apart = time.filter(|_| placed).and_then(|time| clock_ticks::told_apart(time, &angle_rev));
    if apart.is_some() {
        notes.push("rows of one reading of `time_s` lie evenly between it and the next".to_owned());
    }
    let time_s = if let Some(time) = apart.as_deref().or(time) {
        notes.extend(late_start(time));
        from_start(time)
    } else {
        notes.push("time follows from travel and the spindle speed".to_owned());
        elapsed(&angle_rev, turns_per_second)
    };
    Ok(Coordinates { time_s, position_mm, angle_rev, timed: time.is_some(), placed, notes })
}

/// Refuses a travel that only a clock tells where a column in a unit of length moves as far: that is where the axis was.
fn refuse_another_travel(table: &Table, made_mm: &[f64]) -> Result<(), LabError> {
    let far_mm = AS_FAR * spread(made_mm);
    let Some((name, _)) = headers::lengths(table).find(|(_, mm)| far_mm < *mm) else {
        return Ok(());
    };
    Err(LabError::NoPosition { path: table.path.display().to_string(), found: name.to_owned() })
}

/// True for an axis that goes either way.
fn turns_back(table: &Table) -> bool {
    let direction = table.column("direction").unwrap_or_default();
    let goes = |sign: f64| direction.iter().any(|value| 0.0 < sign * value);
    goes(1.0) && goes(-1.0)
}

/// Time from the first sample of the record, so that clock times may be given.
fn from_start(time: &[f64]) -> Vec<f64> {
    let first = first(time);
    // A record that begins soon after zero keeps its own zero.
    let start = if first.abs() < CLOCK_S { 0.0 } else { first };
    time.iter().map(|t| t - start).collect()
}

fn first(time: &[f64]) -> f64 {
    time.iter().copied().filter(|t| t.is_finite()).fold(f64::INFINITY, f64::min)
}

/// What to say of a record that begins clearly after zero: effects count from its first sample.
fn late_start(time: &[f64]) -> Option<String> {
    let first = first(time);
    let late = LATE * spread(time) < first.abs() && first.is_finite();
    late.then(|| format!("times of effects count from the first sample, `time_s` {first}"))
}

/// Running time when only travel is known: the way made at the nominal speed.
fn elapsed(angle_rev: &[f64], turns_per_second: f64) -> Vec<f64> {
    let mut total = 0.0;
    let mut last = f64::NAN;
    let step = |&angle: &f64| {
        if angle.is_finite() {
            if last.is_finite() {
                total += (angle - last).abs();
            }
            last = angle;
        }
        if angle.is_finite() { total / turns_per_second } else { f64::NAN }
    };
    angle_rev.iter().map(step).collect()
}
