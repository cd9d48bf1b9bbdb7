//! Taking the error off again: by moving the tool or by correcting the display.

use super::table::{CorrectionTable, ErrorSample, LookUp};
use crate::number::number;

/// Who takes the error off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scheme {
    /// Scheme 1: a stepper moves the tool by whole steps of this size, µm.
    Step {
        /// Motion of one step, µm.
        step_um: f64,
    },
    /// Scheme 2: the displayed value is corrected, to this resolution, µm.
    Display {
        /// Resolution of the display, µm.
        resolution_um: f64,
    },
}

/// One sample after compensation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corrected {
    /// The sample.
    pub sample: ErrorSample,
    /// Correction looked up, µm; absent outside the table.
    pub correction_um: Option<f64>,
    /// Whole steps of the corrector (scheme 1) or digits of the display (scheme 2).
    pub steps: i64,
    /// Error that is left, µm.
    pub left_um: f64,
}

/// How far errors spread.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// Largest error by size, µm: the `±` of document 3.
    pub largest_um: f64,
    /// Half of highest less lowest, µm: the same about the best zero.
    pub half_range_um: f64,
    /// Root mean square, µm.
    pub rms_um: f64,
}

/// Corrects samples by a table. What lies outside the table stays as it is.
#[must_use]
pub fn apply(
    table: &CorrectionTable,
    samples: &[ErrorSample],
    scheme: Scheme,
    look_up: LookUp,
) -> Vec<Corrected> {
    let unit_um = match scheme {
        Scheme::Step { step_um } => step_um,
        Scheme::Display { resolution_um } => resolution_um,
    };
    let correct = |sample: &ErrorSample| {
        let correction_um = table.correction_um(sample.position_mm, sample.direction, look_up);
        let steps = steps(correction_um.unwrap_or(0.0), unit_um);
        let moved_um = exact(steps) * unit_um;
        Corrected { sample: *sample, correction_um, steps, left_um: sample.error_um + moved_um }
    };
    samples.iter().map(correct).collect()
}

impl Spread {
    /// The spread of errors, µm; zeros when there are none.
    #[must_use]
    pub fn of(errors_um: &[f64]) -> Self {
        if errors_um.is_empty() {
            return Self { largest_um: 0.0, half_range_um: 0.0, rms_um: 0.0 };
        }
        let highest = errors_um.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let lowest = errors_um.iter().copied().fold(f64::INFINITY, f64::min);
        let squares: f64 = errors_um.iter().map(|error| error * error).sum();
        Self {
            largest_um: highest.abs().max(lowest.abs()),
            half_range_um: (highest - lowest) / 2.0,
            rms_um: (squares / number(errors_um.len())).sqrt(),
        }
    }
}

/// Whole units nearest to a correction.
#[expect(clippy::cast_possible_truncation, reason = "a correction is a byte of LSBs")]
fn steps(correction_um: f64, unit_um: f64) -> i64 {
    (correction_um / unit_um).round() as i64
}

#[expect(clippy::cast_precision_loss, reason = "a correction holds few steps")]
fn exact(steps: i64) -> f64 {
    steps as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scale::{Direction, TableRule, build_table};

    #[test]
    fn whole_steps_leave_less_than_half_a_step_and_half_a_bit() {
        let errors = (0..=200).map(|k| ErrorSample {
            position_mm: f64::from(k),
            error_um: 5.5 * libm::sin(f64::from(k) / 30.0),
            direction: Direction::Forward,
        });
        let samples: Vec<ErrorSample> = errors.collect();
        let rule = TableRule { step_mm: 1.0, lsb_um: 0.1, joints: None };
        let table = build_table(&samples, &rule).unwrap();
        let corrected = apply(&table, &samples, Scheme::Step { step_um: 0.3 }, LookUp::Nearest);
        for one in &corrected {
            assert!(one.left_um.abs() <= 0.15 + 0.05 + 1e-9, "{one:?}");
        }
        let left: Vec<f64> = corrected.iter().map(|one| one.left_um).collect();
        assert!(0.1 < Spread::of(&left).largest_um);
    }
}
