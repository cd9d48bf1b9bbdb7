//! What separation gives: the bar, the carriage, and their uncertainty.

use super::readings::Combined;
use crate::number::number;

/// Bar and carriage apart, each with its least-squares line removed.
#[derive(Clone, Debug, PartialEq)]
pub struct Separated {
    /// Places on the bar, mm.
    pub position_mm: Vec<f64>,
    /// Straightness h of the bar there, µm.
    pub workpiece_um: Vec<f64>,
    /// Straightness δ of the carriage motion, µm.
    pub carriage_um: Vec<f64>,
    /// Tilt β of the carriage, µrad, its mean removed.
    pub tilt_urad: Vec<f64>,
    /// Standard uncertainty (k = 1) of h at each place from the scatter of the runs, µm; absent
    /// when nothing was repeated.
    pub uncertainty_um: Option<Vec<f64>>,
    /// Covariance of h at the places, whose diagonal that is squared, µm².
    pub covariance_um2: Option<Vec<Vec<f64>>>,
}

impl Separated {
    /// The same with the difference from another method in the uncertainty.
    ///
    /// What the two methods may differ by although both are right, the difference of their
    /// variances, is taken off the mean square difference; the rest is what one of them assumes
    /// wrongly, such as that the bar repeats with the stroke.
    #[must_use]
    pub fn with_difference_from(mut self, other: &Self) -> Self {
        let difference_um2 = self.mean_square_difference_um2(other);
        let variance = |each: &Option<Vec<f64>>| each.as_deref().map_or(0.0, mean_square);
        let expected_um2 = (variance(&other.uncertainty_um) - variance(&self.uncertainty_um)).abs();
        let excess_um2 = (difference_um2 - expected_um2).max(0.0);
        for u_um in self.uncertainty_um.iter_mut().flatten() {
            *u_um = libm::sqrt(*u_um * *u_um + excess_um2);
        }
        for (place, row) in self.covariance_um2.iter_mut().flatten().enumerate() {
            row[place] += excess_um2;
        }
        self
    }

    /// How far two separations of the same readings are apart over the bar, µm rms.
    #[must_use]
    pub fn rms_difference_um(&self, other: &Self) -> f64 {
        self.mean_square_difference_um2(other).sqrt()
    }

    fn mean_square_difference_um2(&self, other: &Self) -> f64 {
        let pairs = self.workpiece_um.iter().zip(&other.workpiece_um);
        let squares: f64 = pairs.map(|(a, b)| (a - b) * (a - b)).sum();
        squares / number(self.workpiece_um.len())
    }

    /// Puts the carriage beside a bar known at all places the three probes touch.
    ///
    /// `touched_um(sample, back)` is h at the place `back` steps behind a sample.
    pub(super) fn with_carriage(
        combined: &Combined,
        touched_um: impl Fn(usize, usize) -> f64,
        covariance_um2: Option<Vec<Vec<f64>>>,
    ) -> Self {
        let samples = combined.z_um.len();
        let positions = (0..samples).map(|sample| place(combined, sample));
        let workpiece_um = (0..samples).map(|sample| touched_um(sample, 0)).collect();
        let motion = (0..samples).map(|sample| carriage(combined, sample, &touched_um));
        let (carriage_um, tilt_urad): (Vec<f64>, Vec<f64>) = motion.unzip();
        let mean_tilt = crate::number::mean(&tilt_urad);
        let uncertainty = |rows: &Vec<Vec<f64>>| -> Vec<f64> {
            rows.iter().enumerate().map(|(place, row)| row[place].max(0.0).sqrt()).collect()
        };
        let uncertainty_um = covariance_um2.as_ref().map(uncertainty);
        Self {
            position_mm: positions.collect(),
            workpiece_um: without_line(workpiece_um),
            carriage_um: without_line(carriage_um),
            tilt_urad: tilt_urad.iter().map(|tilt| tilt - mean_tilt).collect(),
            uncertainty_um,
            covariance_um2,
        }
    }
}

fn mean_square(values: &[f64]) -> f64 {
    values.iter().map(|value| value * value).sum::<f64>() / number(values.len())
}

fn place(combined: &Combined, sample: usize) -> f64 {
    combined.start_mm + number(sample) * combined.step_mm
}

/// δ (µm) and β (µrad): the least-squares line through what the three probes read beyond the bar.
fn carriage(
    combined: &Combined,
    sample: usize,
    touched_um: impl Fn(usize, usize) -> f64,
) -> (f64, f64) {
    let spacing = combined.spacing;
    let arms = [0, spacing.first, spacing.total()];
    let beyond =
        [0, 1, 2].map(|p| combined.mean_probes_um[p][sample] - touched_um(sample, arms[p]));
    let arms_mm = arms.map(|arm| number(arm) * combined.step_mm);
    let (centre_mm, mean_um) =
        (arms_mm.iter().sum::<f64>() / 3.0, beyond.iter().sum::<f64>() / 3.0);
    let (mut squares, mut products) = (0.0, 0.0);
    for (arm_mm, beyond_um) in arms_mm.iter().zip(beyond) {
        squares += (arm_mm - centre_mm) * (arm_mm - centre_mm);
        products += (arm_mm - centre_mm) * (beyond_um - mean_um);
    }
    let tilt_um_per_mm = products / squares;
    (mean_um - tilt_um_per_mm * centre_mm, tilt_um_per_mm * 1000.0)
}

/// Values at even places, their least-squares line removed.
pub(super) fn without_line(mut values: Vec<f64>) -> Vec<f64> {
    let mean = crate::number::mean(&values);
    let centre = number(values.len() - 1) / 2.0;
    let (mut squares, mut products) = (0.0, 0.0);
    for (index, value) in values.iter().enumerate() {
        let from_centre = number(index) - centre;
        squares += from_centre * from_centre;
        products += from_centre * value;
    }
    for (index, value) in values.iter_mut().enumerate() {
        *value -= mean + products / squares * (number(index) - centre);
    }
    values
}
