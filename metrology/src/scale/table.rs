//! The correction table: one byte a place and direction.

use super::joints::{JointRule, bridge_joints};
use crate::Error;
use crate::number::number;

/// Which way the carriage moved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// Towards larger positions.
    Forward,
    /// Towards smaller positions.
    Backward,
}

/// One measured error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorSample {
    /// Position shown by the machine's scale, from the origin pulse, mm.
    pub position_mm: f64,
    /// What the machine's scale shows less what the calibrated one does, µm.
    pub error_um: f64,
    /// Way of approach.
    pub direction: Direction,
}

/// How a table is made from samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TableRule {
    /// Distance of the table's places, mm (1 mm in document 3).
    pub step_mm: f64,
    /// Weight of the least bit, µm.
    pub lsb_um: f64,
    /// What to do at joints; absent when the scale is of one piece.
    pub joints: Option<JointRule>,
}

/// Corrections at even places.
#[derive(Clone, Debug, PartialEq)]
pub struct CorrectionTable {
    /// First place, mm from the origin pulse.
    pub start_mm: f64,
    /// Distance of the places, mm.
    pub step_mm: f64,
    /// Weight of the least bit, µm.
    pub lsb_um: f64,
    /// Corrections moving forward, in LSB.
    pub forward: Vec<i8>,
    /// Corrections moving backward, in LSB; empty when one table serves both ways.
    pub backward: Vec<i8>,
}

/// How a table is read between its places.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LookUp {
    /// The nearest place, as the EEPROM gives it.
    Nearest,
    /// The straight line between the two places around.
    Linear,
}

/// Makes a table from samples in any order; samples at one place and direction are averaged.
///
/// The table covers the whole steps between the first sample and the last one; between samples
/// it is interpolated linearly.
///
/// # Errors
///
/// When a sample is not finite, a direction has fewer than two places, no place lies in what every
/// direction covers, the step or the LSB is not positive, or a correction does not fit a byte.
pub fn build_table(samples: &[ErrorSample], rule: &TableRule) -> Result<CorrectionTable, Error> {
    for (name, value) in [("table step", rule.step_mm), ("LSB", rule.lsb_um)] {
        if value.is_nan() || value <= 0.0 {
            return Err(Error::OutOfRange { name, found: value, expected: "more than 0" });
        }
    }
    let not_finite = |s: &ErrorSample| !(s.position_mm.is_finite() && s.error_um.is_finite());
    if let Some(row) = samples.iter().position(not_finite) {
        return Err(Error::NotFinite { row, column: "position or error" });
    }
    let forward = mean_curve(samples, Direction::Forward);
    let backward = mean_curve(samples, Direction::Backward);
    let one_way = forward.is_empty() || backward.is_empty();
    let curves = if forward.is_empty() { vec![backward] } else { vec![forward, backward] };
    let curves = &curves[..if one_way { 1 } else { 2 }];
    for curve in curves {
        if curve.len() < 2 {
            return Err(Error::TooFewSamples { found: curve.len(), expected: 2 });
        }
    }
    let places = places(curves, rule.step_mm)?;
    let mut tables = Vec::new();
    for curve in curves {
        tables.push(corrections(curve, &places, rule)?);
    }
    let backward = if one_way { Vec::new() } else { tables.pop().unwrap_or_default() };
    let forward = tables.pop().unwrap_or_default();
    let start_mm = places.first().copied().unwrap_or(0.0);
    Ok(CorrectionTable { start_mm, step_mm: rule.step_mm, lsb_um: rule.lsb_um, forward, backward })
}

impl CorrectionTable {
    /// Correction at a position, µm; `None` outside the table, where nothing is corrected.
    #[must_use]
    pub fn correction_um(
        &self,
        position_mm: f64,
        direction: Direction,
        look_up: LookUp,
    ) -> Option<f64> {
        let codes = match direction {
            Direction::Backward if !self.backward.is_empty() => &self.backward,
            _ => &self.forward,
        };
        let index = (position_mm - self.start_mm) / self.step_mm;
        let code = match look_up {
            LookUp::Nearest => f64::from(*codes.get(whole(index.round())?)?),
            LookUp::Linear => {
                let (below, part) =
                    (whole((index + 1e-9).floor())?, index - (index + 1e-9).floor());
                let here = f64::from(*codes.get(below)?);
                let next = codes.get(below + 1).map_or(here, |code| f64::from(*code));
                if codes.len() <= below + 1 && 1e-6 < part {
                    return None;
                }
                here + (next - here) * part
            }
        };
        Some(code * self.lsb_um)
    }

    /// The places of the table, mm.
    pub fn places_mm(&self) -> impl Iterator<Item = f64> {
        (0..self.forward.len()).map(|index| self.start_mm + number(index) * self.step_mm)
    }
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked just before")]
fn whole(index: f64) -> Option<usize> {
    (0.0..1e9).contains(&index).then_some(index as usize)
}

/// Mean error at each place of one direction, in order of position.
fn mean_curve(samples: &[ErrorSample], direction: Direction) -> Vec<(f64, f64)> {
    let of_direction = samples.iter().filter(|sample| sample.direction == direction);
    let mut sorted: Vec<(f64, f64)> = of_direction.map(|s| (s.position_mm, s.error_um)).collect();
    sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
    // Positions of repeats agree to a nanometre.
    let places = sorted.chunk_by(|a, b| b.0 - a.0 < 1e-6);
    let mean = |values: &[(f64, f64)]| {
        let sum: f64 = values.iter().map(|(_, error)| error).sum();
        (values[0].0, sum / number(values.len()))
    };
    places.map(mean).collect()
}

/// More places than any memory of this kind holds; a step in the wrong unit asks for them.
const MOST_PLACES: f64 = 100_000.0;

/// Whole steps that every direction covers.
fn places(curves: &[Vec<(f64, f64)>], step_mm: f64) -> Result<Vec<f64>, Error> {
    let first = curves.iter().map(|curve| curve[0].0).fold(f64::NEG_INFINITY, f64::max);
    let last = curves.iter().map(|curve| curve[curve.len() - 1].0).fold(f64::INFINITY, f64::min);
    if MOST_PLACES < (last - first) / step_mm {
        let (found, expected) = ((last - first) / step_mm, "a few thousand for 2 KiB");
        return Err(Error::OutOfRange { name: "number of places", found, expected });
    }
    if last < first {
        return Err(Error::DirectionsApart { begins_mm: first, ends_mm: last });
    }
    let start = (first / step_mm - 1e-6).ceil();
    let place = |index: usize| (start + number(index)) * step_mm;
    let places: Vec<f64> =
        (0..usize::MAX).map(place).take_while(|place| *place <= last + 1e-6).collect();
    if places.is_empty() {
        return Err(Error::NoPlace { step_mm, from_mm: first, to_mm: last });
    }
    Ok(places)
}

fn corrections(curve: &[(f64, f64)], places: &[f64], rule: &TableRule) -> Result<Vec<i8>, Error> {
    let mut errors_um: Vec<f64> = places.iter().map(|&place| interpolated(curve, place)).collect();
    if let Some(joints) = &rule.joints {
        bridge_joints(joints, curve, places, &mut errors_um);
    }
    let coded =
        places.iter().zip(&errors_um).map(|(&place, error)| code(place, -error, rule.lsb_um));
    coded.collect()
}

#[expect(clippy::cast_possible_truncation, reason = "checked to fit just before")]
fn code(at_mm: f64, correction_um: f64, lsb_um: f64) -> Result<i8, Error> {
    let lsbs = (correction_um / lsb_um).round();
    // −128 is not used, so that every correction has its opposite.
    if lsbs.abs() <= 127.0 {
        return Ok(lsbs as i8);
    }
    Err(Error::BeyondConverter { at_mm, found_um: correction_um, limit_um: 127.0 * lsb_um })
}

fn interpolated(curve: &[(f64, f64)], at_mm: f64) -> f64 {
    let after = curve.partition_point(|(x, _)| *x < at_mm).clamp(1, curve.len() - 1);
    let ((x0, y0), (x1, y1)) = (curve[after - 1], curve[after]);
    y0 + (y1 - y0) * ((at_mm - x0) / (x1 - x0)).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample(position_mm: f64, error_um: f64, direction: Direction) -> ErrorSample {
        ErrorSample { position_mm, error_um, direction }
    }

    fn rule() -> TableRule {
        TableRule { step_mm: 1.0, lsb_um: 0.1, joints: None }
    }

    #[test]
    fn each_direction_has_its_corrections_and_repeats_are_averaged() {
        let samples = [
            sample(0.0, 1.0, Direction::Forward),
            sample(0.0, 3.0, Direction::Forward),
            sample(2.0, 4.0, Direction::Forward),
            sample(2.0, -4.0, Direction::Backward),
            sample(0.0, 0.0, Direction::Backward),
        ];
        let table = build_table(&samples, &rule()).unwrap();
        assert_eq!(
            (table.forward.as_slice(), table.backward.as_slice()),
            (&[-20, -30, -40][..], &[0, 20, 40][..])
        );
        let look = |x, direction, how| table.correction_um(x, direction, how);
        assert_eq!(look(1.4, Direction::Forward, LookUp::Nearest), Some(-3.0));
        assert!((look(1.5, Direction::Backward, LookUp::Linear).unwrap() - 3.0).abs() < 1e-9);
        assert_eq!(look(2.6, Direction::Forward, LookUp::Nearest), None);
        assert_eq!(look(2.2, Direction::Forward, LookUp::Linear), None);
        assert_eq!(look(-0.6, Direction::Forward, LookUp::Nearest), None);
    }

    #[test]
    fn directions_apart_and_stretches_between_places_are_refused() {
        let there = |x: f64| sample(x, 0.0, Direction::Forward);
        let back = |x: f64| sample(x, 0.0, Direction::Backward);
        let apart = build_table(&[there(0.0), there(9.0), back(20.0), back(30.0)], &rule());
        assert_eq!(apart, Err(Error::DirectionsApart { begins_mm: 20.0, ends_mm: 9.0 }));
        let between = build_table(&[there(0.2), there(0.9)], &rule());
        assert_eq!(between, Err(Error::NoPlace { step_mm: 1.0, from_mm: 0.2, to_mm: 0.9 }));
    }

    #[test]
    fn what_does_not_fit_a_byte_is_refused_with_its_place() {
        let samples = [sample(0.0, 0.0, Direction::Forward), sample(1.0, 12.8, Direction::Forward)];
        let error = build_table(&samples, &rule()).unwrap_err();
        assert!(matches!(error, Error::BeyondConverter { at_mm: 1.0, .. }), "{error}");
    }
}
