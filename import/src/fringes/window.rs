//! Phase of one detector: the analytic signal of uneven samples.
//!
//! In a window of four fringes, weighed by a raised cosine, light is fitted as
//!
//! ```text
//! I = m + s·u + a·cos(k·u) − b·sin(k·u)        φ = atan2(b, a)
//!
//! u way from the middle of the window    k carrier, rad a unit    m, s mean light and its slope
//! ```
//!
//! The covariance of a and b from what the fit leaves gives the standard deviation of φ: where
//! fringes fade it grows as noise over amplitude. On even samples without slope this is the Hilbert
//! transform behind the same window.

use std::f64::consts::{FRAC_PI_2, TAU};

use nalgebra::{SMatrix, SVector};

use super::Reading;
use super::carrier::number;

/// Fringes that a run needs.
pub(crate) const FEWEST_FRINGES: usize = 8;
/// Fringes in a window: two on either side keep the line of the fringes and its double apart.
const WIDTH: f64 = 4.0;
/// Samples that a window needs beside its four numbers.
const FEWEST_SAMPLES: usize = 8;

/// A reading a fringe.
pub(super) fn readings(way: &[f64], light: &[f64], carrier: f64) -> Vec<Reading> {
    let fringe = TAU / carrier;
    let length = way.last().copied().unwrap_or_default();
    let mut readings = Vec::new();
    let mut middle = 0.5 * WIDTH * fringe;
    while middle + 0.5 * WIDTH * fringe <= length {
        readings.extend(reading(way, light, carrier, middle));
        middle += fringe;
    }
    readings
}

/// Readings at the places of others, for a second wavelength.
pub(super) fn readings_at(
    way: &[f64],
    light: &[f64],
    carrier: f64,
    places: &[Reading],
) -> Vec<Reading> {
    places.iter().filter_map(|place| reading(way, light, carrier, place.way)).collect()
}

fn reading(way: &[f64], light: &[f64], carrier: f64, middle: f64) -> Option<Reading> {
    let half = 0.5 * WIDTH * TAU / carrier;
    let from = way.partition_point(|at| *at < middle - half);
    let to = way.partition_point(|at| *at <= middle + half);
    if to - from < FEWEST_SAMPLES {
        return None;
    }
    let samples = way[from..to].iter().zip(&light[from..to]);
    let rows: Vec<(SVector<f64, 4>, f64, f64)> = samples
        .map(|(at, light)| {
            let u = at - middle;
            let (sine, cosine) = libm::sincos(carrier * u);
            let taper = libm::cos(FRAC_PI_2 * u / half);
            (SVector::<f64, 4>::new(1.0, u / half, cosine, -sine), taper * taper, *light)
        })
        .collect();
    let mut normal = SMatrix::<f64, 4, 4>::zeros();
    let mut spread = SMatrix::<f64, 4, 4>::zeros();
    let mut right = SVector::<f64, 4>::zeros();
    for (columns, weight, light) in &rows {
        let square = columns * columns.transpose();
        normal += square * *weight;
        spread += square * (weight * weight);
        right += columns * (weight * light);
    }
    let inverse = normal.cholesky()?.inverse();
    let found = inverse * right;
    let missed = |(columns, weight, light): &(SVector<f64, 4>, f64, f64)| {
        let miss = light - columns.dot(&found);
        weight * miss * miss
    };
    let left: f64 = rows.iter().map(missed).sum();
    let weights: f64 = rows.iter().map(|(_, weight, _)| weight).sum();
    let free = 1.0 - 4.0 / number(to - from);
    let covariance = inverse * spread * inverse * (left / weights / free);
    let (a, b) = (found[2], found[3]);
    let power = (a * a + b * b).max(f64::MIN_POSITIVE);
    let across = SVector::<f64, 4>::new(0.0, 0.0, -b / power, a / power);
    let variance = across.dot(&(covariance * across)).max(0.0);
    let phase = libm::atan2(b, a);
    Some(Reading { way: middle, phase, deviation: variance.sqrt() })
}
