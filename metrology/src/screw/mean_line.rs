//! The mean line: least squares through a travel deviation curve.

use super::Curve;

/// The straight line `e = start_um + slope·(x − from_mm)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeanLine {
    /// Travel at which the line has the value `start_um`, mm: the start of the useful travel.
    pub from_mm: f64,
    /// Value there, µm.
    pub start_um: f64,
    /// Slope, µm of deviation per mm of travel (1 µm/mm is 1000 µm/m).
    pub slope_um_per_mm: f64,
}

/// What the samples count for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Weighting {
    /// Every sample alike, as the regression formulas of the standard have it.
    Samples,
    /// Every sample by the travel it stands for (half of both neighbouring intervals), so that
    /// a densely sampled stretch does not pull the line.
    Travel,
}

impl MeanLine {
    /// Value at a travel, µm.
    #[must_use]
    pub fn at(&self, travel_mm: f64) -> f64 {
        self.start_um + self.slope_um_per_mm * (travel_mm - self.from_mm)
    }
}

/// Least-squares line through a curve.
///
/// Sums are taken about the weighted centre, so that a long travel far from zero costs no digits.
/// Source: ISO 3408-3 (mean travel), in the textbook form; the formulas printed in document 5
/// lack terms.
#[must_use]
pub fn fit_mean_line(curve: &Curve, weighting: Weighting) -> MeanLine {
    let (x, y) = (curve.travel_mm(), curve.deviation_um());
    let weight = |index: usize| match weighting {
        Weighting::Samples => 1.0,
        Weighting::Travel => travel_of_sample(x, index),
    };
    let (mut sum, mut first_moment, mut sum_y) = (0.0, 0.0, 0.0);
    for (index, (x, y)) in x.iter().zip(y).enumerate() {
        let w = weight(index);
        (sum, first_moment, sum_y) = (sum + w, first_moment + w * x, sum_y + w * y);
    }
    let (centre_mm, mean_um) = (first_moment / sum, sum_y / sum);
    let (mut squares, mut products) = (0.0, 0.0);
    for (index, (x, y)) in x.iter().zip(y).enumerate() {
        let (w, dx) = (weight(index), x - centre_mm);
        (squares, products) = (squares + w * dx * dx, products + w * dx * (y - mean_um));
    }
    let slope_um_per_mm = products / squares;
    let from_mm = curve.first_mm();
    let start_um = mean_um + slope_um_per_mm * (from_mm - centre_mm);
    MeanLine { from_mm, start_um, slope_um_per_mm }
}

/// Half the travel between the two neighbours of a sample, mm.
fn travel_of_sample(travel_mm: &[f64], index: usize) -> f64 {
    let before = travel_mm[index.saturating_sub(1)];
    let after = travel_mm[(index + 1).min(travel_mm.len() - 1)];
    (after - before) / 2.0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Anscombe's first data set (The American Statistician 27, 1973): y = 3.000 + 0.500 x.
    #[test]
    fn anscombe() {
        let x = [4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0, 12.0, 13.0, 14.0];
        let y = [4.26, 5.68, 7.24, 4.82, 6.95, 8.81, 8.04, 8.33, 10.84, 7.58, 9.96];
        let line = fit_mean_line(&Curve::new(&x, &y).unwrap(), Weighting::Samples);
        assert!((line.slope_um_per_mm - 0.500_091).abs() < 1e-6, "{line:?}");
        assert!((line.at(0.0) - 3.000_091).abs() < 1e-6, "{line:?}");
    }

    #[test]
    fn weighting_by_travel_is_deaf_to_dense_stretches() {
        // A parabola sampled ten times denser in its first half.
        let mut x: Vec<f64> = (0..500).map(|k| f64::from(k) / 10.0).collect();
        x.extend((50..=100).map(f64::from));
        let y: Vec<f64> = x.iter().map(|x| x * x / 100.0).collect();
        let curve = Curve::new(&x, &y).unwrap();
        // The least-squares line through x²/100 on 0…100 has slope 1.
        let by_travel = fit_mean_line(&curve, Weighting::Travel);
        let by_samples = fit_mean_line(&curve, Weighting::Samples);
        assert!((by_travel.slope_um_per_mm - 1.0).abs() < 0.01, "{by_travel:?}");
        assert!(by_samples.slope_um_per_mm < 0.9, "{by_samples:?}");
    }
}
