//! Values along axes, to be tried one by one.

use super::count;

/// So many values between two ends, evenly.
#[must_use]
pub(crate) fn evenly(low: f64, high: f64, points: usize) -> Vec<f64> {
    (0..points).map(|i| low + (high - low) * (count(i) + 0.5) / count(points)).collect()
}

/// So many values between two ends, evenly on a logarithmic scale.
#[must_use]
pub(crate) fn by_factors(low: f64, high: f64, points: usize) -> Vec<f64> {
    evenly(libm::log(low), libm::log(high), points).into_iter().map(libm::exp).collect()
}

/// Every point whose coordinates are values of the axes, the last one changing first.
#[must_use]
pub(crate) fn product(axes: &[Vec<f64>]) -> Vec<Vec<f64>> {
    axes.iter().fold(vec![Vec::new()], |points, axis| {
        let with = |point: &Vec<f64>| {
            let longer = |value: &f64| [point.as_slice(), &[*value]].concat();
            axis.iter().map(longer).collect::<Vec<_>>()
        };
        points.iter().flat_map(with).collect()
    })
}
