//! Combs of frequencies: what comes again evenly in no smooth shape, and whose harmonics hold, each by itself, no
//! more than noise may.

use super::bands::freedom;
use super::order_spectrum::{POINTS_A_CELL, Point, Scan};
use crate::numerics::least_squares::dot;
use crate::numerics::{chi_squared_tail, count, least_squares, usual_rate};

/// Harmonics of a comb, the first among them. Of fewer the strongest tells; more are those of a pulse shorter than a
/// hundredth of its period, whose samples lie far from their neighbours.
const TEETH: [u32; 3] = [4, 8, 16];

/// Combs of each number of teeth that are fitted: a scan takes waves that hardly change between samples for strong
/// ones.
const FITTED: usize = 4;

/// A comb that holds more than noise.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Comb {
    /// Its first frequency, cycles a unit of the coordinate.
    pub(crate) frequency: f64,
    /// Its strongest harmonic, and all others.
    pub(crate) strongest: u32,
    pub(crate) others: Vec<u32>,
    /// Combs of noise that were looked at.
    pub(crate) looks: f64,
    /// Chance of as much beside its strongest harmonic, at one place of noise that was fitted with all of it inside.
    chance: f64,
}

/// The clearest comb of a whitened residual.
#[must_use]
pub(crate) fn clearest(scan: &Scan<'_>, white: &[f64]) -> Option<Comb> {
    // Above half the usual rate a harmonic is the alias of another.
    let highest = scan.highest.min(0.5 * usual_rate(scan.turns));
    let mut spectrum = scan.spectrum(white);
    spectrum.retain(|point| point.frequency <= highest);
    let looks = count(TEETH.len() * spectrum.len()) / POINTS_A_CELL * LOOKS_A_CELL;
    let all = TEETH.into_iter().flat_map(|teeth| likeliest(scan, &spectrum, teeth));
    let fitted = all.map(|comb| fitted(scan, white, comb, looks));
    fitted.min_by(|a, b| a.chance.total_cmp(&b.chance))
}

/// Independent places a frequency cell, as for lines.
const LOOKS_A_CELL: f64 = 2.0;

/// Combs of so many teeth in which a scan finds most beside the strongest tooth, with their first frequencies.
fn likeliest(scan: &Scan<'_>, spectrum: &[Point], teeth: u32) -> Vec<(u32, f64)> {
    let Some(first) = spectrum.first() else { return Vec::new() };
    let step = scan.resolution() / POINTS_A_CELL;
    let gain = |frequency: f64| {
        let place = ((frequency - first.frequency) / step).round().max(0.0);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a place in a spectrum"
        )]
        spectrum.get(place as usize).map_or(0.0, |point| point.gain)
    };
    let of = |last: &Point| {
        let frequency = last.frequency / f64::from(teeth);
        let gains = (1..=teeth).map(|tooth| gain(f64::from(tooth) * frequency));
        let (sum, most) =
            gains.fold((0.0, 0.0_f64), |(sum, most), gain| (sum + gain, most.max(gain)));
        (sum - most, frequency)
    };
    let lasts = spectrum.iter().filter(|last| f64::from(teeth) * first.frequency <= last.frequency);
    let mut all: Vec<(f64, f64)> = lasts.map(of).collect();
    all.sort_by(|a, b| b.0.total_cmp(&a.0));
    all.into_iter().take(FITTED).map(|(_, frequency)| (teeth, frequency)).collect()
}

/// A comb with what its waves take away together beside the strongest of them, and the chance of that at one place.
fn fitted(scan: &Scan<'_>, white: &[f64], (teeth, frequency): (u32, f64), looks: f64) -> Comb {
    let frequencies = (1..=teeth).map(|tooth| f64::from(tooth) * frequency);
    let waves: Vec<[Vec<f64>; 2]> = frequencies.clone().map(|one| scan.wave(one)).collect();
    let views: Vec<&[f64]> = waves.iter().flatten().map(Vec::as_slice).collect();
    let square = dot(white, white);
    let gain = |views: &[&[f64]]| square - least_squares::fit(views, white).residual_square;
    let gains = (1..=teeth).zip(views.chunks(2).map(gain));
    let (strongest, most) = gains.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((1, 0.0));
    let fit = least_squares::fit(&views, white);
    let taken = square - fit.residual_square;
    let rank = count(fit.rank);
    // One wave of them less.
    let beside = (1.0 - 2.0 / rank.max(3.0)) * freedom(&views, white, &fit);
    let scale = beside / (rank - 2.0).max(1.0);
    let others = (1..=teeth).filter(|tooth| *tooth != strongest).collect();
    let chance = chi_squared_tail((taken - most) * scale, beside);
    Comb { frequency, strongest, others, looks, chance }
}
