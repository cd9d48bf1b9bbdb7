//! Samples between the samples of a record, for what has a memory.

use crate::{Column, Record};

/// Most parts of the way from one sample to the next: what lies further back is forgotten, or too
/// slow to ask for more.
const MOST_PARTS: f64 = 16.0;

/// Most samples of a refined record.
const MOST_SAMPLES: usize = 1 << 20;

impl Record {
    /// The record with samples in between, about `turns` of the spindle apart, and where its own
    /// samples have gone; `None` when they are no farther apart themselves.
    ///
    /// Everything runs straight from neighbour to neighbour, as the machine does, so that an effect
    /// of it may bend in between. Nothing is put between passes, or where the table turns.
    #[must_use]
    pub fn refined(&self, turns: f64) -> Option<(Self, Vec<usize>)> {
        let parts: Vec<u32> = (0..self.len()).map(|row| self.parts(row, turns)).collect();
        let all: usize = parts.iter().map(|parts| *parts as usize).sum();
        if all <= self.len() || MOST_SAMPLES < all {
            return None;
        }
        let mut own = Vec::with_capacity(self.len());
        let mut places = Vec::with_capacity(all);
        for (row, parts) in parts.into_iter().enumerate() {
            let shares = (1..parts).map(|part| f64::from(part) / f64::from(parts));
            places.extend(shares.map(|share| (row, share)));
            own.push(places.len());
            places.push((row, 1.0));
        }
        Some((self.between(&places), own))
    }

    /// Parts of the way to a sample from the one before it.
    fn parts(&self, row: usize, turns: f64) -> u32 {
        if row == 0 || self.pass[row] != self.pass[row - 1] {
            return 1;
        }
        let elapsed_s = self.time_s[row] - self.time_s[row - 1];
        let parts = (elapsed_s * self.speed_rpm[row] / 60.0 / turns).round();
        if self.turned(row) || !parts.is_finite() {
            return 1;
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 to 16")]
        let parts = parts.clamp(1.0, MOST_PARTS) as u32;
        parts
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
            velocity_rpm: Column::default(),
            error_um: straight(&self.error_um),
            columns: self.columns.clone(),
            covariates: self.covariates_between(places),
        };
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

/// Straight from one value to another; the very value at its end, and where both are the same.
fn between(from: f64, to: f64, share: f64) -> f64 {
    if 1.0 <= share || from.to_bits() == to.to_bits() { to } else { from + share * (to - from) }
}
