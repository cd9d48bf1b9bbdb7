//! Columns that are what was measured: the error was worked out of them, alone or with the position.

use helixlock_plant::prediction::Sensor;
use helixlock_plant::{COVARIATES, Column};

use super::{Measurement, spacing};
use crate::numerics::least_squares::{dot, fit, left};
use crate::numerics::{count, mean};
use crate::policy::extent::SEARCHED_ROWS;
use crate::policy::reading::{
    FINE_ROUNDING, MOST_OF_ROUNDING, SAME_READING, SHARE_OF_ROUNDING, SHARE_OF_TRAVEL,
};

/// How many of a column make a millimetre, or a turn, by the end of its name.
const OF_A_MILLIMETRE: [(&str, f64); 4] =
    [("_mm", 1.0), ("_um", 1000.0), ("_m", 0.001), ("_in", 1.0 / 25.4)];
const OF_A_TURN: [(&str, f64); 4] =
    [("_rev", 1.0), ("_deg", 360.0), ("_rad", std::f64::consts::TAU), ("_arcsec", ARCSEC_A_TURN)];

pub(crate) const ARCSEC_A_TURN: f64 = 1_296_000.0;
pub(crate) const UM_A_MM: f64 = 1000.0;

/// What a column is that the error, or the position, was read from.
const READING: &str = "the error in other units";
const POSITION: &str = "the position as it was measured";

impl Measurement {
    /// The same with a note on each column that is what was measured.
    pub(super) fn with_measurands_told(mut self) -> Self {
        let Some(error) = self.observations.get(&Sensor::Recorder) else { return self };
        let position = if self.rotary { &self.angle_rev } else { &self.position_mm };
        let measurand = Measurand { rotary: self.rotary, position, error, pass: &self.pass };
        // A sensor that the catalogue knows is what it is called, however closely an error follows it.
        let unknown =
            self.covariates.iter().filter(|(name, _)| !COVARIATES.contains(&name.as_str()));
        let mut told = Vec::new();
        for (name, values) in unknown {
            if measurand.is_reading(values) {
                told.push((name.clone(), READING));
            } else if measurand.is_position(name, values) {
                told.push((name.clone(), POSITION));
            }
        }
        for (name, what) in told {
            self.notes.push(format!("column `{name}` is {what}: not asked as a cause"));
            self.measurands.push(name);
        }
        self
    }

    /// Logged columns that may be causes, by name.
    pub(crate) fn causes(&self) -> impl Iterator<Item = (&String, &Column)> {
        self.covariates.iter().filter(|(name, _)| self.is_cause(name))
    }

    /// True for the name of a logged column that may be a cause.
    pub(crate) fn is_cause(&self, name: &str) -> bool {
        self.covariates.contains_key(name) && !self.measurands.iter().any(|own| own == name)
    }
}

/// What was measured, and where: `position` in mm or turns, `error` in µm or arcsec.
struct Measurand<'a> {
    rotary: bool,
    position: &'a [f64],
    error: &'a [f64],
    pass: &'a [usize],
}

impl Measurand<'_> {
    /// True for a column that gives the error by a straight line, each pass from a zero of its own, so closely as
    /// no cause does beside a sensor's noise: to the last digit, or to what rounding of the error leaves. As many
    /// rows as a search looks at, evenly picked, tell.
    fn is_reading(&self, column: &[f64]) -> bool {
        let mut known = self.known(column);
        let step = known.len().div_ceil(SEARCHED_ROWS).max(1);
        known = known.into_iter().step_by(step).collect();
        let digit = |values: &[f64]| {
            spacing(&known.iter().map(|&row| values[row]).collect::<Vec<_>>()).unwrap_or(0.0)
        };
        let digits = [digit(column), digit(self.error)];
        let [column, error] =
            [column, self.error].map(|values| about_means(values, &known, self.pass));
        let whole = dot(&error, &error);
        if whole <= 0.0 || dot(&column, &column) <= 0.0 {
            return false;
        }
        let size = dot(&column, &error) / dot(&column, &column);
        let off = left(&[&column], &error, &[size]);
        let variance = (size * digits[0]).powi(2) + digits[1].powi(2);
        let rounding = MOST_OF_ROUNDING * (variance / 12.0 * count(known.len()) / whole).sqrt();
        let share =
            if rounding < FINE_ROUNDING { rounding.max(SAME_READING) } else { SAME_READING };
        is_share(share, &off, &error)
    }

    /// Rows of which the error and a column are known.
    fn known(&self, column: &[f64]) -> Vec<usize> {
        let rows = 0..self.pass.len();
        rows.filter(|&row| column[row].is_finite() && self.error[row].is_finite()).collect()
    }

    /// True for a column that is the position, as another gauge or the one that the error is of has measured
    /// it, each pass from a zero of its own.
    ///
    /// Either it is that in a unit of length, or angle, to within what a machine may be off; or so much of it
    /// as makes a micrometre of position makes one of error. A cause may follow the position or the error, and
    /// the one by accident as closely as it will, but not both by the same number.
    fn is_position(&self, name: &str, column: &[f64]) -> bool {
        let known = self.known(column);
        let [column, position, error] = [column, self.position, self.error]
            .map(|values| about_means(values, &known, self.pass));
        if dot(&position, &position) <= 0.0 {
            return false;
        }
        let scale = dot(&column, &position) / dot(&position, &position);
        let rest = left(&[&position], &column, &[scale]);
        let units = if self.rotary { OF_A_TURN } else { OF_A_MILLIMETRE };
        let is_unit = |(end, unit): (&str, f64)| {
            name.ends_with(end) && (scale.abs() - unit).abs() <= SHARE_OF_TRAVEL * unit
        };
        if units.into_iter().any(is_unit) && is_share(SHARE_OF_TRAVEL, &rest, &column) {
            return true;
        }
        // Of the rest, for the column itself and the position would be one to a fit.
        let both = [position.as_slice(), rest.as_slice()];
        let sizes = fit(&both, &error).coefficients;
        let off = left(&both, &error, &sizes);
        let unit = if self.rotary { ARCSEC_A_TURN } else { UM_A_MM };
        let of_position = (sizes[0] - sizes[1] * scale).abs() / unit;
        (of_position - 1.0).abs() <= SHARE_OF_ROUNDING && is_share(SHARE_OF_ROUNDING, &off, &error)
    }
}

/// True for a part that is at most a share of a whole.
fn is_share(share: f64, part: &[f64], whole: &[f64]) -> bool {
    dot(part, part) <= share * share * dot(whole, whole)
}

/// Values of some rows, each about the mean of its pass.
fn about_means(values: &[f64], rows: &[usize], pass: &[usize]) -> Vec<f64> {
    let of_pass = |rows: &[usize]| -> Vec<f64> {
        let own: Vec<f64> = rows.iter().map(|&row| values[row]).collect();
        let mean = mean(&own);
        own.iter().map(|value| value - mean).collect()
    };
    rows.chunk_by(|&a, &b| pass[a] == pass[b]).flat_map(of_pass).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Places 10 mm apart, what is found there in µm, and the pass; two passes of 20.
    fn visits() -> (Vec<f64>, Vec<f64>, Vec<usize>) {
        let row = |row: u32| (10.0 * f64::from(row % 20), 1.7 * libm::sin(f64::from(row * row)));
        let (place, error) = (0..40).map(row).unzip();
        (place, error, (0..40).map(|row| row / 20).collect())
    }

    fn is_measured(name: &str, column: impl Fn(f64, f64) -> f64) -> bool {
        let (position, error, pass) = visits();
        let column: Vec<f64> = position.iter().zip(&error).map(|(x, e)| column(*x, *e)).collect();
        let one = Measurand { rotary: false, position: &position, error: &error, pass: &pass };
        one.is_reading(&column) || one.is_position(name, &column)
    }

    /// As a laser's reading beside the target, of five digits, in inches, and in counts of the other sign.
    #[test]
    fn the_reading_that_an_error_was_worked_out_of_is_no_cause() {
        let rounded = |mm: f64| (1e5 * mm).round() * 1e-5;
        assert!(is_measured("reference_mm", |place, error| rounded(place - 1e-3 * error)));
        assert!(is_measured("laser", |place, error| (place - 1e-3 * error) / 25.4));
        assert!(is_measured("counts", |place, error| 7.0 - 8192.0 * (place + 1e-3 * error)));
    }

    /// As a motor's encoder that does not see what a screw adds.
    #[test]
    fn the_position_by_another_gauge_is_no_cause() {
        assert!(is_measured("motor_mm", |place, error| 3.0 + place - 1e-3 * libm::cos(error)));
        assert!(!is_measured("pull_n", |place, error| place - 1e-3 * libm::cos(error)), "a cable");
    }

    /// A reading in pixels, whatever it is called, in a pass of another zero, and rounded to a hundredth of what
    /// it shows.
    #[test]
    fn what_gives_the_error_by_itself_to_its_last_digits_is_no_cause() {
        assert!(is_measured("x_pixel", |_, error| 1278.0 + error / 3.0864));
        assert!(is_measured("count", |_, error| (1e4 * error).round()));
    }

    /// A temperature that the error follows to a hundredth, one that it follows beside the place, and one that
    /// grows with the place alone.
    #[test]
    fn what_goes_along_with_an_error_may_be_its_cause() {
        assert!(!is_measured("load", |place, error| 20.0 + 0.3 * error + 0.005 * libm::sin(place)));
        assert!(!is_measured("load", |place, error| 20.0 + 0.01 * place + 0.3 * error));
        assert!(!is_measured("load", |place, _| 20.0 + 0.01 * place));
    }
}
