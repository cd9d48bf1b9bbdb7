//! Counts as numbers.

/// A count as a floating-point number, exact below 2⁵³.
#[expect(clippy::cast_precision_loss, reason = "nothing here is counted to 2⁵³")]
pub(crate) fn number(count: usize) -> f64 {
    count as f64
}
