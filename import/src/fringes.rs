//! Raw fringes of an interferometer against commanded position or time: from intensity to error.
//!
//! One detector, two in quadrature, or one for each of two wavelengths. The phase of the fringes is
//! the travel, `d = φ·λ/4π` for a mirror that moves; the error is what the command is ahead by.
//! Every row carries its standard deviation, so that faded fringes weigh little, and none where they
//! are gone.
//!
//! - [`window`]: phase of one detector, with a standard deviation
//! - [`carrier`]: how many fringes there are in a unit of the coordinate
//! - [`quadrature`]: two detectors as one turning pointer
//! - [`unwrap`]: from phase to whole fringes, over stretches where they faded

mod carrier;
mod quadrature;
mod unwrap;
mod window;

use std::f64::consts::PI;

use helixlock_traces::Column;

use crate::decide::Decisions;
use crate::error::ImportError;
use crate::place::Place;
use crate::recipe::Value;
use unwrap::unwrapped;

/// The detector, one a quarter of a fringe later, and one for another wavelength.
pub(crate) const DETECTORS: [&str; 3] = ["fringe", "fringe_quadrature", "fringe_second"];
/// A commanded position in steps or counts, whose size may not be known.
pub(crate) const COUNT: &str = "position_count";

/// Phase at one place.
#[derive(Clone, Copy, Debug)]
struct Reading {
    /// Way along the command since the start of the run, in its unit.
    way: f64,
    /// Phase, rad, rising along the way.
    phase: f64,
    /// Its standard deviation, rad.
    deviation: f64,
}

/// A stretch in which the command goes one way.
struct Run {
    /// Commanded, in order of the file.
    command: Vec<f64>,
    /// Detectors, as many as there are.
    light: [Option<Vec<f64>>; 3],
    /// +1 or −1.
    sense: f64,
}

/// What a run comes to.
struct Measured {
    start: f64,
    sense: f64,
    rows: Vec<Travel>,
}

/// Travel at one place.
#[derive(Clone, Copy, Debug)]
struct Travel {
    /// Way along the command.
    way: f64,
    /// What the fringes counted.
    moved_um: f64,
    /// Its standard deviation.
    deviation_um: f64,
}

impl Travel {
    /// Weight in a mean.
    fn weight(&self) -> f64 {
        1.0 / (self.deviation_um * self.deviation_um).max(f64::MIN_POSITIVE)
    }
}

/// True when the columns hold fringes.
pub(crate) fn are_in(columns: &[Column]) -> bool {
    columns.iter().any(|column| column.name == DETECTORS[0])
}

/// The columns with the error in place of the fringes.
pub(crate) fn demodulated(
    columns: &[Column],
    decisions: &mut Decisions<'_>,
) -> Result<Vec<Column>, ImportError> {
    let of = |name: &str| columns.iter().find(|column| column.name == name);
    let file = decisions.file();
    let known = [COUNT, "position_mm", "time_s"].into_iter().find_map(of);
    let Some(command) = known else {
        let expected = format!("`{COUNT}`, `position_mm` or `time_s` beside `{}`", DETECTORS[0]);
        return Err(ImportError::found(Place::file(file), "fringes over nothing", expected));
    };
    let used = |name: &str| name == command.name || DETECTORS.contains(&name);
    for column in columns.iter().filter(|column| !used(&column.name)) {
        decisions.note(format!(
            "column `{}` is left out: a row of the table is a fringe, not a sample",
            column.name
        ));
    }
    let light = DETECTORS.map(|name| of(name).map(|column| column.values.as_slice()));
    let lambda_um = wavelength(decisions, "wavelength_um", "the wavelength of the light")?;
    let second_um = match light[2] {
        Some(_) => {
            Some(wavelength(decisions, "second_um", "the wavelength on the second detector")?)
        }
        None => None,
    };
    let runs = runs(&command.values, light);
    let mut measured = Vec::new();
    for run in &runs {
        measured.extend(run.measure(lambda_um, second_um, decisions));
    }
    if measured.is_empty() {
        let found = format!("no stretch of `{}` with fringes", command.name);
        let expected = format!("at least {} fringes on the way", window::FEWEST_FRINGES);
        return Err(ImportError::found(Place::file(file), found, expected));
    }
    let mm_a_unit = scale(&command.name, &measured, decisions);
    Ok(table(&measured, &command.name, mm_a_unit))
}

fn wavelength(decisions: &mut Decisions<'_>, name: &str, what: &str) -> Result<f64, ImportError> {
    let text = format!("{what} is not told, in micrometres");
    let lambda_um = decisions.number("fringes", name, &text, &["0.63299", "0.54607", "0.532"]);
    if (0.1..=20.0).contains(&lambda_um) {
        return Ok(lambda_um);
    }
    let found = format!("`{name} = {lambda_um}`");
    Err(ImportError::found(Place::file(decisions.file()), found, "0.1 to 20 micrometres"))
}

/// Stretches in which the command goes one way, without its pauses.
fn runs(command: &[f64], light: [Option<&[f64]>; 3]) -> Vec<Run> {
    let mut runs: Vec<Run> = Vec::new();
    let mut last: Option<f64> = None;
    for (row, &now) in command.iter().enumerate() {
        let whole = light.iter().flatten().all(|values| values[row].is_finite());
        if !now.is_finite() || !whole {
            continue;
        }
        let step = last.map_or(0.0, |last| now - last);
        last = Some(now);
        if step == 0.0 {
            continue;
        }
        let turned = runs.last().is_none_or(|run| run.sense * step < 0.0);
        if turned {
            let light = light.map(|values| values.map(|_| Vec::new()));
            runs.push(Run { command: Vec::new(), light, sense: step.signum() });
        }
        let Some(run) = runs.last_mut() else { continue };
        run.command.push(now);
        for (kept, values) in run.light.iter_mut().zip(light) {
            if let (Some(kept), Some(values)) = (kept, values) {
                kept.push(values[row]);
            }
        }
    }
    runs
}

impl Run {
    /// Travel along the run; `None` when there are too few fringes to tell.
    fn measure(
        &self,
        lambda_um: f64,
        second_um: Option<f64>,
        decisions: &mut Decisions<'_>,
    ) -> Option<Measured> {
        let start = *self.command.first()?;
        let way: Vec<f64> = self.command.iter().map(|at| self.sense * (at - start)).collect();
        let first = self.light[0].as_deref()?;
        let carrier = carrier::rad_a_unit(&way, first)?;
        let readings = match self.light[1].as_deref() {
            Some(second) => {
                let found = quadrature::readings(&way, first, second, carrier)?;
                decisions.note(format!(
                    "quadrature: the ellipses leave {:.1} % of their radius",
                    100.0 * found.left
                ));
                found.readings
            }
            None => window::readings(&way, first, carrier),
        };
        let unit_um = lambda_um / (4.0 * PI);
        let (mut rows, bridged) = unwrapped(&readings, carrier, unit_um);
        let mut said = bridged;
        if let (Some(second_um), Some(light)) = (second_um, self.light[2].as_deref()) {
            let carrier = carrier * lambda_um / second_um;
            let other = window::readings_at(&way, light, carrier, &readings);
            let (other, _) = unwrapped(&other, carrier, second_um / (4.0 * PI));
            said += unwrap::agreed(&mut rows, &other, [lambda_um, second_um]);
        }
        if 0 < said {
            decisions.note(format!("fringes faded and were bridged in {said} places"));
        }
        let faded = readings.len() - rows.len();
        if 0 < faded {
            decisions.note(format!("{faded} of {} fringes are too faint to read", readings.len()));
        }
        (2 < rows.len()).then_some(Measured { start, sense: self.sense, rows })
    }
}

/// Size of a unit of the command, mm: told, or the mean rate of the fringes themselves.
fn scale(command: &str, measured: &[Measured], decisions: &mut Decisions<'_>) -> f64 {
    if command == "position_mm" {
        return 1.0;
    }
    if let Some(Value::Number(size)) = decisions.given("fringes", "mm_a_unit") {
        return *size;
    }
    let (mut products, mut squares) = (0.0, 0.0);
    for run in measured {
        let total: f64 = run.rows.iter().map(Travel::weight).sum();
        let mean = |pick: fn(&Travel) -> f64| {
            run.rows.iter().map(|row| row.weight() * pick(row)).sum::<f64>() / total
        };
        let (way, travel_um) = (mean(|row| row.way), mean(|row| row.moved_um));
        for row in &run.rows {
            let off = row.way - way;
            products += row.weight() * off * (row.moved_um - travel_um);
            squares += row.weight() * off * off;
        }
    }
    let size = products / squares / 1000.0;
    let reason =
        "the mean rate of the fringes, so that no slope is left: the size of a unit is not told";
    decisions.made.set("fringes", "mm_a_unit", Value::Number(size), reason);
    size
}

fn table(measured: &[Measured], command: &str, mm_a_unit: f64) -> Vec<Column> {
    let names = ["position_mm", "error_um", "error_um_sd", "pass", "direction"];
    let mut columns = names.map(|name| Column { name: name.into(), values: Vec::new() });
    let mut times = Column { name: "time_s".into(), values: Vec::new() };
    for (pass, run) in (1_u32..).zip(measured) {
        let ahead_um = |row: &Travel| 1000.0 * mm_a_unit * row.way - row.moved_um;
        let zero_um = run.rows.first().map_or(0.0, ahead_um);
        for row in &run.rows {
            let at = run.start + run.sense * row.way;
            let values = [
                mm_a_unit * at,
                run.sense * (ahead_um(row) - zero_um),
                row.deviation_um,
                f64::from(pass),
                run.sense,
            ];
            for (column, value) in columns.iter_mut().zip(values) {
                column.values.push(value);
            }
            times.values.push(at);
        }
    }
    let mut columns = Vec::from(columns);
    if command == "time_s" {
        columns.insert(0, times);
    }
    columns
}
