//! Plain figures of a series of numbers.

use std::ops::Range;

/// A count as a number to calculate with; exact up to 2⁵³.
#[expect(clippy::cast_precision_loss, reason = "no file has 2⁵³ rows")]
pub(crate) fn count(count: usize) -> f64 {
    count as f64
}

/// Largest less smallest value.
#[must_use]
pub(crate) fn spread(values: &[f64]) -> f64 {
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if low <= high { high - low } else { 0.0 }
}

/// Longest of ways or times that are infinite where there is none; 0 of none.
#[must_use]
pub(crate) fn longest(values: &[f64]) -> f64 {
    values.iter().copied().filter(|value| value.is_finite()).fold(0.0, f64::max)
}

/// Mean; 0 of none.
#[must_use]
pub(crate) fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / count(values.len().max(1))
}

/// Median of sizes; the lower one of an even number, 0 of none.
#[must_use]
pub(crate) fn median(sizes: &mut [f64]) -> f64 {
    one_in(sizes, 2)
}

/// Median of values of either sign, that of turned signs with its sign turned: the mean of the middle two of an even
/// number; 0 of none.
#[must_use]
pub(crate) fn middle(values: &mut [f64]) -> f64 {
    let [lower, upper] = middle_two(values);
    lower.midpoint(upper)
}

/// What is nearest to zero of all that has half of the values on either side.
#[must_use]
pub(crate) fn middle_nearest_zero(values: &mut [f64]) -> f64 {
    let [lower, upper] = middle_two(values);
    0.0_f64.clamp(lower, upper)
}

/// The two values that have as many below as above; one and the same of an odd number, 0 of none.
fn middle_two(values: &mut [f64]) -> [f64; 2] {
    if values.is_empty() {
        return [0.0; 2];
    }
    let is_odd = !values.len().is_multiple_of(2);
    let (below, upper, _) = values.select_nth_unstable_by(values.len() / 2, f64::total_cmp);
    let lower = below.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    [if is_odd { *upper } else { lower }, *upper]
}

/// Median size of a normal variable whose deviation is 1, inverted.
const MEDIAN_TO_DEVIATION: f64 = 1.482_6;

/// Deviation of the normal law whose median size some sizes have.
#[must_use]
pub(crate) fn deviation(sizes: &mut [f64]) -> f64 {
    MEDIAN_TO_DEVIATION * median(sizes)
}

/// Median of values with weights: half of all weight is on it and on smaller ones; 0 of none.
#[must_use]
pub(crate) fn weighted_median(pairs: &mut [(f64, f64)]) -> f64 {
    pairs.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    let half = 0.5 * pairs.iter().map(|(_, weight)| weight).sum::<f64>();
    let mut passed = 0.0;
    let middle = pairs.iter().find(|(_, weight)| {
        passed += weight;
        half <= passed
    });
    middle.map_or(0.0, |(value, _)| *value)
}

/// The largest value but for one in so many; 0 of none.
#[must_use]
pub(crate) fn one_in(values: &mut [f64], parts: usize) -> f64 {
    if values.is_empty() {
        return 0.0;
    }
    let place = (values.len() - 1) - values.len() / parts;
    *values.select_nth_unstable_by(place, f64::total_cmp).1
}

/// Root mean square of values about the mean of each of their parts.
pub(crate) fn rms_about_means(
    parts: impl IntoIterator<Item = Range<usize>>,
    values: &[f64],
) -> f64 {
    let mut square = 0.0;
    for rows in parts {
        let part = &values[rows];
        let mean = mean(part);
        square += part.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>();
    }
    (square / count(values.len().max(1))).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_middle_turns_its_sign_with_its_values() {
        for values in [&[3.0, -1.0, 7.0][..], &[3.0, -1.0, 7.0, 4.0], &[]] {
            let mut turned: Vec<f64> = values.iter().map(|value| -value).collect();
            assert_eq!(
                middle(&mut values.to_vec()).to_bits(),
                (0.0 - middle(&mut turned)).to_bits()
            );
        }
        assert_eq!(middle(&mut [4.0, 1.0, 9.0, 2.0]).to_bits(), 3.0_f64.to_bits());
        assert_eq!(
            middle_nearest_zero(&mut [-4.0, -1.0, -9.0, -2.0]).to_bits(),
            (-2.0_f64).to_bits()
        );
    }
}
