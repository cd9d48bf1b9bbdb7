//! Samples between the samples of a record, for what has a memory.

use crate::{Column, Record};

impl Record {
    /// The record with samples in between, and where its own have gone; `None` when none are asked
    /// for, or there are too many rows for any.
    ///
    /// `asked` says in how many parts the way to a sample from the one before it should go; where
    /// that makes more than `most` samples, each gets its share. Everything runs
    /// straight from neighbour to neighbour, as the machine does, so that an effect of it may bend in
    /// between. Nothing is put between passes, or where the table turns.
    #[must_use]
    pub fn refined(&self, most: usize, asked: impl Fn(usize) -> f64) -> Option<(Self, Vec<usize>)> {
        let asked: Vec<f64> = (0..self.len()).map(|row| self.between_rows(row, &asked)).collect();
        let parts = held(most, &asked)?;
        let mut own = Vec::with_capacity(self.len());
        let mut places = Vec::with_capacity(parts.iter().map(|parts| *parts as usize).sum());
        for (row, parts) in parts.into_iter().enumerate() {
            let shares = (1..parts).map(|part| f64::from(part) / f64::from(parts));
            places.extend(shares.map(|share| (row, share)));
            own.push(places.len());
            places.push((row, 1.0));
        }
        Some((self.between(&places), own))
    }

    /// Parts that are asked for on the way to a sample, 1 where there is no way that is known.
    fn between_rows(&self, row: usize, asked: impl Fn(usize) -> f64) -> f64 {
        if row == 0 || self.pass[row] != self.pass[row - 1] || self.turned(row) {
            return 1.0;
        }
        Some(asked(row)).filter(|parts| parts.is_finite()).map_or(1.0, |parts| parts.max(1.0))
    }

    /// What lies at each share of the way to a row from the one before it.
    fn between(&self, places: &[(usize, f64)]) -> Self {
        let straight = |values: &Column| -> Column {
            let at = |&(row, share): &(usize, f64)| {
                between(values[row.saturating_sub(1)], values[row], share)
            };
            places.iter().map(at).collect()
        };
        let kept =
            |values: &Column| -> Column { places.iter().map(|&(row, _)| values[row]).collect() };
        let mut record = Self {
            time_s: straight(&self.time_s),
            position_mm: straight(&self.position_mm),
            spindle_rad: straight(&self.spindle_rad),
            speed_rpm: kept(&self.speed_rpm),
            direction: kept(&self.direction),
            pass: places.iter().map(|&(row, _)| self.pass[row]).collect(),
            travelled_mm: straight(&self.travelled_mm),
            since_reversal_mm: straight(&self.since_reversal_mm),
            since_turn_mm: straight(&self.since_turn_mm),
            since_stop_s: Column::default(),
            velocity_rpm: Column::default(),
            error_um: straight(&self.error_um),
            columns: self.columns.clone(),
            covariates: self.covariates_between(places),
        };
        record.since_stop_s = record.since_stops_s();
        record.velocity_rpm = record.velocities_rpm();
        record
    }

    fn covariates_between(&self, places: &[(usize, f64)]) -> Column {
        if self.covariates.is_empty() {
            return Column::default();
        }
        let at = |&(row, share): &(usize, f64)| {
            let pairs = self.logged(row.saturating_sub(1)).iter().zip(self.logged(row));
            pairs.map(move |(from, to)| between(*from, *to, share))
        };
        places.iter().flat_map(at).collect()
    }
}

/// As many parts as asked for, or fewer alike if they are too many to be held.
fn held(most: usize, asked: &[f64]) -> Option<Vec<u32>> {
    let more: f64 = asked.iter().map(|parts| parts.round() - 1.0).sum();
    #[expect(clippy::cast_precision_loss, reason = "below 2^53")]
    let room = most.saturating_sub(asked.len()) as f64;
    // Another copy of a long record is not worth a few samples more.
    if more <= 0.0 || (more > room && most < 2 * asked.len()) {
        return None;
    }
    let share = (room / more).min(1.0);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 to most")]
    let parts = |asked: &f64| 1 + (share * (asked.round() - 1.0)) as u32;
    Some(asked.iter().map(parts).collect())
}

/// Straight from one value to another; the very value at its end, and where both are the same.
fn between(from: f64, to: f64, share: f64) -> f64 {
    if 1.0 <= share || from.to_bits() == to.to_bits() { to } else { from + share * (to - from) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_parts_than_can_be_held_are_shared() {
        assert_eq!(held(100, &[1.0, 3.0, 8.4]), Some(vec![1, 3, 8]));
        assert_eq!(held(100, &[1.0, 1.2]), None);
        assert_eq!(held(30, &[11.0; 10]), Some(vec![3; 10]));
        assert_eq!(held(19, &[11.0; 10]), None);
    }
}
