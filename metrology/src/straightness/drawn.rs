//! Uncertainty of a straightness from what is known of the heights, by drawing.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::reference_line::{StraightnessLines, straightness};
use super::separated::Separated;
use crate::banded::Banded;
use crate::number::number;

/// Bars drawn: the uncertainty itself is known to 3.5 %.
const DRAWS: usize = 400;
/// Part of the mean variance that is added to each: a line was taken off, so two are missing.
const LEAST_PART: f64 = 1e-9;

/// Standard uncertainty of each straightness of the bar (least-squares line, end points, minimum
/// zone), µm; `None` when that of the heights is not known.
///
/// Heights are drawn from their covariance (JCGM 101:2008, 6.4.8 and 7). A straightness is a largest
/// less a smallest height, so that of the mean heights is not the mean of what may be: what counts is
/// the root mean square distance from it. Equal seeds give equal uncertainties.
#[must_use]
pub fn straightness_uncertainty_um(separated: &Separated, seed: u64) -> Option<[f64; 3]> {
    let covariance_um2 = separated.covariance_um2.as_ref()?;
    let (x_mm, mean_um) = (&separated.position_mm, &separated.workpiece_um);
    let size = covariance_um2.len();
    let trace: f64 = covariance_um2.iter().enumerate().map(|(place, row)| row[place]).sum();
    let mut matrix = Banded::zeros(size, size.saturating_sub(1));
    for (place, row) in covariance_um2.iter().enumerate() {
        for (other, value) in row.iter().enumerate().take(place + 1) {
            let least = if other == place { LEAST_PART * trace / number(size) } else { 0.0 };
            matrix.add(place, other, value + least);
        }
    }
    let factor = matrix.factor()?;
    let found = errors_um(&straightness(x_mm, mean_um)?);
    let mut chance = ChaCha8Rng::seed_from_u64(seed);
    let mut squares = [0.0; 3];
    for _ in 0..DRAWS {
        let normal: Vec<f64> = (0..size).map(|_| StandardNormal.sample(&mut chance)).collect();
        let drawn = factor.spread(&normal);
        let heights_um: Vec<f64> = mean_um.iter().zip(drawn).map(|(mean, d)| mean + d).collect();
        let errors_um = errors_um(&straightness(x_mm, &heights_um)?);
        for (square, (error, found)) in squares.iter_mut().zip(errors_um.iter().zip(&found)) {
            *square += (error - found).powi(2) / number(DRAWS);
        }
    }
    Some(squares.map(f64::sqrt))
}

fn errors_um(lines: &StraightnessLines) -> [f64; 3] {
    [lines.least_squares, lines.end_points, lines.minimum_zone].map(|line| line.error_um)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One place in the middle of a tent is uncertain, all others hardly.
    #[test]
    fn an_uncertain_top_is_an_uncertain_straightness() {
        let position_mm: Vec<f64> = (0..11).map(f64::from).collect();
        let workpiece_um = (0..11).map(|k| 5.0 - (f64::from(k) - 5.0).abs()).collect();
        let variance = |place: usize, other: usize| match (place, other) {
            (5, 5) => 0.01,
            _ if place == other => 1e-10,
            _ => 0.0,
        };
        let row = |place| (0..11).map(|other| variance(place, other)).collect();
        let separated = Separated {
            position_mm,
            workpiece_um,
            carriage_um: vec![0.0; 11],
            tilt_urad: vec![0.0; 11],
            uncertainty_um: None,
            covariance_um2: Some((0..11).map(row).collect()),
        };
        let found = straightness_uncertainty_um(&separated, 1).unwrap();
        for um in &found[1..] {
            assert!((um - 0.1).abs() < 0.012, "{found:?}");
        }
    }
}
