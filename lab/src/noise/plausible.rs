//! Noises that might be a sensor's, whatever its residual says, each with what it is worth beforehand.

use super::kernel::{Noise, SlowPart};
use super::layout::Layout;
use super::noise_fit::{LONGEST_AGAINST_BLOCK, longest_block};
use crate::numerics::count;
use crate::policy::chance::{BESIDE_A_FITTED_PART, LIKE_A_WALK, NO_SLOW_PART, WALKS};

/// A noise of variance 1 but for its slow part, and its share of all.
#[derive(Debug, Clone)]
pub(crate) struct Plausible {
    /// Variances against one another; the scale is the residual's to tell.
    pub(crate) shape: Noise,
    /// What it is worth beforehand; those of all add to 1.
    pub(crate) share: f64,
}

/// Lengths and sizes of a slow part that is tried: each some three and five times the last, which a hundred
/// rows hardly tell apart.
const LENGTHS: usize = 7;
const SIZES: usize = 10;

/// Shortest length, in sample intervals: anything shorter is white.
const SHORTEST: f64 = 0.7;

/// Variances of what a slow part changes over the longest pass, against the white variance: one is lost
/// in the offsets there, the other leaves nothing white to be seen.
const FAINTEST: f64 = 3e-3;
const LOUDEST: f64 = 3e3;

/// White noise, alone and with a slow part of any length and size; and the same beside the shorter part
/// of a fitted noise.
#[must_use]
pub(crate) fn plausible(layout: &Layout, fitted: &Noise) -> Vec<Plausible> {
    let span = longest_block(layout).max(2.0);
    let Some(part) = fitted.slow.iter().min_by(|a, b| a.length.total_cmp(&b.length)) else {
        return upon(&Noise::white(), span, 1.0);
    };
    let kept = Noise { white: fitted.white, slow: vec![*part] };
    let kept = kept.scaled(1.0 / kept.variance().max(f64::MIN_POSITIVE));
    let mut all = upon(&Noise::white(), span, 1.0 - BESIDE_A_FITTED_PART);
    all.extend(upon(&kept, span, BESIDE_A_FITTED_PART));
    all
}

/// A noise alone and with one more slow part; `share` is what all are worth together.
fn upon(base: &Noise, span: f64, share: f64) -> Vec<Plausible> {
    let longest = LONGEST_AGAINST_BLOCK * span;
    let lengths = factors(SHORTEST, longest, LENGTHS);
    let sizes = factors(FAINTEST, LOUDEST, SIZES);
    let walks = sizes.iter().filter(|size| WALKS.contains(*size)).count();
    let of_any = (1.0 - NO_SLOW_PART - LIKE_A_WALK) / count(lengths.len() * sizes.len());
    let of_a_walk = LIKE_A_WALK / count(walks.max(1));
    let mut all = vec![Plausible { shape: base.clone(), share: share * NO_SLOW_PART }];
    for (place, &length) in lengths.iter().enumerate() {
        let kept = libm::exp(-span / length);
        for size in &sizes {
            let mut noise = base.clone();
            noise.slow.push(SlowPart { variance: size / (2.0 * (1.0 - kept)), length });
            let walks = place + 1 == lengths.len() && WALKS.contains(size);
            let own = of_any + if walks { of_a_walk } else { 0.0 };
            all.push(Plausible { shape: noise, share: share * own });
        }
    }
    all
}

/// So many values from one to another, by equal factors.
fn factors(from: f64, to: f64, points: usize) -> Vec<f64> {
    let by = libm::log(to / from) / count(points.saturating_sub(1).max(1));
    (0..points).map(|point| from * libm::exp(by * count(point))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::noise::Block;

    #[test]
    fn shares_add_to_one_and_a_walk_has_its_own() {
        let layout = Layout {
            blocks: vec![Block { sensor: 0, pass: 0, rows: 0..100, loudness: 0 }],
            clock: (0..100).map(count).collect(),
            inflation: vec![1.0; 100].into(),
        };
        let slow = vec![SlowPart { variance: 4.0, length: 2.0 }];
        for fitted in [Noise::white(), Noise { white: 1.0, slow }] {
            let all = plausible(&layout, &fitted);
            let sum: f64 = all.iter().map(|one| one.share).sum();
            assert!((sum - 1.0).abs() < 1e-12, "{sum}");
            let long =
                |one: &&Plausible| one.shape.slow.last().is_some_and(|part| 290.0 < part.length);
            let walks: f64 = all.iter().filter(long).map(|one| one.share).sum();
            assert!(LIKE_A_WALK < walks && walks < LIKE_A_WALK + 0.05, "{walks}");
        }
    }
}
