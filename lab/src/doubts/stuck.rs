//! Readings that stand still while the axis moves, in a column that hardly ever repeats itself: an instrument stuck.

use std::ops::Range;

use super::doubt::Doubt;
use crate::measurement::{Measurement, sensor_column};
use crate::numerics::{count, median};
use crate::policy::mistakes::{
    DOUBT, LEAP_OF_A_LOG, LEAP_OF_A_SENSOR, MOVES, STUCK_LOG, STUCK_REPEATS_ELSEWHERE,
};

/// Difference of two slopes along one line, against their size.
const ROUNDING: f64 = 1e-6;

/// The clearest one.
pub(super) fn stuck(measurement: &Measurement) -> Option<Doubt> {
    let sensors = measurement.observations.iter().map(|(sensor, values)| {
        (sensor_column(*sensor, measurement.rotary), values.as_slice(), LEAP_OF_A_SENSOR, DOUBT)
    });
    let logs = measurement.covariates.iter().filter(|(name, values)| {
        !measurement.off_by.contains_key(*name) && !is_joined(measurement, values)
    });
    let logs =
        logs.map(|(name, values)| (name.as_str(), values.as_slice(), LEAP_OF_A_LOG, STUCK_LOG));
    let found = sensors.chain(logs).filter_map(|(name, values, leap, limit)| {
        let Still { rows, share, evidence } = longest(measurement, values)?;
        let rests = limit < evidence && share < STUCK_REPEATS_ELSEWHERE;
        let is_stuck = rests && leap < leap_behind(measurement, values, &rows);
        is_stuck.then(|| said(measurement, (name, values), rows, evidence))
    });
    found.max_by(|a, b| a.evidence.total_cmp(&b.evidence))
}

/// True for readings that were joined by lines: between two that are the same it rests.
fn is_joined(measurement: &Measurement, values: &[f64]) -> bool {
    let slope = |row: usize| {
        (values[row] - values[row - 1]) / (measurement.time_s[row] - measurement.time_s[row - 1])
    };
    let on_a_line = |row: &usize| {
        let [before, now] = [slope(row - 1), slope(*row)];
        (now - before).abs() < ROUNDING * (now.abs() + before.abs())
    };
    values.len() < 2 * (2..values.len()).filter(on_a_line).count()
}

/// Rows of one reading.
struct Still {
    rows: Range<usize>,
    /// Share of the other rows that repeat the one before, of those that read something while the axis moves.
    share: f64,
    /// Evidence against so many repeats by that share, anywhere.
    evidence: f64,
}

/// The longest run of one reading, by its rows that the axis moves to.
fn longest(measurement: &Measurement, values: &[f64]) -> Option<Still> {
    let way = |row: usize| (measurement.angle_rev[row] - measurement.angle_rev[row - 1]).abs();
    let usual = (1..values.len()).map(way).sum::<f64>() / count(values.len());
    let moving =
        |rows: &[usize]| count(rows.iter().filter(|&&row| MOVES * usual < way(row)).count());
    // Nought is a reading of its own, a force out of contact, and none is none.
    let repeats = |row: &usize| {
        let [before, now] = [values[*row - 1], values[*row]];
        now.is_normal() && now.to_bits() == before.to_bits() && goes_on(measurement, *row)
    };
    let repeating: Vec<usize> = (1..values.len()).filter(repeats).collect();
    let runs = repeating.chunk_by(|before, after| before + 1 == *after);
    let run = runs.max_by(|a, b| moving(a).total_cmp(&moving(b)))?;
    // A coarse display about nought reads nothing most of the time, and repeats what else it reads.
    let read: Vec<usize> = (1..values.len()).filter(|&row| values[row].is_normal()).collect();
    let all = moving(&read);
    let own = moving(run);
    let share = (moving(&repeating) - own + 1.0) / (all - own);
    let evidence = -2.0 * (own * libm::log(share) + libm::log(all));
    Some(Still { rows: run[0] - 1..run[run.len() - 1] + 1, share, evidence })
}

/// True for a row of the same pass as the one before.
fn goes_on(measurement: &Measurement, row: usize) -> bool {
    measurement.pass[row] == measurement.pass[row - 1]
}

/// By how much a column leaps to or from some rows, against its usual step: at its turning points a smooth
/// one rests as well, and goes on slowly.
fn leap_behind(measurement: &Measurement, values: &[f64], rows: &Range<usize>) -> f64 {
    let step = |row: usize| (values[row] - values[row - 1]).abs();
    let mut steps: Vec<f64> = (1..values.len()).map(step).filter(|step| 0.0 < *step).collect();
    let usual = median(&mut steps);
    let ends = [rows.start, rows.end].into_iter();
    let inside = ends.filter(|&end| 0 < end && end < values.len() && goes_on(measurement, end));
    inside.map(|end| step(end) / usual).fold(0.0, f64::max)
}

fn said(
    measurement: &Measurement,
    (column, values): (&str, &[f64]),
    rows: Range<usize>,
    evidence: f64,
) -> Doubt {
    let (along, places) = match (measurement.timed, measurement.rotary) {
        (true, _) => ("time_s", &measurement.time_s),
        (false, true) => ("angle_rev", &measurement.angle_rev),
        (false, false) => ("position_mm", &measurement.position_mm),
    };
    let (from, to) = (places[rows.start], places[rows.end - 1]);
    let pass = measurement.pass_names[measurement.pass[rows.start]];
    let (value, rows) = (values[rows.start], rows.len());
    Doubt {
        what: "stuck",
        evidence,
        says: format!("`{column}` stays at {value} for {rows} rows of pass {pass}: stuck"),
        mend: format!("leave the rows with `{along}` from {from} to {to} out"),
    }
}
