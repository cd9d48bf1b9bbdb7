//! Bands of frequencies that hold more than the noise, though no line in them is clear: a wave whose
//! length changes, jumps that come in no even row.
//!
//! The fitted noise falls from its slow part to its white one, so that it can follow any slope of a
//! spectrum and no hump. Whitened by it, every frequency cell of noise gains a χ² with two degrees
//! of freedom, and `w` cells side by side one with `2w`: or with fewer where the noise is louder in
//! some rows than in others, since neighbouring cells are then alike (Satterthwaite 1946).

use nalgebra::DMatrix;

use super::order_spectrum::{Point, Scan};
use crate::noise::rms;
use crate::numerics::least_squares::{LinearFit, dot};
use crate::numerics::{chi_squared_tail, count, least_squares};

/// Cells of the narrowest and the widest band. A narrower one is a line; in a wider one the errors
/// of the noise's own spectrum outweigh chance, whose share is √(1/w).
const NARROWEST: usize = 4;
const WIDEST: usize = 32;

/// Bands that are fitted: a scan takes waves that hardly change between samples for strong ones.
const FITTED: usize = 12;

/// A band that holds more than noise.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Band {
    /// Its middle, cycles a unit of the coordinate.
    pub(crate) frequency: f64,
    /// Its width.
    pub(crate) width: f64,
    /// Root mean square of what is in it beyond noise, in the residual's unit.
    pub(crate) rms: f64,
    /// Chance of as much in any band of noise.
    pub(crate) p_value: f64,
}

/// The clearest band of a whitened residual, of those that lie apart from its slow end.
///
/// A scan finds the likeliest; what waves at every cell of a band take away together is fitted.
#[must_use]
pub(crate) fn clearest(scan: &Scan<'_>, white: &[f64]) -> Option<Band> {
    let cells = every_cell(scan.spectrum(white), scan.resolution());
    let widths = std::iter::successors(Some(NARROWEST), |width| Some(2 * width));
    let widths = widths.take_while(|width| *width <= WIDEST);
    // Half a width apart, from a width away from the slow end on.
    let places = |width: usize| (width..(cells.len() + 1).saturating_sub(width)).step_by(width / 2);
    let bands = widths.flat_map(|width| places(width).map(move |from| from..from + width));
    let bands: Vec<&[Point]> = bands.map(|band| &cells[band]).collect();
    let mut by_scan: Vec<(f64, &[Point])> =
        bands.iter().map(|band| (scanned(band), *band)).collect();
    by_scan.sort_by(|a, b| a.0.total_cmp(&b.0));
    let likeliest = by_scan.iter().take(FITTED).map(|(_, band)| fitted(scan, white, band));
    let best = likeliest.min_by(|a, b| a.p_value.total_cmp(&b.p_value))?;
    Some(Band { p_value: (best.p_value * count(bands.len())).min(1.0), ..best })
}

/// Chance of a band by the scan.
fn scanned(band: &[Point]) -> f64 {
    let gain = band.iter().map(|point| point.gain).sum();
    chi_squared_tail(gain, 2.0 * count(band.len()))
}

/// A band with what its waves take away together, and the chance of that at one place.
fn fitted(scan: &Scan<'_>, white: &[f64], band: &[Point]) -> Band {
    let waves: Vec<Vec<f64>> = band.iter().flat_map(|point| scan.wave(point.frequency)).collect();
    let views: Vec<&[f64]> = waves.iter().map(Vec::as_slice).collect();
    let fit = least_squares::fit(&views, white);
    let gain = dot(white, white) - fit.residual_square;
    let rank = count(fit.rank);
    let freedom = freedom(&views, white, &fit);
    let shown = scan.shown(band.iter().map(|point| point.frequency), &fit.coefficients);
    let beyond_noise = (1.0 - rank / gain.max(f64::MIN_POSITIVE)).max(0.0);
    let (first, last) = (band[0].frequency, band[band.len() - 1].frequency);
    Band {
        frequency: 0.5 * (first + last),
        width: last - first + scan.resolution(),
        rms: rms(scan.layout, &shown) * beyond_noise.sqrt(),
        p_value: chi_squared_tail(gain * freedom / rank.max(1.0), freedom),
    }
}

/// Rows whose squares are one estimate of how loud the noise is there: chosen, its variance is then
/// known to a third. Fewer take chance for loudness, more miss a short burst.
const ALIKE: usize = 16;

/// Degrees of freedom of what waves take away together, from what they leave.
///
/// Of noise `s·z` it is `zᵀSPSz` with the projection `P` on the waves; the χ² with its mean and its
/// variance has `tr(SPS)² / tr((SPS)²)` degrees of freedom.
pub(super) fn freedom(waves: &[&[f64]], white: &[f64], fit: &LinearFit) -> f64 {
    let left = least_squares::left(waves, white, &fit.coefficients);
    let loud = left.chunks(ALIKE).flat_map(|part| {
        let root = (dot(part, part) / count(part.len())).sqrt();
        std::iter::repeat_n(root, part.len())
    });
    let loud: Vec<f64> = loud.collect();
    let weighed: Vec<Vec<f64>> =
        waves.iter().map(|wave| wave.iter().zip(&loud).map(|(a, b)| a * b).collect()).collect();
    let size = waves.len();
    let upper =
        DMatrix::from_fn(
            size,
            size,
            |i, j| {
                if i <= j { dot(&weighed[i], &weighed[j]) } else { 0.0 }
            },
        );
    let spread = DMatrix::from_fn(size, size, |i, j| upper[(i.min(j), i.max(j))]);
    let taken = &fit.covariance * spread;
    let (mean, variance) = (taken.trace(), (&taken * &taken).trace());
    if 0.0 < variance { mean * mean / variance } else { count(fit.rank) }
}

/// One point of a scan a cell.
fn every_cell(points: Vec<Point>, cell: f64) -> Vec<Point> {
    let mut next = 0.0;
    let mut cells = Vec::new();
    for point in points {
        if next <= point.frequency {
            next = point.frequency + 0.99 * cell;
            cells.push(point);
        }
    }
    cells
}
