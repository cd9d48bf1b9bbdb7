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
    /// Either this method assumes nothing wrongly, such as that the bar repeats with the stroke, and
    /// its variance is true; or the other method alone is right, and the variance is that one's and
    /// the mean square difference. Both count as probable as the difference makes them (Bayesian
    /// model averaging): noise alone makes the difference of their variances.
    #[must_use]
    pub fn with_difference_from(mut self, other: &Self) -> Self {
        let difference_um2 = self.mean_square_difference_um2(other);
        let variance = |each: &Option<Vec<f64>>| each.as_deref().map_or(0.0, mean_square);
        let (of_other, of_self) = (variance(&other.uncertainty_um), variance(&self.uncertainty_um));
        let wider = if of_self < of_other { other } else { &self };
        let freedom = wider.covariance_um2.as_deref().map_or(1.0, independent_places);
        let wrong = beyond_chance(difference_um2 / (of_other - of_self).abs(), freedom);
        let mixed = |mine_um2: f64, other_um2: f64| mine_um2 + wrong * (other_um2 - mine_um2);
        for (place, u_um) in self.uncertainty_um.iter_mut().flatten().enumerate() {
            let other_um = other.uncertainty_um.as_ref().map_or(0.0, |each| each[place]);
            *u_um = mixed(*u_um * *u_um, other_um * other_um + difference_um2).sqrt();
        }
        for (place, row) in self.covariance_um2.iter_mut().flatten().enumerate() {
            for (at, value) in row.iter_mut().enumerate() {
                let other_um2 = other.covariance_um2.as_ref().map_or(0.0, |rows| rows[place][at]);
                let apart_um2 = if at == place { difference_um2 } else { 0.0 };
                *value = mixed(*value, other_um2 + apart_um2);
            }
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

/// Degrees of freedom of a mean square over places that vary together: (tr C)²/tr C² (Satterthwaite,
/// Biometrics Bulletin 2, 1946, 110).
fn independent_places(covariance_um2: &[Vec<f64>]) -> f64 {
    let trace: f64 = covariance_um2.iter().enumerate().map(|(place, row)| row[place]).sum();
    let squares: f64 = covariance_um2.iter().flatten().map(|value| value * value).sum();
    trace * trace / squares
}

/// Probability that a mean square of so many degrees of freedom, in units of what chance makes, has
/// more in it, when as many records have as have not.
///
/// The most probable variance is the mean square itself, and no less than that of chance; what that
/// one value gains in twice the log likelihood of normal numbers, less its price ln ν (Schwarz, Annals
/// of Statistics 6, 1978, 461).
fn beyond_chance(ratio: f64, freedom: f64) -> f64 {
    if ratio.is_infinite() {
        return 1.0;
    }
    let ratio = ratio.max(1.0);
    let gain = freedom * (ratio - 1.0 - libm::log(ratio)) - libm::log(freedom.max(1.0));
    1.0 / (1.0 + libm::exp(-gain / 2.0))
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

#[cfg(test)]
mod tests {
    use super::*;

    /// What chance makes is improbable to be more, ten times as much is not; of one degree of freedom
    /// nothing can be told before it.
    #[test]
    fn a_difference_counts_by_how_far_it_is_beyond_chance() {
        assert!((beyond_chance(0.2, 1.0) - 0.5).abs() < 1e-12);
        assert!((beyond_chance(1.0, 9.0) - 0.25).abs() < 1e-12);
        assert!(0.999 < beyond_chance(10.0, 9.0));
        assert!((beyond_chance(f64::INFINITY, 9.0) - 1.0).abs() < 1e-12);
    }

    /// Nine places that vary alike are one, nine that vary on their own are nine.
    #[test]
    fn places_that_vary_together_count_once() {
        let alike = vec![vec![2.0; 9]; 9];
        let own = (0..9).map(|k| (0..9).map(|j| if j == k { 2.0 } else { 0.0 }).collect());
        assert!((independent_places(&alike) - 1.0).abs() < 1e-12);
        assert!((independent_places(&own.collect::<Vec<Vec<f64>>>()) - 9.0).abs() < 1e-12);
    }
}
