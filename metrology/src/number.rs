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

/// The same of long ones in four sums, which a processor adds up side by side.
pub(crate) fn long_dot(one: &[f64], other: &[f64]) -> f64 {
    let length = one.len().min(other.len());
    let ((ones, one), (others, other)) =
        (one[..length].as_chunks::<4>(), other[..length].as_chunks::<4>());
    let sums = ones.iter().zip(others).fold([0.0; 4], |sums: [f64; 4], (one, other)| {
        std::array::from_fn(|lane| sums[lane] + one[lane] * other[lane])
    });
    sums.iter().sum::<f64>() + dot(one, other)
}
