//! The recorder's low-pass (fig. 10): keeps the machine's error, removes the comparison.
//!
//! Document 1 draws an ideal characteristic and calls the circuit "basically an integrator". Here
//! it is one resistor and one capacitor behind the reading of each comparison, held until the next:
//!
//! ```text
//! y ← y + (x − y)·(1 − exp(−2π·f·Δt))      x, y in µm    f, cut-off, in Hz    Δt in s
//! ```
//!
//! That is exact for a held reading, however the comparisons are spaced.

use std::f64::consts::TAU;

/// Readings `(time_s, error_um)` as the pen draws them, starting at rest on the first one.
#[must_use]
pub fn filtered_um(times_s: &[f64], readings_um: &[f64], cutoff_hz: Option<f64>) -> Vec<f64> {
    let Some(cutoff_hz) = cutoff_hz else { return readings_um.to_vec() };
    let mut pen_um = readings_um.first().copied().unwrap_or(0.0);
    let mut held_um = pen_um;
    let mut last_s = times_s.first().copied().unwrap_or(0.0);
    let draw = |(&time_s, &reading_um): (&f64, &f64)| {
        pen_um -= (held_um - pen_um) * libm::expm1(-TAU * cutoff_hz * (time_s - last_s));
        (held_um, last_s) = (reading_um, time_s);
        pen_um
    };
    times_s.iter().zip(readings_um).map(draw).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_reaches_63_per_cent_after_one_time_constant() {
        // 1 Hz is a time constant of 1/2π s.
        let times_s = [0.0, 0.0, 1.0 / TAU, 2.0 / TAU];
        let pen_um = filtered_um(&times_s, &[0.0, 1.0, 1.0, 1.0], Some(1.0));
        assert!((pen_um[2] - 0.632_120_558_828_557_7).abs() < 1e-15);
        assert!((pen_um[3] - 0.864_664_716_763_387_3).abs() < 1e-15);
    }

    #[test]
    fn without_a_filter_nothing_changes() {
        assert_eq!(filtered_um(&[0.0, 1.0], &[3.0, -4.0], None), [3.0, -4.0]);
    }
}
