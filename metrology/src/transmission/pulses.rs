//! Two pulse trains on one time axis.

use crate::Error;

/// Rising edges of both givers, s, each in increasing order.
#[derive(Clone, Debug, PartialEq)]
pub struct Pulses {
    input_s: Vec<f64>,
    output_s: Vec<f64>,
}

impl Pulses {
    /// Two trains of at least four pulses each.
    ///
    /// # Errors
    ///
    /// When an instant is not finite, a train does not increase, or one has fewer than four.
    pub fn new(input_s: Vec<f64>, output_s: Vec<f64>) -> Result<Self, Error> {
        check(&input_s, "input pulse")?;
        check(&output_s, "output pulse")?;
        Ok(Self { input_s, output_s })
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
