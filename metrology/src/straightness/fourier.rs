//! Separation by Fourier series, as document 2 does it.
//!
//! Assumes that the bar's form repeats with the stroke. A real bar does not: the first places
//! the second and third probe touch lie before the stroke, and the method puts there what it
//! found at its end. `least_squares` does without, and `Separated::with_difference_from` puts what
//! the two differ by into the uncertainty.

use std::f64::consts::TAU;

use helixlock_fourier::{Complex, backward, forward};

use super::readings::Combined;
use super::separated::{Separated, without_line};
use super::spacing::{Harmonic, highest_harmonic};
use crate::Error;
use crate::number::number;

/// Divides every harmonic of `z` by its weight.
///
/// With `accept_lost`, harmonics that the spacings lose are left at zero.
///
/// # Errors
///
/// Without `accept_lost`, when the spacings lose harmonics; the error names them.
pub fn separate_by_fourier(combined: &Combined, accept_lost: bool) -> Result<Separated, Error> {
    let (samples, spacing) = (combined.z_um.len(), combined.spacing);
    let lost = spacing.lost(samples);
    if !accept_lost && !lost.is_empty() {
        let (first, second) = (spacing.first, spacing.second);
        return Err(Error::LostHarmonics { first, second, samples, lost });
    }
    let kept: Vec<Harmonic> = spacing.harmonics(samples);
    let kept: Vec<Harmonic> = kept.into_iter().filter(|h| !lost.contains(&h.number)).collect();
    let workpiece_um = divide(&combined.z_um, &kept);
    let touched_um =
        |sample: usize, back: usize| workpiece_um[(sample + samples - back % samples) % samples];
    let by_distance_um2 = covariance_um2(combined, &kept);
    let whole = by_distance_um2.as_ref().filter(|_| samples <= MOST_WITH_COVARIANCE);
    let rows = whole.map(|found| without_lines(found));
    let found = Separated::with_carriage(combined, touched_um, rows);
    let alike = by_distance_um2.map(|found| vec![found[0].sqrt(); samples]);
    Ok(Separated { uncertainty_um: found.uncertainty_um.clone().or(alike), ..found })
}

/// Covariance of all places from that by distance: the line that is taken off the bar takes its
/// noise along, P·C·P.
fn without_lines(by_distance_um2: &[f64]) -> Vec<Vec<f64>> {
    let samples = by_distance_um2.len();
    let row = |place: usize| {
        without_line((0..samples).map(|other| by_distance_um2[place.abs_diff(other)]).collect())
    };
    let rows: Vec<Vec<f64>> = (0..samples).map(row).collect();
    let column = |other: usize| without_line(rows.iter().map(|row| row[other]).collect());
    (0..samples).map(column).collect()
}

/// Samples of which pairs are still few enough to keep.
const MOST_WITH_COVARIANCE: usize = 2000;

/// Forward transform, division by `A_k·e^(iψ_k)`, backward transform.
fn divide(z_um: &[f64], kept: &[Harmonic]) -> Vec<f64> {
    let samples = z_um.len();
    let mut spectrum: Vec<Complex<f64>> = z_um.iter().map(|&z| Complex::new(z, 0.0)).collect();
    forward(&mut spectrum);
    let mut divided = vec![Complex::new(0.0, 0.0); samples];
    for harmonic in kept {
        let (sin, cos) = libm::sincos(harmonic.phase_rad);
        let weight = Complex::new(harmonic.gain * cos, harmonic.gain * sin);
        let quotient = spectrum[harmonic.number] / weight;
        divided[harmonic.number] = quotient;
        divided[samples - harmonic.number] = quotient.conj();
    }
    backward(&mut divided);
    divided.iter().map(|value| value.re / number(samples)).collect()
}

/// `σ²/m · 2/N·Σ s_k·cos(2π·k·d/N)/A_k²` by the distance d in steps; of many samples the variance alone.
/// s is how much of the noise is of a harmonic: 1, or more of the long ones where a sample's noise is in
/// part its neighbour's, (1 − ρ²)/(1 − 2·ρ·cos(2π·k/N) + ρ²).
fn covariance_um2(combined: &Combined, kept: &[Harmonic]) -> Option<Vec<f64>> {
    let samples = combined.z_um.len();
    debug_assert!(kept.len() <= highest_harmonic(samples));
    let of_mean_um2 = combined.variance_of_mean_um2()?;
    let alike = combined.correlation;
    let turn = |part: usize| TAU * number(part % samples) / number(samples);
    let at_distance = |steps: usize| -> f64 {
        let each = kept.iter().map(|h| {
            let share = 1.0 - 2.0 * alike * libm::cos(turn(h.number)) + alike * alike;
            (1.0 - alike * alike) / share * libm::cos(turn(h.number * steps)) / (h.gain * h.gain)
        });
        of_mean_um2 * 2.0 / number(samples) * each.sum::<f64>()
    };
    let distances = if samples <= MOST_WITH_COVARIANCE { samples } else { 1 };
    Some((0..distances).map(at_distance).collect())
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::straightness::{Readings, Repeat, Spacing};

    /// Readings of a periodic bar on a moving, tilting carriage.
    fn readings(bar: &dyn Fn(f64) -> f64, shift_um: f64, slope: f64, spacing: Spacing) -> Readings {
        let probe = |back: usize| -> Vec<f64> {
            let reading = |sample: usize| {
                let x = number(sample);
                let place = x - number(back);
                let (carriage, tilt) = (0.4 * libm::cos(x / 3.0), 0.01 * libm::sin(x / 2.0));
                bar(place) + shift_um + slope * place + carriage + tilt * 5.0 * number(back)
            };
            (0..32).map(reading).collect()
        };
        let probes_um = [0, spacing.first, spacing.total()].map(probe);
        Readings { start_mm: 0.0, step_mm: 5.0, repeats: vec![Repeat { probes_um }] }
    }

    fn bar(place: f64) -> f64 {
        let turn = TAU * place / 32.0;
        libm::sin(turn) + 0.5 * libm::cos(3.0 * turn + 1.0) + 0.1 * libm::sin(9.0 * turn)
    }

    #[test]
    fn a_periodic_bar_and_the_carriage_come_apart() {
        let spacing = Spacing { first: 5, second: 6 };
        let combined = readings(&bar, 0.0, 0.0, spacing).combine(spacing).unwrap();
        let found = separate_by_fourier(&combined, false).unwrap();
        let expected = without_line((0..32).map(|k| bar(f64::from(k))).collect());
        for (found, expected) in found.workpiece_um.iter().zip(&expected) {
            assert!((found - expected).abs() < 1e-9, "{found} {expected}");
        }
        let tilt: Vec<f64> = (0..32).map(|k| 10.0 * libm::sin(f64::from(k) / 2.0)).collect();
        let mean = tilt.iter().sum::<f64>() / 32.0;
        for (found, expected) in found.tilt_urad.iter().zip(&tilt) {
            assert!((found - (expected - mean)).abs() < 1e-6, "{found} {expected}");
        }
    }

    /// A line has no covariance with anything once it is taken off.
    #[test]
    fn the_line_takes_its_noise_along() {
        let by_distance: Vec<f64> = (0..8).map(|d| libm::cos(f64::from(d) / 3.0)).collect();
        for row in without_lines(&by_distance) {
            let level: f64 = row.iter().sum();
            let slope: f64 = row.iter().enumerate().map(|(k, value)| number(k) * value).sum();
            assert!(level.abs() < 1e-12 && slope.abs() < 1e-11, "{level} {slope}");
        }
    }

    #[test]
    fn spacings_that_lose_harmonics_are_refused_by_name() {
        let spacing = Spacing { first: 4, second: 4 };
        let combined = readings(&bar, 0.0, 0.0, spacing).combine(spacing).unwrap();
        let error = separate_by_fourier(&combined, false).unwrap_err().to_string();
        assert!(error.contains("lose harmonics [8]"), "{error}");
        assert!(separate_by_fourier(&combined, true).is_ok());
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(32))]
        #[test]
        fn shift_and_tilt_of_the_bar_change_nothing(
            shift_um in -50.0..50.0f64,
            slope in -2.0..2.0f64,
        ) {
            let spacing = Spacing { first: 3, second: 4 };
            let still = readings(&bar, 0.0, 0.0, spacing).combine(spacing).unwrap();
            let moved = readings(&bar, shift_um, slope, spacing).combine(spacing).unwrap();
            let still = separate_by_fourier(&still, false).unwrap();
            let moved = separate_by_fourier(&moved, false).unwrap();
            for (a, b) in still.workpiece_um.iter().zip(&moved.workpiece_um) {
                prop_assert!((a - b).abs() < 1e-9);
            }
        }
    }
}
