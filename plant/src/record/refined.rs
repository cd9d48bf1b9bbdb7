//! Samples between the samples of a record, for what has a memory.

use crate::Record;

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
        let mut finer = Self { columns: self.columns.clone(), ..Self::default() };
        let mut own = Vec::with_capacity(self.len());
        for (row, parts) in parts.into_iter().enumerate() {
            for part in 1..parts {
                finer.push_between(self, row, f64::from(part) / f64::from(parts));
            }
            own.push(finer.len());
            finer.push_between(self, row, 1.0);
        }
        Some((finer, own))
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

    /// Adds what lies at a share of the way to a row of a record.
    fn push_between(&mut self, record: &Self, row: usize, share: f64) {
        let last = row.saturating_sub(1);
        let run = |values: &[f64]| between(values[last], values[row], share);
        self.time_s.push(run(&record.time_s));
        self.position_mm.push(run(&record.position_mm));
        self.spindle_rad.push(run(&record.spindle_rad));
        self.speed_rpm.push(record.speed_rpm[row]);
        self.direction.push(record.direction[row]);
        self.pass.push(record.pass[row]);
        self.travelled_mm.push(run(&record.travelled_mm));
        self.since_reversal_mm.push(run(&record.since_reversal_mm));
        self.error_um.push(run(&record.error_um));
        let width = record.columns.len();
        for column in 0..width {
            let of = |row: usize| record.covariates.get(row * width + column).copied();
            let [from, to] = [last, row].map(|row| of(row).unwrap_or(f64::NAN));
            self.covariates.push(between(from, to, share));
        }
    }
}

/// Straight from one value to another; the very value at its end, and where both are the same.
fn between(from: f64, to: f64, share: f64) -> f64 {
    if 1.0 <= share || from.to_bits() == to.to_bits() { to } else { from + share * (to - from) }
}
