//! From what a measurement says of its samples to a complete [`Record`].

use std::f64::consts::TAU;
use std::ops::Range;

use crate::{Column, Machine, Record, Samples};

/// See [`Record::new`].
pub(crate) fn complete(machine: &Machine, samples: &Samples) -> Option<Record> {
    let count = [&samples.position_mm, &samples.angle_rev, &samples.time_s]
        .into_iter()
        .flatten()
        .map(|values| values.len())
        .next()?;
    let pass = numbered(samples.pass.as_ref(), count);
    let speed_rpm =
        samples.speed_rpm.clone().unwrap_or_else(|| vec![machine.spindle.speed_rpm; count].into());
    let turns = turns(machine, samples, &speed_rpm, &pass)?;
    let lead_mm = machine.workpiece.lead.mm();
    let position_mm = samples
        .position_mm
        .clone()
        .unwrap_or_else(|| turns.iter().map(|turn| turn * lead_mm).collect());
    let mut record = Record {
        time_s: times(samples, &turns, &speed_rpm, &pass),
        direction: samples.direction.clone().unwrap_or_else(|| directions(&position_mm, &pass)),
        spindle_rad: turns.iter().map(|turn| turn * TAU).collect(),
        error_um: vec![0.0; count].into(),
        position_mm,
        speed_rpm,
        pass,
        ..Record::default()
    };
    (record.travelled_mm, record.since_reversal_mm) = ways(&record, machine);
    Some(record.with_covariates(&samples.covariates))
}

/// Pass numbers as logged, counted anew from 0 in the order they come.
fn numbered(pass: Option<&Column>, count: usize) -> Column<usize> {
    let Some(logged) = pass else { return vec![0; count].into() };
    let mut number = 0;
    let mut numbers = Vec::with_capacity(count);
    for (row, value) in logged.iter().enumerate() {
        number += usize::from(0 < row && value.to_bits() != logged[row - 1].to_bits());
        numbers.push(number);
    }
    numbers.into()
}

/// Spindle turns of each sample, from angle, else travel, else time at speed and direction.
fn turns(
    machine: &Machine,
    samples: &Samples,
    speed_rpm: &[f64],
    pass: &[usize],
) -> Option<Column> {
    if let Some(angle_rev) = &samples.angle_rev {
        return Some(angle_rev.clone());
    }
    if let Some(position_mm) = &samples.position_mm {
        let lead_mm = machine.workpiece.lead.mm();
        return Some(position_mm.iter().map(|position| position / lead_mm).collect());
    }
    let time_s = samples.time_s.as_ref()?;
    let mut turn = 0.0;
    let mut turns = Vec::with_capacity(time_s.len());
    for row in 0..time_s.len() {
        if row == 0 {
            turn = time_s[0] * speed_rpm[0] / 60.0;
        } else {
            let sign = samples.direction.as_ref().map_or(1.0, |direction| direction[row]);
            let same_pass = pass[row] == pass[row - 1];
            let elapsed_s = if same_pass { time_s[row] - time_s[row - 1] } else { 0.0 };
            turn += sign * elapsed_s * speed_rpm[row] / 60.0;
        }
        turns.push(turn);
    }
    Some(turns.into())
}

/// Time since the first sample, s; at constant speed over the turns where it was not logged.
fn times(samples: &Samples, turns: &[f64], speed_rpm: &[f64], pass: &[usize]) -> Column {
    if let Some(time_s) = &samples.time_s {
        let start_s = time_s.iter().copied().fold(f64::INFINITY, f64::min);
        if start_s == 0.0 {
            return time_s.clone();
        }
        return time_s.iter().map(|time| time - start_s).collect();
    }
    let mut now_s = 0.0;
    let mut times = Vec::with_capacity(turns.len());
    for row in 0..turns.len() {
        if 0 < row && pass[row] == pass[row - 1] {
            now_s += (turns[row] - turns[row - 1]).abs() / speed_rpm[row] * 60.0;
        }
        times.push(now_s);
    }
    times.into()
}

/// +1 or −1 by the next move within the pass; the last sample goes on as before.
fn directions(position_mm: &[f64], pass: &[usize]) -> Column {
    let mut directions = vec![1.0; position_mm.len()];
    for row in (0..position_mm.len()).rev() {
        let next = row + 1;
        if next < position_mm.len() && pass[next] == pass[row] {
            let move_mm = position_mm[next] - position_mm[row];
            directions[row] = if move_mm == 0.0 { directions[next] } else { move_mm.signum() };
        } else if 0 < row && pass[row - 1] == pass[row] {
            let move_mm = position_mm[row] - position_mm[row - 1];
            directions[row] = if move_mm < 0.0 { -1.0 } else { 1.0 };
        }
    }
    directions.into()
}

/// Way since the start of the pass and since the last reversal in it, mm.
///
/// A reversal is where the direction changes, so that what turns with the direction and what winds
/// up anew turn together. The turning point lies between two samples, as far beyond them as the
/// table had time for.
fn ways(record: &Record, machine: &Machine) -> (Column, Column) {
    let lead_mm = machine.workpiece.lead.mm();
    let mut travelled = Vec::with_capacity(record.len());
    let mut since_reversal = Vec::with_capacity(record.len());
    for rows in record.passes() {
        let longest_mm = longest_mm(record, rows.clone());
        let start_mm = way_before_mm(machine, record.position_mm[rows.start]);
        let (mut way_mm, mut since_mm) = (start_mm, f64::INFINITY);
        for row in rows.clone() {
            if rows.start < row {
                let move_mm = record.position_mm[row] - record.position_mm[row - 1];
                if record.turned(row) {
                    let elapsed_s = record.time_s[row] - record.time_s[row - 1];
                    let pace_mm_s = lead_mm * record.speed_rpm[row] / 60.0;
                    // At rest in between it has gone less far than its speed says.
                    let between_mm = (pace_mm_s * elapsed_s).min(longest_mm).max(move_mm.abs());
                    way_mm += between_mm;
                    // Out and back are the way between; what one is longer than the other, the move.
                    since_mm = 0.5 * (between_mm + record.direction[row] * move_mm);
                } else {
                    way_mm += move_mm.abs();
                    since_mm += move_mm.abs();
                }
            }
            travelled.push(way_mm);
            since_reversal.push(since_mm);
        }
    }
    (travelled.into(), since_reversal.into())
}

/// Way of a pass before its first sample, mm.
///
/// A recorder does not say where its pass began. If the first sample lies no farther from travel
/// zero than the device takes to its first comparison, the pass began at zero; any other is taken
/// to begin with its first sample.
fn way_before_mm(machine: &Machine, first_mm: f64) -> f64 {
    let dividers = &machine.dividers;
    let comparison = f64::from(dividers.range.factor()) * f64::from(dividers.b);
    let pulses = f64::from(dividers.initial_phase) + 2.0 * comparison;
    let longest_mm = pulses * machine.fringe_um() / 1000.0;
    if first_mm.abs() <= longest_mm { first_mm.abs() } else { 0.0 }
}

/// Longest way between neighbours of one direction, mm.
fn longest_mm(record: &Record, rows: Range<usize>) -> f64 {
    let moves = (rows.start + 1..rows.end).filter(|&row| !record.turned(row));
    moves
        .map(|row| (record.position_mm[row] - record.position_mm[row - 1]).abs())
        .fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::motion::{Leg, Pass};
    use crate::{Model, Motion};

    /// 0.6 mm/s.
    const MACHINE: &str = r#"
workpiece = { lead = "6 mm", length = "100 mm" }
spindle.speed = "6 rpm"
grating.lines = 13906
laser.wavelength = "0.63281983 um"
dividers = { a = 110, b = 150 }
drive = { step = "0.0125 um", frequency = "160 Hz" }
"#;

    fn leg(length_mm: f64, forward: bool) -> Leg {
        Leg { length_mm, speed_rpm: 6.0, forward }
    }

    /// Each leg of a motion that turns within the pass, sampled every 1.3 s, and on its turns.
    #[test]
    fn ways_from_samples_are_those_of_the_motion() {
        let machine = Model::parse(MACHINE, Path::new("machine.toml")).unwrap();
        let legs = vec![leg(30.0, true), leg(21.0, false), leg(17.3, true), leg(9.1, false)];
        let motion = Motion::new(&machine, &Pass { number: 0, start_mm: 20.0, legs }).unwrap();
        let mut time_s: Vec<f64> = (0..99).map(|row| 1.3 * f64::from(row)).collect();
        time_s.push(50.0);
        time_s.sort_by(f64::total_cmp);
        let of = |value: fn(&crate::Instant<'_>) -> f64| {
            time_s.iter().map(|time_s| value(&motion.at(*time_s))).collect::<Vec<f64>>()
        };
        let samples = Samples {
            time_s: Some(time_s.clone().into()),
            position_mm: Some(of(|now| now.position_mm).into()),
            direction: Some(of(|now| now.direction).into()),
            ..Samples::default()
        };
        let record = complete(&machine, &samples).unwrap();
        for (row, now) in time_s.iter().map(|time_s| motion.at(*time_s)).enumerate() {
            assert!((record.travelled_mm[row] - now.travelled_mm).abs() < 1e-9, "row {row}");
            let (found_mm, due_mm) = (record.since_reversal_mm[row], now.since_reversal_mm);
            let alike = (found_mm - due_mm).abs() < 1e-9 || found_mm.total_cmp(&due_mm).is_eq();
            assert!(alike, "row {row}: {found_mm} mm since the reversal, not {due_mm} mm");
        }
    }

    /// A rest at the turn is no way: nothing lies farther apart there than neighbours elsewhere.
    #[test]
    fn a_rest_at_the_turn_is_no_way() {
        let machine = Model::parse(MACHINE, Path::new("machine.toml")).unwrap();
        let samples = Samples {
            time_s: Some(vec![0.0, 1.0, 2.0, 62.0, 63.0, 64.0].into()),
            position_mm: Some(vec![0.0, 0.6, 1.2, 1.2, 0.6, 0.0].into()),
            direction: Some(vec![1.0, 1.0, 1.0, -1.0, -1.0, -1.0].into()),
            ..Samples::default()
        };
        let record = complete(&machine, &samples).unwrap();
        assert!((record.since_reversal_mm[3] - 0.3).abs() < 1e-12);
        assert!((record.travelled_mm[5] - 3.0).abs() < 1e-12);
    }
}
