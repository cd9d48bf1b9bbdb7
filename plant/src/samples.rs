//! From what a measurement says of its samples to a complete [`Record`].

use std::f64::consts::TAU;

use crate::{Machine, Record, Samples};

/// See [`Record::new`].
pub(crate) fn complete(machine: &Machine, samples: &Samples) -> Option<Record> {
    let count = [&samples.position_mm, &samples.angle_rev, &samples.time_s]
        .into_iter()
        .flatten()
        .map(Vec::len)
        .next()?;
    let pass = numbered(samples.pass.as_deref(), count);
    let speed_rpm =
        samples.speed_rpm.clone().unwrap_or_else(|| vec![machine.spindle.speed_rpm; count]);
    let turns = turns(machine, samples, &speed_rpm, &pass)?;
    let lead_mm = machine.workpiece.lead.mm();
    let position_mm = samples
        .position_mm
        .clone()
        .unwrap_or_else(|| turns.iter().map(|turn| turn * lead_mm).collect());
    let (travelled_mm, since_reversal_mm) = ways(&position_mm, &pass);
    let record = Record {
        time_s: times(samples, &turns, &speed_rpm, &pass),
        direction: samples.direction.clone().unwrap_or_else(|| directions(&position_mm, &pass)),
        spindle_rad: turns.iter().map(|turn| turn * TAU).collect(),
        error_um: vec![0.0; count],
        position_mm,
        speed_rpm,
        pass,
        travelled_mm,
        since_reversal_mm,
        ..Record::default()
    };
    Some(record.with_covariates(&samples.covariates))
}

/// Pass numbers as logged, counted anew from 0 in the order they come.
fn numbered(pass: Option<&[f64]>, count: usize) -> Vec<usize> {
    let Some(logged) = pass else { return vec![0; count] };
    let mut number = 0;
    let mut numbers = Vec::with_capacity(count);
    for (row, value) in logged.iter().enumerate() {
        number += usize::from(0 < row && value.to_bits() != logged[row - 1].to_bits());
        numbers.push(number);
    }
    numbers
}

/// Spindle turns of each sample, from angle, else travel, else time at speed and direction.
fn turns(
    machine: &Machine,
    samples: &Samples,
    speed_rpm: &[f64],
    pass: &[usize],
) -> Option<Vec<f64>> {
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
    Some(turns)
}

/// Time since the first sample, s; at constant speed over the turns where it was not logged.
fn times(samples: &Samples, turns: &[f64], speed_rpm: &[f64], pass: &[usize]) -> Vec<f64> {
    if let Some(time_s) = &samples.time_s {
        let start_s = time_s.iter().copied().fold(f64::INFINITY, f64::min);
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
    times
}

/// +1 or −1 by the next move within the pass; the last sample goes on as before.
fn directions(position_mm: &[f64], pass: &[usize]) -> Vec<f64> {
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
    directions
}

/// Way since the start of the pass and since the last reversal in it, mm.
fn ways(position_mm: &[f64], pass: &[usize]) -> (Vec<f64>, Vec<f64>) {
    let mut travelled = Vec::with_capacity(position_mm.len());
    let mut since_reversal = Vec::with_capacity(position_mm.len());
    let (mut way_mm, mut since_mm, mut sign) = (0.0, f64::INFINITY, 0.0);
    for row in 0..position_mm.len() {
        if row == 0 || pass[row] != pass[row - 1] {
            (way_mm, since_mm, sign) = (0.0, f64::INFINITY, 0.0);
        } else {
            let move_mm = position_mm[row] - position_mm[row - 1];
            if move_mm * sign < 0.0 {
                since_mm = 0.0;
            }
            if move_mm != 0.0 {
                sign = move_mm.signum();
            }
            way_mm += move_mm.abs();
            since_mm += move_mm.abs();
        }
        travelled.push(way_mm);
        since_reversal.push(since_mm);
    }
    (travelled, since_reversal)
}
