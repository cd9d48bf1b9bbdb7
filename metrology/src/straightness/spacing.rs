//! Probe spacings in samples, and what they do to each harmonic.

use std::f64::consts::TAU;

use crate::Error;
use crate::number::number as as_number;

/// Distances of neighbouring probes, in sampling steps: `m1 = L1/D1`, `m2 = L2/D1`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Spacing {
    /// From the first probe to the second.
    pub first: usize,
    /// From the second probe to the third.
    pub second: usize,
}

/// What the probes' combination does to one harmonic of the stroke.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Harmonic {
    /// Periods over the stroke.
    pub number: usize,
    /// Weight `A_k`: amplitude of `z` for a unit amplitude of `h`. Zero: the harmonic is lost.
    pub gain: f64,
    /// Phase `ψ_k` of the weight, rad.
    pub phase_rad: f64,
}

/// Weights below this are zero but for rounding.
const LOST_GAIN: f64 = 1e-9;

impl Spacing {
    /// Spacings given as lengths.
    ///
    /// # Errors
    ///
    /// When one of them is no whole number (one or more) of sampling steps.
    pub fn from_lengths(first_mm: f64, second_mm: f64, step_mm: f64) -> Result<Self, Error> {
        let first = whole_steps(first_mm, step_mm)?;
        Ok(Self { first, second: whole_steps(second_mm, step_mm)? })
    }

    /// `L1/L2`.
    #[must_use]
    pub fn ratio(self) -> f64 {
        as_number(self.first) / as_number(self.second)
    }

    /// Samples from the first probe to the third.
    #[must_use]
    pub fn total(self) -> usize {
        self.first + self.second
    }

    /// Standard deviation of `z` for a unit standard deviation of every probe.
    #[must_use]
    pub fn combination_noise(self) -> f64 {
        let r = self.ratio();
        (1.0 + (1.0 + r) * (1.0 + r) + r * r).sqrt()
    }

    /// The weights of all harmonics below half the samples (equation 9 of document 2, with the
    /// period N throughout; the document's equations 6 and 10 print N − 1).
    #[must_use]
    pub fn harmonics(self, samples: usize) -> Vec<Harmonic> {
        (1..=highest_harmonic(samples)).map(|number| self.harmonic(number, samples)).collect()
    }

    /// Numbers of the harmonics nobody can recover: `A_k` is zero exactly when both spacings are
    /// whole periods of the harmonic.
    #[must_use]
    pub fn lost(self, samples: usize) -> Vec<usize> {
        let lost = |harmonic: &Harmonic| harmonic.gain < LOST_GAIN;
        self.harmonics(samples).iter().filter(|harmonic| lost(harmonic)).map(|h| h.number).collect()
    }

    fn harmonic(self, number: usize, samples: usize) -> Harmonic {
        let turn = |shift: usize| {
            // Reduced first, so that whole periods give exactly one.
            let part_of_period = as_number((number * shift) % samples) / as_number(samples);
            libm::sincos(TAU * part_of_period)
        };
        let r = self.ratio();
        let ((sin_first, cos_first), (sin_both, cos_both)) = (turn(self.first), turn(self.total()));
        let real = 1.0 - (1.0 + r) * cos_first + r * cos_both;
        let imaginary = (1.0 + r) * sin_first - r * sin_both;
        Harmonic {
            number,
            gain: libm::hypot(real, imaginary),
            phase_rad: libm::atan2(imaginary, real),
        }
    }
}

/// The highest harmonic below half the samples.
pub(super) fn highest_harmonic(samples: usize) -> usize {
    samples.saturating_sub(1) / 2
}

/// A length as a whole number of steps, to a thousandth of a step.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "checked to be a small positive whole number"
)]
fn whole_steps(length_mm: f64, step_mm: f64) -> Result<usize, Error> {
    let steps = length_mm / step_mm;
    if steps.round() < 1.0 || 1e9 < steps || 1e-3 < (steps - steps.round()).abs() || steps.is_nan()
    {
        return Err(Error::SpacingOffGrid { found_mm: length_mm, step_mm });
    }
    Ok(steps.round() as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn common_divisors_lose_harmonics_and_are_named() {
        assert_eq!(Spacing { first: 4, second: 4 }.lost(32), [8]);
        assert_eq!(Spacing { first: 8, second: 8 }.lost(32), [4, 8, 12]);
        assert!(Spacing { first: 5, second: 6 }.lost(32).is_empty());
        assert!(Spacing { first: 2, second: 2 }.lost(32).is_empty(), "only the 16th, half of N");
    }

    /// Harmonic 1 of N = 32 for spacings 5 and 6, by complex arithmetic elsewhere.
    #[test]
    fn weight_of_the_first_harmonic() {
        let first = Spacing { first: 5, second: 6 }.harmonics(32)[0];
        assert!((first.gain - 0.960_834_962_416_608).abs() < 1e-12, "{first:?}");
    }

    #[test]
    fn lengths_off_the_grid_are_refused() {
        assert!(Spacing::from_lengths(12.0, 10.0, 5.0).is_err());
        assert!(Spacing::from_lengths(0.0, 10.0, 5.0).is_err());
        assert_eq!(Spacing::from_lengths(25.0, 30.0, 5.0), Ok(Spacing { first: 5, second: 6 }));
    }
}
