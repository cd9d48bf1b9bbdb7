//! What is seen of the synchronous device in each comparison.
//!
//! The meter is a flip-flop, so T1 follows the divided pulses by a clock; its pulse is measured in
//! a window that does too, so that a phase that has just passed 360° is measured to the clock.

use std::iter::Peekable;
use std::slice::Iter;

use crate::closed_loop::{Change, Sample, Waveform};

/// The signals to be recorded.
pub(super) const SEEN: [&str; 2] = ["t1", "q"];

/// Clocks from a divided pulse to the meter.
const METER_CLOCKS: u64 = 1;

/// One comparison.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seen {
    /// Clock at which it ended.
    pub(super) end: u64,
    /// How long it lasted, clocks.
    pub(super) clocks: u64,
    /// For how many of them the meter was high.
    pub(super) high: u64,
    /// Q at its end.
    pub(super) forward: bool,
}

/// The comparisons, from a record of [`SEEN`] that began with the run.
pub(super) fn seen(samples: &[Sample], waveform: &Waveform) -> Vec<Seen> {
    let changes_of = |name: &str| -> Vec<_> {
        let signal = waveform.signals.iter().position(|(path, _)| path == name);
        waveform.changes.iter().filter(|change| Some(change.signal) == signal).copied().collect()
    };
    let [t1, q] = SEEN.map(changes_of);
    let (mut t1, mut q) = (Level::of(&t1), Level::of(&q));
    let comparisons = samples.iter().map(|sample| sample.comparison);
    let seen = comparisons.map(|comparison| Seen {
        end: comparison.end,
        clocks: comparison.end - comparison.begin,
        high: t1.high(comparison.begin + METER_CLOCKS, comparison.end + METER_CLOCKS),
        forward: q.at(comparison.end),
    });
    seen.collect()
}

/// A signal of one bit, read from its beginning on.
struct Level<'a> {
    changes: Peekable<Iter<'a, Change>>,
    high: bool,
}

impl<'a> Level<'a> {
    fn of(changes: &'a [Change]) -> Self {
        Self { changes: changes.iter().peekable(), high: false }
    }

    /// The level at a clock, not before those asked for.
    fn at(&mut self, clock: u64) -> bool {
        while let Some(change) = self.changes.next_if(|change| change.clock <= clock) {
            self.high = change.value == 1;
        }
        self.high
    }

    /// Clocks of a stretch for which it is high; the stretch is not before those asked for.
    fn high(&mut self, from: u64, to: u64) -> u64 {
        let (mut high, mut since) = (0, from);
        let was = self.at(from);
        let mut now = was;
        while let Some(change) = self.changes.next_if(|change| change.clock < to) {
            high += if now { change.clock - since } else { 0 };
            (since, now) = (change.clock, change.value == 1);
        }
        self.high = now;
        if now { high + to - since } else { high }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_level_is_measured_piece_by_piece() {
        let change = |clock, value| Change { clock, signal: 0, value };
        let changes = [change(0, 0), change(5, 1), change(8, 0), change(12, 1)];
        let mut level = Level::of(&changes);
        assert_eq!([level.high(0, 6), level.high(6, 7), level.high(7, 20)], [1, 1, 9]);
    }
}
