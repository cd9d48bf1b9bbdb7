//! Two pulse trains on one time axis.

use super::capture_tick::common_step_s;
use super::gearing::{Gearing, float};
use super::missing_pulses;
use crate::Error;
use crate::number::number;

/// Part by which the mean ratio may be off before lines or ratio must be wrong: far more than any
/// transmission error over a run, less than one tooth of a hundred.
const RATIO_TOLERANCE: f64 = 0.01;

/// Rising edges of both givers, s, each in increasing order.
#[derive(Clone, Debug, PartialEq)]
pub struct Pulses {
    input_s: Vec<f64>,
    output_s: Vec<f64>,
    /// Tick of what captured them, s.
    tick: f64,
}

impl Pulses {
    /// Two trains of at least four pulses each.
    ///
    /// # Errors
    ///
    /// When an instant is not finite, a train does not increase, one has fewer than four, or lost
    /// a pulse, or has one twice.
    pub fn new(input_s: Vec<f64>, output_s: Vec<f64>) -> Result<Self, Error> {
        check(&input_s, "input pulse")?;
        check(&output_s, "output pulse")?;
        missing_pulses::check(&input_s, &output_s, "input pulse")?;
        missing_pulses::check(&output_s, &input_s, "output pulse")?;
        let tick = common_step_s(&input_s, &output_s).unwrap_or(0.0);
        Ok(Self { input_s, output_s, tick })
    }

    /// Instants of the input pulses, s.
    #[must_use]
    pub fn input_s(&self) -> &[f64] {
        &self.input_s
    }

    /// Instants of the output pulses, s.
    #[must_use]
    pub fn output_s(&self) -> &[f64] {
        &self.output_s
    }

    /// Tick of the capture's own clock, s: every instant is a whole number of them from the first; zero
    /// where they have none in common.
    #[must_use]
    pub fn tick_s(&self) -> f64 {
        self.tick
    }

    /// Refuses trains that cannot come from these lines and this ratio.
    ///
    /// Input pulses between the first and the last placed output pulse are counted; one pulse
    /// either way is allowed beside one part in a hundred.
    ///
    /// # Errors
    ///
    /// When the trains do not overlap, or their mean ratio is another one.
    pub fn check_ratio(&self, gearing: &Gearing) -> Result<(), Error> {
        let placed = self.placed();
        let (Some(first), Some(last)) = (placed.first(), placed.last()) else {
            return Err(Error::TooFewSamples { found: 0, expected: 2 });
        };
        let (over, under) = gearing.pulses_per_pulse();
        let expected = float(over) / float(under);
        let outputs = number((last.0 - first.0).max(1));
        let found = number(last.1 - first.1) / outputs;
        if (found - expected).abs() <= RATIO_TOLERANCE * expected + 1.0 / outputs {
            return Ok(());
        }
        Err(Error::WrongRatio { found, expected })
    }

    /// Output pulses that lie between two input pulses: their numbers, and the number of the last
    /// input pulse at or before each. The others cannot be placed among the input pulses.
    pub(super) fn placed(&self) -> Vec<(usize, usize)> {
        let mut last = 0;
        let mut placed = Vec::with_capacity(self.output_s.len());
        for (output, &at_s) in self.output_s.iter().enumerate() {
            while last + 1 < self.input_s.len() && self.input_s[last + 1] <= at_s {
                last += 1;
            }
            if self.input_s[last] <= at_s && last + 1 < self.input_s.len() {
                placed.push((output, last));
            }
        }
        placed
    }
}

fn check(train_s: &[f64], column: &'static str) -> Result<(), Error> {
    if train_s.len() < 4 {
        return Err(Error::TooFewSamples { found: train_s.len(), expected: 4 });
    }
    if let Some(row) = train_s.iter().position(|at| !at.is_finite()) {
        return Err(Error::NotFinite { row, column });
    }
    match train_s.windows(2).position(|pair| pair[1] <= pair[0]) {
        None => Ok(()),
        Some(row) => Err(Error::TimeTurns {
            row: row + 1,
            column,
            found_s: train_s[row + 1],
            previous_s: train_s[row],
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_another_transmission_are_refused() {
        let train = |count: usize, period: f64| (0..count).map(|k| number(k) * period).collect();
        let pulses = Pulses::new(train(1001, 0.001), train(101, 0.01)).unwrap();
        let gearing = |ratio| Gearing { input_lines: 100, output_lines: 100, ratio };
        assert_eq!(pulses.check_ratio(&gearing((10, 1))), Ok(()));
        assert_eq!(pulses.check_ratio(&gearing((10_001, 1000))), Ok(()));
        let refused = pulses.check_ratio(&gearing((11, 1)));
        assert!(matches!(refused, Err(Error::WrongRatio { .. })), "{refused:?}");
    }
}
