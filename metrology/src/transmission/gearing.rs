//! Lines and ratio of a transmission, exactly.

use std::f64::consts::TAU;

use crate::Error;

/// A transmission between two pulse givers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Gearing {
    /// Pulses a turn of the input, λ1.
    pub input_lines: u64,
    /// Pulses a turn of the output, λ2.
    pub output_lines: u64,
    /// Turns of the input for one turn of the output: `i`, as numerator and denominator.
    pub ratio: (u64, u64),
}

impl Gearing {
    /// Refuses zeros and products beyond 64 bits.
    ///
    /// # Errors
    ///
    /// When a line count or a part of the ratio is zero or above 2³¹.
    pub fn check(self) -> Result<(), Error> {
        let parts = [self.input_lines, self.output_lines, self.ratio.0, self.ratio.1];
        let fits = |part: &u64| (1..1 << 31).contains(part);
        match parts.iter().find(|part| !fits(part)) {
            None => Ok(()),
            Some(&part) => Err(Error::OutOfRange {
                name: "line count or part of the ratio",
                found: float(part),
                expected: "1 to 2147483647",
            }),
        }
    }

    /// Input pulses for each output pulse, `R = i·λ1/λ2`, as a reduced fraction.
    #[must_use]
    pub fn pulses_per_pulse(self) -> (u64, u64) {
        let over = self.ratio.0 * self.input_lines;
        let under = self.ratio.1 * self.output_lines;
        let common = gcd(over, under);
        (over / common, under / common)
    }

    /// Turn of the output that one input pulse stands for, rad: `2π/(i·λ1)`.
    #[must_use]
    pub fn input_pulse_rad(self) -> f64 {
        TAU * float(self.ratio.1) / (float(self.ratio.0) * float(self.input_lines))
    }

    /// Turns of the output at its `j`-th pulse.
    #[must_use]
    pub fn output_turns(self, pulse: usize) -> f64 {
        crate::number::number(pulse) / float(self.output_lines)
    }

    /// `j·R` as whole pulses and the fraction left, so that no digits are lost over a long run.
    pub(super) fn nominal(self, pulse: usize) -> (f64, f64) {
        let (over, under) = self.pulses_per_pulse();
        let (over, under) = (u128::from(over), u128::from(under));
        let product = over * pulse as u128;
        (wide(product / under), wide(product % under) / wide(under))
    }
}

#[expect(clippy::cast_precision_loss, reason = "line counts are far below 2⁵³")]
pub(super) fn float(count: u64) -> f64 {
    count as f64
}

#[expect(clippy::cast_precision_loss, reason = "pulses of a capture are far below 2⁵³")]
fn wide(count: u128) -> f64 {
    count as f64
}

fn gcd(a: u64, b: u64) -> u64 {
    if b == 0 { a } else { gcd(b, a % b) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ratio_of_pulses_is_reduced() {
        let gearing = Gearing { input_lines: 3600, output_lines: 13906, ratio: (5, 2) };
        assert_eq!(gearing.pulses_per_pulse(), (4500, 6953));
        assert_eq!(gearing.nominal(6953 * 3 + 1), (13500.0, 4500.0 / 6953.0));
    }

    #[test]
    fn zeros_are_refused() {
        assert!(Gearing { input_lines: 0, output_lines: 1, ratio: (1, 1) }.check().is_err());
    }
}
