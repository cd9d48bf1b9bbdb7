//! Counts as numbers, means, and sums of products.

/// A count as a floating-point number, exact below 2⁵³.
#[expect(clippy::cast_precision_loss, reason = "nothing here is counted to 2⁵³")]
pub(crate) fn number(count: usize) -> f64 {
    count as f64
}

/// Arithmetic mean; NaN of nothing.
pub(crate) fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / number(values.len())
}

/// Sum of the products of two rows of numbers.
pub(crate) fn dot(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(one, other)| one * other).sum()
}
