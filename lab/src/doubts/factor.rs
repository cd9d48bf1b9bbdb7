//! Wrong sign or unit of a sensor's column, or of one pass of it.
//!
//! With noise of any size a column times k is as likely as the prediction divided by k; of one pass that is so
//! only if its noise too was divided.

use helixlock_plant::prediction::Sensor;
use helixlock_plant::{LoggedColumn, Part};

use super::column::others;
use super::common::{curves, slopes};
use super::doubt::{of_pass_read, recipe};
use super::hypothesis::Hypothesis;
use super::law::size_of_error;
use super::view::View;
use crate::measurement::sensor_column;
use crate::model::{Columns, Problem, Stage};
use crate::noise::Noise;
use crate::numerics::count;
use crate::policy::mistakes::MACHINE_OF_EFFECTS;
use crate::policy::size::WORTHWHILE_UM;

/// Every sign and unit that a sensor's column may have been written with, all of it or the odd pass.
pub(super) fn factors(
    problem: &Problem,
    odd: Option<usize>,
    noises: &[Vec<Noise>],
) -> Vec<Hypothesis> {
    if !predicts_a_shape(problem) {
        return Vec::new();
    }
    let mut all = Vec::new();
    for (index, &sensor) in problem.sensors.iter().enumerate() {
        let column = sensor_column(sensor, problem.measurement.rotary);
        let Some(known) = LoggedColumn::named(column) else { continue };
        let factors = factors_of(problem, sensor, known);
        all.extend(odd.iter().flat_map(|pass| {
            factors.iter().filter_map(|one| one.of_pass(problem, index, column, *pass))
        }));
        all.extend(factors.into_iter().map(|one| one.of_column(problem, index, column)));
        let odd_ones = odd_factors(problem, index, known, noises).into_iter();
        all.extend(
            odd_ones
                .map(|one| Hypothesis { numbers: 1.0, ..one.of_column(problem, index, column) }),
        );
    }
    all
}

/// What a column may have to be multiplied by.
struct Factor {
    by: f64,
    what: &'static str,
    /// What is said of a column of some name, behind that name.
    says: String,
    /// How a recipe reads it then.
    how: String,
}

fn factors_of(problem: &Problem, sensor: Sensor, column: &'static LoggedColumn) -> Vec<Factor> {
    let says = "has the opposite sign of what the file predicts".to_owned();
    let mut all = vec![Factor { by: -1.0, what: "sign", says, how: "sign = -1".to_owned() }];
    if sensor == Sensor::Counter {
        return all;
    }
    if MACHINE_OF_EFFECTS <= problem.model.effects.len() {
        all.extend(slips(column));
    }
    let written = column.units[0].0;
    for (unit, factor, _) in others(column) {
        for (sign, turned) in [(1.0, ""), (-1.0, ", with the opposite sign")] {
            let says = format!("is in {unit}, not in {written}: factor {factor}{turned}");
            let unit = format!("unit = \"{unit}\"");
            let how = if sign < 0.0 { format!("{unit}\nsign = -1") } else { unit };
            all.push(Factor { by: sign * factor, what: "unit", says, how });
        }
    }
    all.extend(fringes(problem, column));
    all
}

/// A decimal point that slipped, a diameter for a radius, a beam that went there and back twice. One effect
/// alone may have grown by so much.
fn slips(column: &LoggedColumn) -> [Factor; 4] {
    let written = column.units[0].0;
    let tens = |factor: f64| format!("is written in units of {factor} {written}");
    let all = [
        (10.0, tens(10.0)),
        (0.1, tens(0.1)),
        (2.0, "is half of what the file predicts: radii for diameters?".to_owned()),
        (0.5, "is twice what the file predicts: diameters for radii?".to_owned()),
    ];
    all.map(|(by, says)| Factor {
        by,
        what: "unit",
        says,
        how: format!("unit = \"{by} {written}\""),
    })
}

/// The factor of no unit that brings what the file predicts nearest to the data, under each noise. One effect
/// alone may have another size.
fn odd_factors(
    problem: &Problem,
    sensor: usize,
    column: &'static LoggedColumn,
    noises: &[Vec<Noise>],
) -> Vec<Factor> {
    if problem.model.effects.len() < MACHINE_OF_EFFECTS {
        return Vec::new();
    }
    let predicted = problem.of_rows(sensor, |row| problem.predicted[row]);
    let factor = |noises: &[Noise]| {
        let stage = Stage::new(problem, &slopes(problem), noises);
        let more = stage.gain(&Columns::free(vec![predicted.clone()])).fit.coefficients[0];
        let times = 1.0 + more;
        let says = format!(
            "is {times:.4} times what the file predicts: its scale, or all effects have changed alike"
        );
        let by = times.recip();
        let how = format!("unit = \"{by:.6} {}\"", column.units[0].0);
        by.is_finite().then_some(Factor { by, what: "unit", says, how })
    };
    noises.iter().filter_map(|noises| factor(noises)).collect()
}

/// A count of fringes that nobody made a length of, of a mirror that is passed once or twice.
fn fringes(problem: &Problem, column: &LoggedColumn) -> Vec<Factor> {
    if problem.measurement.rotary || problem.model.lacks(&[Part::Laser]).is_some() {
        return Vec::new();
    }
    let fringe = |parts: f64| {
        let by = problem.model.laser.wavelength_um / parts;
        let says = format!("is in fringes of λ/{parts}: factor {by:.5}");
        let how = format!("unit = \"{by:.7} {}\"", column.units[0].0);
        Factor { by, what: "unit", says, how }
    };
    vec![fringe(2.0), fringe(4.0)]
}

/// True when more than slopes and drifts is predicted: what is less than a sensor shows would,
/// times a million, be as large as anything.
fn predicts_a_shape(problem: &Problem) -> bool {
    let noises = vec![Noise::white(); problem.sensors.len()];
    let view = View::new(problem, &slopes(problem).and(&curves(problem)), &noises);
    let size_um = (view.square(problem.predicted.to_vec()) / count(problem.samples.len())).sqrt();
    WORTHWHILE_UM < size_um
}

impl Factor {
    /// The mistake in all of a sensor's column.
    fn of_column(self, problem: &Problem, sensor: usize, column: &str) -> Hypothesis {
        let mut mended = problem.clone();
        for block in problem.layout.blocks.iter().filter(|block| block.sensor == sensor) {
            mended.predicted[block.rows.clone()].iter_mut().for_each(|value| *value /= self.by);
        }
        let values = &problem.measurement.observations[&problem.sensors[sensor]];
        let usual = size_of_error(values, self.by.abs()) - size_of_error(values, 1.0);
        let words = (self.what, format!("`{column}` {}", self.says), recipe(column, &self.how));
        Hypothesis { scales: true, usual, ..Hypothesis::new(words, mended) }
    }

    /// The mistake in one pass.
    fn of_pass(
        &self,
        problem: &Problem,
        sensor: usize,
        column: &str,
        pass: usize,
    ) -> Option<Hypothesis> {
        let mut mended = problem.measurement.clone();
        let values = mended.observations.get_mut(&problem.sensors[sensor])?;
        let rows = values.iter_mut().zip(&problem.record.pass).filter(|(_, of)| **of == pass);
        rows.for_each(|(value, _)| *value *= self.by);
        let name = problem.measurement.pass_names[pass];
        let says = format!("`{column}` of pass {name} {}", self.says);
        let words = (self.what, says, of_pass_read(column, name, &self.how));
        let blocks = problem.layout.blocks.iter();
        let own = blocks.filter(|block| block.sensor == sensor && block.pass == pass);
        let rows = own.map(|block| block.rows.len()).sum();
        let rescaled = 2.0 * count(rows) * libm::log(self.by.abs());
        let one = Hypothesis::of_measurement(problem, &mended, words)?;
        Some(Hypothesis { rescaled, pass: Some(pass), ..one })
    }
}
