//! Chauvenet's criterion.

use crate::number::number;
use std::f64::consts::SQRT_2;

/// True when a value this far from the mean of `count` values is to be rejected: fewer than half
/// a value would be expected there, `count · erfc(|d|/(σ√2)) < 1/2`.
///
/// `σ` is the standard deviation of the same values, estimated with `count − 1`. With four values
/// or fewer nothing can be rejected.
///
/// # Examples
///
/// The published limit for ten values is 1.96 σ.
///
/// ```
/// use helixlock_metrology::straightness::is_outlier;
///
/// assert!(!is_outlier(1.95, 1.0, 10));
/// assert!(is_outlier(1.97, 1.0, 10));
/// ```
#[must_use]
pub fn is_outlier(distance: f64, sigma: f64, count: usize) -> bool {
    let expected = number(count) * libm::erfc(distance.abs() / (sigma * SQRT_2));
    0.0 < sigma && expected < 0.5
}

#[cfg(test)]
mod tests {
    use super::is_outlier;

    /// J. R. Taylor, "An Introduction to Error Analysis", table of Chauvenet's criterion.
    #[test]
    fn published_limits() {
        for (count, limit) in [(5, 1.65), (10, 1.96), (20, 2.24), (50, 2.57)] {
            assert!(!is_outlier(limit - 0.01, 1.0, count), "{count}");
            assert!(is_outlier(limit + 0.01, 1.0, count), "{count}");
        }
    }

    #[test]
    fn equal_values_have_no_outlier() {
        assert!(!is_outlier(0.0, 0.0, 10));
    }
}
