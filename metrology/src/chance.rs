//! Whether a mean square is more than chance.

use crate::number::number;

/// Sizes that something more may have, in equal steps of the logarithm.
const SIZES: usize = 64;

/// Probability that a mean square of so many degrees of freedom, in units of what chance makes, has
/// more in it, when as many records have as have not.
///
/// With more in it, the variance is anywhere between that of chance and `most` times it, every order
/// of magnitude alike (Jeffreys, Theory of Probability, 1939, 3.1); how probable each makes
/// the mean square is the density of χ².
pub(crate) fn beyond_chance(ratio: f64, freedom: f64, most: f64) -> f64 {
    if ratio.is_infinite() {
        return 1.0;
    }
    let most = most.max(ratio).max(1.0);
    // By the density for chance alone.
    let more = |size: usize| {
        let log = libm::log(most) * (number(size) + 0.5) / number(SIZES);
        libm::exp(freedom / 2.0 * (ratio * (1.0 - libm::exp(-log)) - log)) / number(SIZES)
    };
    let more: f64 = (0..SIZES).map(more).sum();
    if more.is_infinite() { 1.0 } else { more / (1.0 + more) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What chance makes is improbable to be more, ten times as much is not; where no more than chance
    /// is possible nothing can be told.
    #[test]
    fn a_difference_counts_by_how_far_it_is_beyond_chance() {
        assert!((beyond_chance(0.2, 1.0, 1.0) - 0.5).abs() < 1e-12);
        assert!(beyond_chance(1.0, 9.0, 1e4) < 0.1);
        assert!(0.999 < beyond_chance(10.0, 9.0, 1e4));
        assert!((beyond_chance(f64::INFINITY, 9.0, 1e4) - 1.0).abs() < 1e-12);
    }

    /// Of two degrees of freedom, for a ratio of 4 and sizes to 100 times: the integral of
    /// exp(4·(1 − 1/v))/v over ln v by Python, over ln 100, is 2.7935.
    #[test]
    fn two_degrees_of_freedom_by_hand() {
        let found = beyond_chance(4.0, 2.0, 100.0);
        assert!((found / (1.0 - found) - 2.7935).abs() < 1e-2 * 2.7935, "{found}");
    }
}
