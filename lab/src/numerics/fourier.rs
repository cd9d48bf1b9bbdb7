//! Fourier sums over unevenly placed samples in O(n log n).

use helixlock_fourier::{Complex, forward};

/// Cells of the grid a frequency; the highest is at half of what the grid resolves.
const OVERSAMPLING: f64 = 4.0;

/// Cells on either side that a weight is spread to.
const REACH: usize = 4;

/// Deviation in cells of the Gaussian it is spread by: what is cut off and what comes back from
/// beyond the grid are 2e-4 each at the highest frequency, and far less below.
const DEVIATION: f64 = 0.95;

/// Sizes `|Σ weightᵢ·exp(−2πi·f·uᵢ)|` at `f = k·step`, `k = 0 … count − 1`.
///
/// Each weight is spread to eight cells of a grid by a Gaussian, transformed, and the Gaussian
/// divided out (Greengard and Lee 2004, *Accelerating the nonuniform fast Fourier transform*, SIAM
/// Review 46:443). Good for finding peaks; what is found is fitted exactly afterwards.
#[must_use]
pub(crate) fn sizes(places: &[f64], weights: &[f64], step: f64, count: usize) -> Vec<f64> {
    let start = places.iter().copied().fold(f64::INFINITY, f64::min);
    let pairs = pairs_of_cells(count);
    let cells = super::count(2 * pairs);
    let mut grid = vec![Complex::new(0.0, 0.0); pairs];
    let gaussian = Gaussian::new();
    for (place, weight) in places.iter().zip(weights) {
        gaussian.spread(&mut grid, (place - start) * step * cells, *weight);
    }
    forward(&mut grid);
    (0..count)
        .map(|index| {
            let cycles = super::count(index) / cells;
            unpacked(&grid, index, cycles).norm_sqr().sqrt() / Gaussian::transformed(cycles)
        })
        .collect()
}

/// Transform of real cells that were packed in pairs, even ones real and odd ones imaginary.
fn unpacked(grid: &[Complex<f64>], index: usize, cycles: f64) -> Complex<f64> {
    let mirrored = grid[(grid.len() - index) % grid.len()].conj();
    let (even, odd) = (grid[index] + mirrored, grid[index] - mirrored);
    let (sine, cosine) = libm::sincos(-std::f64::consts::TAU * cycles);
    0.5 * (even + Complex::new(cosine, sine) * Complex::new(odd.im, -odd.re))
}

fn pairs_of_cells(count: usize) -> usize {
    let wanted = 0.5 * OVERSAMPLING * super::count(count.max(4));
    let mut pairs = 16;
    while super::count(pairs) < wanted {
        pairs *= 2;
    }
    // Three quarters of a power of two are transformed as fast.
    if wanted <= 0.75 * super::count(pairs) { pairs / 4 * 3 } else { pairs }
}

/// `exp(−d²/2s²)` at distances in cells.
struct Gaussian {
    /// At whole distances, from `1 − REACH` to `REACH`.
    whole: [f64; 2 * REACH],
}

impl Gaussian {
    fn new() -> Self {
        let distance = |offset: usize| super::count(offset) + 1.0 - super::count(REACH);
        Self { whole: std::array::from_fn(|offset| at(distance(offset))) }
    }

    /// Adds a weight at a fractional cell to the cells around it, cyclically.
    fn spread(&self, grid: &mut [Complex<f64>], place: f64, weight: f64) {
        let whole = place.floor();
        let beyond = place - whole;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "places are counted from their minimum, so this is a small non-negative number"
        )]
        let cell = whole as usize + 2 * grid.len() + 1 - REACH;
        // exp(−(o − t)²/2s²) = exp(−o²/2s²)·exp(−t²/2s²)·exp(t/s²)^o
        let ratio = libm::exp(beyond / (DEVIATION * DEVIATION));
        let mut share = weight * at(beyond) / (ratio * ratio * ratio);
        for (offset, whole) in self.whole.iter().enumerate() {
            let cell = (cell + offset) % (2 * grid.len());
            let pair = &mut grid[cell / 2];
            let slot = if cell.is_multiple_of(2) { &mut pair.re } else { &mut pair.im };
            *slot += share * whole;
            share *= ratio;
        }
    }

    /// Its transform at a frequency in cycles a cell.
    fn transformed(cycles: f64) -> f64 {
        let phase = std::f64::consts::TAU * DEVIATION * cycles;
        DEVIATION * std::f64::consts::TAU.sqrt() * libm::exp(-0.5 * phase * phase)
    }
}

fn at(distance: f64) -> f64 {
    libm::exp(-0.5 * (distance / DEVIATION) * (distance / DEVIATION))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agree_with_the_sum_as_written() {
        let places: Vec<f64> = (0..300).map(|i| 5.0 + 0.01 * f64::from(i * i % 977)).collect();
        let weights: Vec<f64> = (0..300).map(|i| libm::sin(f64::from(i * 37))).collect();
        let (step, count) = (0.02, 400);
        let fast = sizes(&places, &weights, step, count);
        let size: f64 = weights.iter().map(|w| w.abs()).sum();
        for index in [0, 1, 17, 200, 399] {
            let direct: Complex<f64> = places
                .iter()
                .zip(&weights)
                .map(|(u, w)| {
                    let angle = -std::f64::consts::TAU * step * f64::from(index) * u;
                    Complex::new(w * libm::cos(angle), w * libm::sin(angle))
                })
                .sum();
            let error = (fast[usize::try_from(index).unwrap()] - direct.norm()).abs();
            assert!(error < 1e-3 * size, "{index}: {error} of {size}");
        }
    }
}
