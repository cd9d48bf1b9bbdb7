//! Jumps in a residual: changes from sample to sample that no slow noise makes.

use statrs::distribution::{DiscreteCDF, Poisson};

use crate::count;
use crate::fit::Fit;
use crate::noise::Whitener;
use crate::noise_fit::median;
use crate::problem::Problem;

/// A whitened sample beyond this many deviations is a jump.
const DEVIATIONS: f64 = 5.0;

/// Chance of such a sample in Gaussian noise, both signs.
const CHANCE: f64 = 5.733e-7;

/// Usual size of the jumps, µm (arcsec), and the chance of so many in Gaussian noise.
///
/// Outliers are weighed down already, and they come back with the next sample; a jump stays.
/// `None` when there are fewer than two, which a slip or a knock explains.
#[must_use]
pub fn jumps(problem: &Problem, fit: &Fit) -> Option<(f64, f64)> {
    let white = Whitener::new(&problem.layout, &fit.noises).whiten(&fit.left);
    let mut sizes = Vec::new();
    for block in &problem.layout.blocks {
        for row in block.rows.clone().skip(1) {
            if DEVIATIONS < white[row].abs() {
                sizes.push((fit.left[row] - fit.left[row - 1]).abs());
            }
        }
    }
    if sizes.len() < 2 {
        return None;
    }
    let expected = CHANCE * count(white.len());
    let beyond = u64::try_from(sizes.len()).unwrap_or(u64::MAX) - 1;
    let p_value = Poisson::new(expected).map_or(1.0, |law| law.sf(beyond));
    Some((median(&mut sizes), p_value))
}
