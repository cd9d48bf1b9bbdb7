//! Separation by generalised least squares, without periodicity.
//!
//! Unknown is the bar at every place a probe touches, before the stroke too: more unknowns than
//! equations. What is missing is supplied by an assumption of what bars are: a smooth form, whose
//! second differences are small and independent (an integrated random walk), with a few waves.
//! How smooth is not chosen but left open, and so are the number of waves, their lengths, sizes
//! and phases: every smoothness with up to five waves is fitted and weighed by how probable it
//! makes the readings. The bar is the mean of them all, and its variance the mean of their variances
//! and the variance of their means (Hoeting et al., Statistical Science 14, 1999, 382).
//!
//! ```text
//! minimise  ‖z − A·(h + w)‖² + λ·‖D²·h‖²;     −2·ln p(z | λ) has  ln det(AᵀA + λ·DᵀD) − (n − 2)·ln λ
//! ```
//!
//! Source of the second term: Wahba 1985, "A comparison of GCV and GML". One smoothness alone, the
//! most probable, would be narrower than what is known; and without waves a bar that has some is
//! taken for a rough one. The noise is known from the scatter of the runs, so roughness of the bar
//! is not taken for noise. With one run it is estimated with the form, by the most probable
//! smoothness without waves, and nothing can be said about the uncertainty.
//! The matrix is a band, so the cost grows with the samples, not with their cube. A straight line
//! is in both null spaces; the first and the last place are held at zero to fix it.

mod posterior;
mod system;
mod waves;

use super::readings::Combined;
use super::separated::{Separated, without_line};
use crate::Error;
use crate::number::{dot, number};
use posterior::{affordable, posterior};
use system::System;

/// Smoothness weights tried, in quarter decades: from no smoothing to nothing but a line.
const SMOOTHNESS_TRIED: std::ops::RangeInclusive<i32> = -40..=32;

/// Finds the bar without assuming that it repeats with the stroke.
///
/// With `zeros_matched` the mean of `z` is taken as the bar's parabola; else the probes' zeros
/// are unknown, and the bar is given the parabola that belongs to a mean of zero.
///
/// Lost harmonics are no error here: what the spacings do not see is filled in smoothly, and the
/// uncertainty says so. There is none with one run, nor for records of more than 600 places or
/// with probes far apart in steps: waves would take too long to find there.
///
/// # Errors
///
/// When all samples are equal to rounding, so that no smoothness can be estimated from them.
pub fn separate_by_least_squares(
    combined: &Combined,
    zeros_matched: bool,
) -> Result<Separated, Error> {
    let offset_um = if zeros_matched { combined.offset_um } else { 0.0 };
    let z_um: Vec<f64> = combined.z_um.iter().map(|z| z + offset_um).collect();
    let z_um = with_new_noise(&z_um, combined.correlation);
    let system = System::new(&z_um, combined);
    let weights: Vec<f64> = SMOOTHNESS_TRIED.map(|q| libm::pow(10.0, f64::from(q) / 4.0)).collect();
    let noise_um2 = system.variance_of_mean_um2();
    let known = noise_um2.filter(|_| affordable(&system));
    let (places_um, covariance_um2) = match known {
        Some(noise_um2) => posterior(&system, noise_um2, &weights)
            .map(|found| (found.places_um, Some(found.covariance_um2))),
        None => most_probable(&system, noise_um2, &weights).map(|places_um| (places_um, None)),
    }
    .ok_or(Error::TooFewSamples { found: z_um.len(), expected: 4 })?;
    let covariance_um2 =
        covariance_um2.map(|rows| if zeros_matched { with_parabola(rows, combined) } else { rows });
    let back = combined.spacing.total();
    let touched_um = |sample: usize, behind: usize| places_um[sample + back - behind];
    Ok(Separated::with_carriage(combined, touched_um, covariance_um2))
}

/// The samples less what noise of each is its neighbour's, the rest as large as all of it was.
fn with_new_noise(z_um: &[f64], correlation: f64) -> Vec<f64> {
    let part = 1.0 / (1.0 - correlation * correlation).sqrt();
    let later = z_um.windows(2).map(|pair| (pair[1] - correlation * pair[0]) * part);
    z_um.iter().take(1).copied().chain(later).collect()
}

/// Adds what the runs do not agree on of the zeros: an offset o of `z` is a parabola o·x²/(L1·(L1 + L2)).
fn with_parabola(mut covariance_um2: Vec<Vec<f64>>, combined: &Combined) -> Vec<Vec<f64>> {
    let arms = number(combined.spacing.first * combined.spacing.total());
    let parabola =
        |sample: usize| combined.offset_uncertainty_um * number(sample) * number(sample) / arms;
    let parabola_um = without_line((0..covariance_um2.len()).map(parabola).collect());
    for (row, one_um) in covariance_um2.iter_mut().zip(&parabola_um) {
        for (value, other_um) in row.iter_mut().zip(&parabola_um) {
            *value += one_um * other_um;
        }
    }
    covariance_um2
}

/// The bar of the most probable smoothness, first of those a decade apart, then of those near it.
fn most_probable(system: &System<'_>, noise_um2: Option<f64>, weights: &[f64]) -> Option<Vec<f64>> {
    let misfit = |smoothness: f64| {
        let smooth = system.smooth(smoothness)?;
        let squares_um2 = dot(&smooth.left(system, system.z_um), system.z_um);
        let samples = number(system.z_um.len());
        let estimated = samples * libm::log(squares_um2 / samples);
        let misfit = noise_um2.map_or(estimated, |noise_um2| squares_um2 / noise_um2) + smooth.cost;
        // Readings without any form or noise fit exactly, with a likelihood beyond all bounds.
        (!misfit.is_nan()).then(|| (misfit, smooth.form(system, system.z_um)))
    };
    let fit = |index: usize| Some((index, misfit(weights[index])?));
    let better =
        |a: &(usize, (f64, Vec<f64>)), b: &(usize, (f64, Vec<f64>))| a.1.0.total_cmp(&b.1.0);
    let coarse = (0..weights.len()).step_by(4).filter_map(fit).min_by(better);
    let about = coarse.as_ref().map_or(0, |(index, _)| *index);
    let near = about.saturating_sub(3)..(about + 4).min(weights.len());
    near.filter_map(fit).min_by(better).map(|(_, (_, form_um))| form_um)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use crate::straightness::{Readings, Repeat, Spacing, separate_by_fourier};

    /// A smooth bar that does not repeat with the stroke.
    fn bar(place: f64) -> f64 {
        libm::sin(TAU * place / 45.0 + 0.4) + 0.3 * libm::cos(TAU * place / 13.0)
    }

    fn combined(spacing: Spacing) -> Combined {
        let probe = |back: usize| -> Vec<f64> {
            (0..32).map(|sample| bar(f64::from(sample) - number(back))).collect()
        };
        let probes_um = [0, spacing.first, spacing.total()].map(probe);
        let readings =
            Readings { start_mm: 0.0, step_mm: 5.0, repeats: vec![Repeat { probes_um }] };
        readings.combine(spacing).unwrap()
    }

    fn rms_error(found: &[f64]) -> f64 {
        let expected = without_line((0..32).map(|k| bar(f64::from(k))).collect());
        let squares = found.iter().zip(&expected).map(|(a, b)| (a - b) * (a - b));
        (squares.sum::<f64>() / 32.0).sqrt()
    }

    /// Spacing 1 and 1 leaves nothing but the line open, so noise-free readings give the bar.
    #[test]
    fn neighbouring_probes_give_the_bar_exactly() {
        let found = separate_by_least_squares(&combined(Spacing { first: 1, second: 1 }), true);
        assert!(rms_error(&found.unwrap().workpiece_um) < 1e-4);
    }

    /// At 0 the readings fit exactly, at 0.1 to rounding.
    #[test]
    fn a_flat_bar_is_flat() {
        for height_um in [0.0, 0.1] {
            let probes_um = [0, 1, 2].map(|_| vec![height_um; 33]);
            let repeats = vec![Repeat { probes_um }; 2];
            let readings = Readings { start_mm: 0.0, step_mm: 5.0, repeats };
            let combined = readings.combine(Spacing { first: 9, second: 8 }).unwrap();
            let found = separate_by_least_squares(&combined, false).unwrap();
            assert!(found.workpiece_um.iter().all(|h| h.abs() < 1e-12), "{found:?}");
        }
    }

    #[test]
    fn a_bar_that_does_not_repeat_is_found_better_than_by_fourier() {
        let combined = combined(Spacing { first: 5, second: 6 });
        let fourier = separate_by_fourier(&combined, false).unwrap();
        let found = separate_by_least_squares(&combined, true).unwrap();
        let (by_fourier, by_squares) =
            (rms_error(&fourier.workpiece_um), rms_error(&found.workpiece_um));
        assert!(by_squares < 0.2 * by_fourier, "{by_squares} {by_fourier}");
    }
}
