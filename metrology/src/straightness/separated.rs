//! What separation gives: the bar, the carriage, and their uncertainty.

use super::readings::Combined;
use crate::chance::beyond_chance;
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
    /// Covariance of h at the places, if nothing is assumed wrongly, µm².
    pub covariance_um2: Option<Vec<Vec<f64>>>,
    /// Probability that something is, and what is found then.
    pub otherwise: Option<Box<(f64, Self)>>,
}

impl Separated {
    /// The same with the difference from another method in the uncertainty.
    ///
    /// Either this method assumes nothing wrongly, such as that the bar repeats with the stroke, and
    /// its variance is true; or the other method alone is right, and the variance is that one's and
    /// the mean square difference. Both count as probable as the difference makes them (Bayesian
    /// model averaging): noise alone makes the difference of their variances. The uncertainty is half
    /// of what holds 95.45 % of both. The parabola does not
    /// count there: zeros that drift move that of one method and not the other's.
    #[must_use]
    pub fn with_difference_from(mut self, other: &Self) -> Self {
        let wrong = self.probably_wrong(other);
        let difference_um2 = self.mean_square_difference_um2(other);
        for (place, u_um) in self.uncertainty_um.iter_mut().flatten().enumerate() {
            let other_um = other.uncertainty_um.as_ref().map_or(0.0, |each| each[place]);
            *u_um = of_either([*u_um, (other_um * other_um + difference_um2).sqrt()], wrong);
        }
        self.otherwise = Some(Box::new((wrong, other.clone())));
        self
    }

    /// Probability that this method assumes something wrongly, and the other one alone is right.
    fn probably_wrong(&self, other: &Self) -> f64 {
        let (Some(mine_um2), Some(other_um2)) = (&self.covariance_um2, &other.covariance_um2)
        else {
            let variance = |each: &Option<Vec<f64>>| each.as_deref().map_or(0.0, mean_square);
            let apart_um2 = variance(&other.uncertainty_um) - variance(&self.uncertainty_um);
            let ratio = self.mean_square_difference_um2(other) / apart_um2.abs();
            return beyond_chance(ratio, 1.0, self.size_um2() / apart_um2.abs());
        };
        let places = self.workpiece_um.len();
        let parabola = unit_parabola(places);
        let (mine_um2, other_um2) = (without(mine_um2, &parabola), without(other_um2, &parabola));
        let apart: Vec<f64> =
            self.workpiece_um.iter().zip(&other.workpiece_um).map(|(a, b)| a - b).collect();
        let along: f64 = apart.iter().zip(&parabola).map(|(um, unit)| um * unit).sum();
        let difference_um2 = mean_square(&apart) - along * along / number(places);
        let variance = |rows: &[Vec<f64>]| trace(rows) / number(places);
        let (of_self, of_other) = (variance(&mine_um2), variance(&other_um2));
        let wider = if of_self < of_other { &other_um2 } else { &mine_um2 };
        let chance_um2 = (of_other - of_self).abs();
        let freedom = independent_places(wider);
        // A bar that does not repeat does not by as much as itself.
        beyond_chance(difference_um2 / chance_um2, freedom, self.size_um2() / chance_um2)
    }

    /// Mean square of the bar, µm².
    fn size_um2(&self) -> f64 {
        mean_square(&self.workpiece_um)
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
            otherwise: None,
        }
    }
}

/// Standard uncertainty of what is normal with one standard deviation, or as probably as told with the
/// other: half of what holds 95.45 % of it.
fn of_either([one_um, other_um]: [f64; 2], other_probably: f64) -> f64 {
    let beyond = |um: f64, standard_um: f64| libm::erfc(2.0 * um / standard_um / 2.0_f64.sqrt());
    let (mut low, mut high) = (one_um.min(other_um), one_um.max(other_um));
    for _ in 0..HALVINGS {
        let um = f64::midpoint(low, high);
        let all =
            (1.0 - other_probably) * beyond(um, one_um) + other_probably * beyond(um, other_um);
        // Two standard deviations of a normal number.
        if libm::erfc(2.0_f64.sqrt()) < all { low = um } else { high = um }
    }
    high
}

/// Halvings of an uncertainty: to a millionth of it.
const HALVINGS: usize = 20;

/// A parabola over even places without its line, its squares one.
fn unit_parabola(places: usize) -> Vec<f64> {
    let parabola = without_line((0..places).map(|place| number(place).powi(2)).collect());
    let length = parabola.iter().map(|value| value * value).sum::<f64>().sqrt();
    parabola.iter().map(|value| value / length).collect()
}

/// A covariance without what varies along a form whose squares are one: P·C·P.
fn without(covariance_um2: &[Vec<f64>], form: &[f64]) -> Vec<Vec<f64>> {
    let product = |row: &[f64]| row.iter().zip(form).map(|(value, unit)| value * unit).sum::<f64>();
    let along: Vec<f64> = covariance_um2.iter().map(|row| product(row)).collect();
    let twice = product(&along);
    let row = |(place, row): (usize, &Vec<f64>)| -> Vec<f64> {
        let each = row.iter().enumerate();
        each.map(|(at, value)| {
            value - form[place] * along[at] - form[at] * along[place]
                + twice * form[place] * form[at]
        })
        .collect()
    };
    covariance_um2.iter().enumerate().map(row).collect()
}

fn trace(covariance_um2: &[Vec<f64>]) -> f64 {
    covariance_um2.iter().enumerate().map(|(place, row)| row[place]).sum()
}

/// Degrees of freedom of a mean square over places that vary together: (tr C)²/tr C² (Satterthwaite,
/// Biometrics Bulletin 2, 1946, 110).
fn independent_places(covariance_um2: &[Vec<f64>]) -> f64 {
    let trace = trace(covariance_um2);
    let squares: f64 = covariance_um2.iter().flatten().map(|value| value * value).sum();
    trace * trace / squares
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

    #[test]
    fn what_is_one_or_the_other_is_between_them() {
        assert!((of_either([1.0, 1.0], 0.3) - 1.0).abs() < 1e-5);
        assert!((of_either([1.0, 5.0], 1.0) - 5.0).abs() < 1e-5);
        // 1 % of what is much wider: 95.45 of 99 % of the narrower, 2.099 of its standard deviations.
        assert!((of_either([1.0, 1000.0], 0.01) - 2.099 / 2.0).abs() < 2e-3);
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
