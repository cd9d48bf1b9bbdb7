//! Bands of frequencies that hold more than the noise, though no line in them is clear: a wave whose
//! length changes, jumps that come in no even row.
//!
//! The fitted noise falls from its slow part to its white one, so that it can follow any slope of a
//! spectrum and no hump. Whitened by it, every frequency cell of noise gains a χ² with two degrees
//! of freedom, and `w` cells side by side one with `2w`.

use super::order_spectrum::{Point, Scan};
use crate::numerics::{chi_squared_tail, count};

/// Cells of the narrowest and the widest band. A narrower one is a line; in a wider one the errors
/// of the noise's own spectrum outweigh chance, whose share is √(1/w).
const NARROWEST: usize = 4;
const WIDEST: usize = 32;

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
#[must_use]
pub(crate) fn clearest(scan: &Scan<'_>, white: &[f64]) -> Option<Band> {
    let cell = scan.resolution();
    let cells: Vec<Point> = every_cell(scan.spectrum(white), cell);
    let widths = std::iter::successors(Some(NARROWEST), |width| Some(2 * width));
    let widths = widths.take_while(|width| *width <= WIDEST);
    // Half a width apart, from a width away from the slow end on.
    let places = |width: usize| (width..(cells.len() + 1).saturating_sub(width)).step_by(width / 2);
    let bands: Vec<&[Point]> = widths
        .flat_map(|width| places(width).map(move |from| (from, width)))
        .map(|(from, width)| &cells[from..from + width])
        .collect();
    let chance = |band: &[Point]| {
        let gain = band.iter().map(|point| point.gain).sum();
        chi_squared_tail(gain, 2.0 * count(band.len()))
    };
    let tried = bands.iter().map(|band| (chance(band), *band));
    let (single, band) = tried.min_by(|a, b| a.0.total_cmp(&b.0))?;
    let (first, last) = (band[0].frequency, band[band.len() - 1].frequency);
    Some(Band {
        frequency: 0.5 * (first + last),
        width: last - first + cell,
        rms: band.iter().map(beyond_noise).sum::<f64>().max(0.0).sqrt(),
        p_value: (single * count(bands.len())).min(1.0),
    })
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

/// Mean square of a wave beyond that of noise, whose gain is 2.
fn beyond_noise(point: &Point) -> f64 {
    0.5 * point.amplitude * point.amplitude * (1.0 - 2.0 / point.gain.max(f64::MIN_POSITIVE))
}
