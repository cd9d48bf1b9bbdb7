//! From two scales to an 8-bit number.
//!
//! Slider A feeds both windings of scale B with `cos θA` and `sin θA`; what B returns is
//! `e = K1·K2·Em·sin ωt·sin(θA − θB)` with `θ = 2πx/T`. Amplified and demodulated, only
//! `sin(θA − θB)` is left, and an 8-bit converter makes a number of it.

use std::f64::consts::TAU;

/// Amplifier, demodulator and converter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Detector {
    /// Pitch T of both scales, mm (2 mm for the usual inductosyn).
    pub pitch_mm: f64,
    /// Smallest difference the converter tells apart, µm: the gain in front of it.
    pub lsb_um: f64,
}

impl Detector {
    /// The converter's number for a difference of the scales, `xA − xB`, from −128 to 127.
    ///
    /// The gain is set so that small differences come out as `difference/lsb`; larger ones come
    /// out smaller by the sine, and beyond ±128 LSB the converter saturates.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "clamped to the eight bits just before")]
    pub fn code(&self, difference_um: f64) -> i8 {
        let volts_in_lsb = self.linear_um(difference_um) / self.lsb_um;
        volts_in_lsb.round().clamp(-128.0, 127.0) as i8
    }

    /// The difference a number stands for, µm: the scale factor that makes the memory show µm.
    #[must_use]
    pub fn difference_um(&self, code: i8) -> f64 {
        f64::from(code) * self.lsb_um
    }

    /// Largest error of taking the sine for its angle within the converter's range, µm.
    #[must_use]
    pub fn sine_error_um(&self) -> f64 {
        let range_um = 128.0 * self.lsb_um;
        range_um - self.linear_um(range_um)
    }

    fn linear_um(&self, difference_um: f64) -> f64 {
        let um_per_rad = 1000.0 * self.pitch_mm / TAU;
        um_per_rad * libm::sin(difference_um / um_per_rad)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DETECTOR: Detector = Detector { pitch_mm: 2.0, lsb_um: 0.1 };

    #[test]
    fn small_differences_come_out_in_steps_of_the_lsb() {
        assert_eq!(DETECTOR.code(5.5), 55);
        assert_eq!(DETECTOR.code(-5.5), -55);
        assert_eq!(DETECTOR.code(100.0), 127);
        assert!((DETECTOR.difference_um(DETECTOR.code(3.12)) - 3.1).abs() < 1e-12);
    }

    /// 12.8 µm of 2 mm are 2.3°: the sine is off by x³/6, a third of a nanometre.
    #[test]
    fn the_sine_is_straight_enough() {
        let turn_rad = 12.8 / 1000.0 * TAU / 2.0;
        let by_series_um = 12.8 * turn_rad * turn_rad / 6.0;
        assert!((DETECTOR.sine_error_um() - by_series_um).abs() < 1e-5);
        assert!(DETECTOR.sine_error_um() < 0.1 / 20.0);
    }
}
