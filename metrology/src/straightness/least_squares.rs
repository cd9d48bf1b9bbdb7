//! Separation by generalised least squares, without periodicity.
//!
//! Unknown is the bar at every place a probe touches, before the stroke too: more unknowns than
//! equations. What is missing is supplied by one assumption, that the bar is smooth: its second
//! differences are small and independent (an integrated random walk). How small is not chosen
//! but estimated, by the restricted likelihood of `z`, together with the noise:
//!
//! ```text
//! minimise  ‖z − A·h‖² + λ·‖D²·h‖²,     λ from   N·ln σ² + ln det(AᵀA + λ·DᵀD) − (n − 2)·ln λ
//! ```
//!
//! Where runs were repeated, σ² is not estimated from the form but known from their scatter, and
//! the first term is the penalised squares over σ². Roughness of the bar is then not taken for noise.
//! Source: Wahba 1985, "A comparison of GCV and GML" (the generalised maximum likelihood choice).
//! The matrix is a band, so the cost grows with the samples, not with their cube. A straight line
//! is in both null spaces; the first and the last place are held at zero to fix it.

use super::readings::Combined;
use super::separated::{Separated, without_line};
use crate::Error;
use crate::banded::{Banded, Factor};
use crate::number::number;

/// Above this many places the uncertainty, a full inverse, is not worked out.
const MOST_PLACES_WITH_UNCERTAINTY: usize = 2500;

/// Smoothness weights tried, in quarter decades: from no smoothing to nothing but a line, first a
/// decade apart, then about the best of those.
const SMOOTHNESS_TRIED: std::ops::RangeInclusive<i32> = -40..=32;

/// Finds the bar without assuming that it repeats with the stroke.
///
/// With `zeros_matched` the mean of `z` is taken as the bar's parabola; else the probes' zeros
/// are unknown, and the bar is given the parabola that belongs to a mean of zero.
///
/// Lost harmonics are no error here: what the spacings do not see is filled in smoothly, and the
/// uncertainty says so.
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
    let system = System { z_um: &z_um, combined };
    let fit =
        |quarters: i32| Some((quarters, system.fit(libm::pow(10.0, f64::from(quarters) / 4.0))?));
    let better = |a: &(i32, Fit), b: &(i32, Fit)| a.1.misfit.total_cmp(&b.1.misfit);
    let coarse = SMOOTHNESS_TRIED.step_by(4).filter_map(fit).min_by(better);
    let near = coarse.as_ref().map_or(0..=0, |(quarters, _)| quarters - 3..=quarters + 3);
    let best = near.filter_map(fit).min_by(better);
    let (_, best) = best.ok_or(Error::TooFewSamples { found: z_um.len(), expected: 4 })?;
    let back = combined.spacing.total();
    let uncertainty_um = system.uncertainty(&best);
    let touched_um = |sample: usize, behind: usize| best.places_um[sample + back - behind];
    Ok(Separated::with_carriage(combined, touched_um, uncertainty_um))
}

/// The equations, for any smoothness weight.
struct System<'a> {
    z_um: &'a [f64],
    combined: &'a Combined,
}

/// A solution for one smoothness weight.
struct Fit {
    /// The bar at every place touched, µm.
    places_um: Vec<f64>,
    /// Minus twice the restricted log likelihood.
    misfit: f64,
    /// Variance of `z`, µm²: known from the runs, or estimated.
    variance_um2: f64,
    factor: Factor,
}

impl System<'_> {
    fn places(&self) -> usize {
        self.z_um.len() + self.combined.spacing.total()
    }

    /// Variance of a mean `z` by the scatter of the runs, µm².
    fn variance_of_mean_um2(&self) -> Option<f64> {
        let sigma_um = self.combined.sigma_um.filter(|sigma_um| 0.0 < *sigma_um)?;
        Some(sigma_um * sigma_um / number(*self.combined.counts.iter().min()?))
    }

    /// Coefficients of one sample's equation, by place.
    fn equation(&self, sample: usize) -> [(usize, f64); 3] {
        let (spacing, r) = (self.combined.spacing, self.combined.spacing.ratio());
        let here = sample + spacing.total();
        [(here, 1.0), (here - spacing.first, -(1.0 + r)), (sample, r)]
    }

    fn fit(&self, smoothness: f64) -> Option<Fit> {
        let (places, samples) = (self.places(), self.z_um.len());
        let width = self.combined.spacing.total().max(2);
        let mut matrix = Banded::zeros(places - 2, width);
        let mut right = vec![0.0; places - 2];
        for (sample, z) in self.z_um.iter().enumerate() {
            let equation = free(&self.equation(sample), places);
            matrix.add_outer(&equation, 1.0);
            for (place, value) in equation {
                right[place] += value * z;
            }
        }
        for middle in 1..places - 1 {
            matrix.add_outer(&free(&second_difference(middle), places), smoothness);
        }
        let factor = matrix.factor()?;
        let mut places_um = vec![0.0];
        places_um.extend(factor.solve(&right));
        places_um.push(0.0);
        let squares_um2 = self.penalised_squares(&places_um, smoothness);
        let estimated_um2 = squares_um2 / number(samples);
        let known_um2 = self.variance_of_mean_um2();
        let variance_um2 = known_um2.unwrap_or(estimated_um2);
        let estimated_misses = number(samples) * libm::log(estimated_um2);
        let misses = known_um2.map_or(estimated_misses, |known_um2| squares_um2 / known_um2);
        let misfit = misses + factor.log_determinant() - number(places - 2) * libm::log(smoothness);
        // Readings without any form or noise fit exactly, with a likelihood beyond all bounds.
        (!misfit.is_nan()).then_some(Fit { places_um, misfit, variance_um2, factor })
    }

    fn penalised_squares(&self, places_um: &[f64], smoothness: f64) -> f64 {
        let value = |row: &[(usize, f64)]| row.iter().map(|(p, c)| c * places_um[*p]).sum::<f64>();
        let misses = self.z_um.iter().enumerate().map(|(s, z)| z - value(&self.equation(s)));
        let bends = (1..places_um.len() - 1).map(|middle| value(&second_difference(middle)));
        misses.map(|miss| miss * miss).sum::<f64>()
            + smoothness * bends.map(|bend| bend * bend).sum::<f64>()
    }

    /// Standard uncertainty at each sample after the line is removed: the diagonal of the
    /// posterior covariance, projected.
    fn uncertainty(&self, fit: &Fit) -> Option<Vec<f64>> {
        let (places, back) = (self.places(), self.combined.spacing.total());
        if MOST_PLACES_WITH_UNCERTAINTY < places {
            return None;
        }
        let column = |place: usize| -> Vec<f64> {
            let mut unit = vec![0.0; places - 2];
            if let Some(element) = place.checked_sub(1).and_then(|free| unit.get_mut(free)) {
                *element = 1.0;
            }
            let solved = fit.factor.solve(&unit);
            let padded = std::iter::once(0.0).chain(solved).chain(std::iter::once(0.0));
            without_line(padded.skip(back).collect())
        };
        // Rows of P·C; removing the line along the other side too gives P·C·P.
        let columns: Vec<Vec<f64>> = (back..places).map(column).collect();
        let row = |sample: usize| without_line(columns.iter().map(|c| c[sample]).collect());
        let variance = (0..columns.len()).map(|sample| row(sample)[sample] * fit.variance_um2);
        Some(variance.map(|variance| variance.max(0.0).sqrt()).collect())
    }
}

fn second_difference(middle: usize) -> [(usize, f64); 3] {
    [(middle - 1, 1.0), (middle, -2.0), (middle + 1, 1.0)]
}

/// A row without the two places held at zero, numbered from the first free one.
fn free(row: &[(usize, f64)], places: usize) -> Vec<(usize, f64)> {
    let is_free = |place: usize| 0 < place && place < places - 1;
    row.iter().filter(|(place, _)| is_free(*place)).map(|(place, c)| (place - 1, *c)).collect()
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
