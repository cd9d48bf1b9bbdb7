//! Helical axial error of trapezoidal screws (JB/T 2886, grades 3 to 6).
//!
//! The actual helix against the theoretical one, so nothing is fitted: the largest change of the
//! travel deviation within a turn, 25 mm, 100 mm, 300 mm and the useful length.

use super::travel_variation::{enough_per_turn, over_any};
use super::{Characteristic, Curve};

/// `ΔL2π`, `ΔL25`, `ΔL100`, `ΔL300` and `ΔLu`, in this order.
///
/// A window longer than the curve has no value; neither has the turn when it is sampled less
/// than twice.
#[must_use]
pub fn helical_characteristics(curve: &Curve, lead_mm: f64) -> [Characteristic; 5] {
    let within = |window_mm: f64| over_any(curve, curve.deviation_um(), window_mm).map(|f| f.0);
    let turn = enough_per_turn(lead_mm / curve.median_step_mm()).and_then(|()| within(lead_mm));
    let make = |symbol, limit, meaning, reached| Characteristic { symbol, limit, meaning, reached };
    [
        make("ΔL2π", "helix-2pi", "helical axial error within any turn", turn),
        make("ΔL25", "helix-25", "helical axial error within any 25 mm", within(25.0)),
        make("ΔL100", "helix-100", "helical axial error within any 100 mm", within(100.0)),
        make("ΔL300", "helix-300", "helical axial error within any 300 mm", within(300.0)),
        make(
            "ΔLu",
            "helix-full",
            "helical axial error over the useful length",
            within(curve.length_mm()),
        ),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slope_shows_in_every_window_by_its_length() {
        let x: Vec<f64> = (0..=4000).map(|k| f64::from(k) / 4.0).collect();
        let y: Vec<f64> = x.iter().map(|x| 0.01 * x).collect();
        let found = helical_characteristics(&Curve::new(&x, &y).unwrap(), 6.0);
        let values = found.map(|one| one.reached.unwrap().value_um);
        for (value, expected) in values.iter().zip([0.06, 0.25, 1.0, 3.0, 10.0]) {
            assert!((value - expected).abs() < 1e-9, "{value} {expected}");
        }
    }
}
