//! Rows that share the readings of a coarse clock while the axis moves on.

use crate::numerics::{count, median};
use crate::policy::reading::{ROWS_A_TICK, TICK_MISSED};

/// Equal readings of a clock on end.
#[derive(Debug, Clone, Copy)]
struct Reading {
    time_s: f64,
    rows: usize,
}

/// Instants of the rows, evenly through each tick, where a clock in whole seconds has many of them at once and the axis
/// is elsewhere at each; `None` where each row has its own, or several are of one place.
pub(super) fn told_apart(time_s: &[f64], angle_rev: &[f64]) -> Option<Vec<f64>> {
    let readings = readings(time_s);
    if time_s.len() < ROWS_A_TICK * readings.len() || !moves_within(time_s, angle_rev) {
        return None;
    }
    let ahead = |of: usize| Some(readings.get(of + 1)?.time_s - readings[of].time_s);
    let mut ticks: Vec<f64> =
        (0..readings.len()).filter_map(ahead).filter(|step| 0.0 < *step).collect();
    let mut rows: Vec<f64> = readings.iter().map(|reading| count(reading.rows)).collect();
    if ticks.is_empty() {
        return None;
    }
    let (tick, usual) = (median(&mut ticks), median(&mut rows));
    let goes_on = |of: usize| ahead(of).is_some_and(|step| 0.0 < step && step < TICK_MISSED * tick);
    let mut all = Vec::with_capacity(time_s.len());
    for (of, Reading { time_s, rows }) in readings.iter().enumerate() {
        let begins = of == 0 || !goes_on(of - 1);
        // A log begins and ends within a tick.
        let step = tick / usual.max(count(*rows));
        let (from, step) = match (begins, ahead(of).filter(|_| goes_on(of))) {
            (true, Some(next)) => (time_s + next - step * count(*rows), step),
            (false, Some(next)) => (*time_s, next / count(*rows)),
            (_, None) => (*time_s, step),
        };
        all.extend((0..*rows).map(|row| from + step * count(row)));
    }
    Some(all)
}

fn readings(time_s: &[f64]) -> Vec<Reading> {
    let same = time_s.chunk_by(|a, b| a.to_bits() == b.to_bits());
    same.map(|rows| Reading { time_s: rows[0], rows: rows.len() }).collect()
}

/// True where most of the way is made between rows of one reading.
fn moves_within(time_s: &[f64], angle_rev: &[f64]) -> bool {
    let (mut within, mut all) = (0.0, 0.0);
    for (time, angle) in time_s.windows(2).zip(angle_rev.windows(2)) {
        let step = (angle[1] - angle[0]).abs();
        if step.is_finite() {
            all += step;
            within += if time[0].to_bits() == time[1].to_bits() { step } else { 0.0 };
        }
    }
    all < 2.0 * within
}

#[cfg(test)]
mod tests {
    use super::told_apart;

    #[test]
    fn rows_of_one_reading_lie_evenly_in_its_tick() {
        let rows = [(7.0, 2), (8.0, 4), (9.0, 4), (10.0, 4), (11.0, 3)];
        let time_s: Vec<f64> = rows.iter().flat_map(|(time, rows)| vec![*time; *rows]).collect();
        let angle_rev: Vec<f64> = (0..17).map(f64::from).collect();
        let apart = told_apart(&time_s, &angle_rev).expect("four rows a tick");
        let even: Vec<f64> = (0..17).map(|row| 7.5 + 0.25 * f64::from(row)).collect();
        assert_eq!(apart, even);
    }

    #[test]
    fn readings_at_one_place_stay_at_one_instant() {
        let time_s: Vec<f64> = (0..40).map(|row: i32| f64::from(row / 5)).collect();
        assert_eq!(told_apart(&time_s, &time_s), None);
    }
}
