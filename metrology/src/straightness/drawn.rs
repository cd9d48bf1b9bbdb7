//! Uncertainty of a straightness from what is known of the heights, by drawing.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::reference_line::{StraightnessLines, straightness};
use super::separated::Separated;
use crate::banded::{Banded, Factor};
use crate::number::number;

/// Bars drawn: 23 of them are beyond each end of what is held.
const DRAWS: usize = 1000;
/// Part of the mean variance that is added to each: a line was taken off, so two are missing.
const LEAST_PART: f64 = 1e-9;

/// Each straightness of the bar as it may be (least-squares line, end points, minimum zone), µm, drawn;
/// `None` when the uncertainty of the heights is not known.
///
/// Heights are drawn from their covariance (JCGM 101:2008, 6.4.8 and 7), and as often as the method
/// is probably wrong from what is found then. A straightness is a largest less a smallest height, so
/// that of the mean heights is not the mean of what may be. Equal seeds give equal draws.
#[must_use]
pub fn drawn_straightness_um(separated: &Separated, seed: u64) -> Option<Vec<[f64; 3]>> {
    let own = Heights::new(separated)?;
    let other = separated.otherwise.as_deref().map(|(wrong, other)| (*wrong, Heights::new(other)));
    let mut chance = ChaCha8Rng::seed_from_u64(seed);
    let draw = |_| {
        let heights = match &other {
            Some((wrong, Some(other))) if chance.random_bool(*wrong) => other,
            _ => &own,
        };
        let lines = straightness(&separated.position_mm, &heights.drawn_um(&mut chance))?;
        Some(errors_um(&lines))
    };
    (0..DRAWS).map(draw).collect()
}

/// Standard uncertainty of each straightness of the bar, µm: the root mean square distance of what may
/// be, as drawn, from what was found.
#[must_use]
pub fn straightness_uncertainty_um(
    separated: &Separated,
    drawn_um: &[[f64; 3]],
) -> Option<[f64; 3]> {
    let found = errors_um(&straightness(&separated.position_mm, &separated.workpiece_um)?);
    let mut squares = [0.0; 3];
    for each_um in drawn_um {
        for (square, (error, found)) in squares.iter_mut().zip(each_um.iter().zip(&found)) {
            *square += (error - found).powi(2) / number(drawn_um.len());
        }
    }
    Some(squares.map(f64::sqrt))
}

/// Heights and how far they may be off together.
struct Heights<'a> {
    means_um: &'a [f64],
    factor: Factor,
}

impl<'a> Heights<'a> {
    fn new(separated: &'a Separated) -> Option<Self> {
        let covariance_um2 = separated.covariance_um2.as_ref()?;
        let size = covariance_um2.len();
        let trace: f64 = covariance_um2.iter().enumerate().map(|(place, row)| row[place]).sum();
        let mut matrix = Banded::zeros(size, size.saturating_sub(1));
        for (place, row) in covariance_um2.iter().enumerate() {
            for (other, value) in row.iter().enumerate().take(place + 1) {
                let least = if other == place { LEAST_PART * trace / number(size) } else { 0.0 };
                matrix.add(place, other, value + least);
            }
        }
        Some(Self { means_um: &separated.workpiece_um, factor: matrix.factor()? })
    }

    fn drawn_um(&self, chance: &mut ChaCha8Rng) -> Vec<f64> {
        let normal: Vec<f64> =
            self.means_um.iter().map(|_| StandardNormal.sample(chance)).collect();
        let drawn_um = self.factor.spread(&normal);
        self.means_um.iter().zip(drawn_um).map(|(mean, drawn)| mean + drawn).collect()
    }
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
            otherwise: None,
        };
        let found = drawn_straightness_um(&separated, 1)
            .and_then(|drawn_um| straightness_uncertainty_um(&separated, &drawn_um))
            .unwrap();
        for um in &found[1..] {
            assert!((um - 0.1).abs() < 0.012, "{found:?}");
        }
    }
}
