//! Counts as numbers, and means.

/// A count as a floating-point number, exact below 2⁵³.
#[expect(clippy::cast_precision_loss, reason = "nothing here is counted to 2⁵³")]
pub(crate) fn number(count: usize) -> f64 {
    count as f64
}

/// Arithmetic mean; NaN of nothing.
pub(crate) fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / number(values.len())
}
