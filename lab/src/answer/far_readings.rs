//! Readings that lie far from the rest: how many there are, where the first is, and what is left without them.

use helixlock_plant::prediction::Sensor;

use crate::model::Problem;
use crate::noise::departures;
use crate::numerics::count;
use crate::policy::reading::OUTLIER_NEIGHBOURS;

/// Readings that lie so far from their neighbours that they weigh little.
#[derive(Debug, Clone, PartialEq)]
pub struct FarReadings {
    /// How many they are.
    pub readings: usize,
    /// Of so many.
    pub of: usize,
    /// Root mean square of what a model leaves without them, about the zero of each pass, µm (arcsec).
    pub rest_um: f64,
    /// The first of them.
    pub first: FarReading,
}

/// One of them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FarReading {
    /// Whose reading it is.
    pub sensor: Sensor,
    /// Name of its pass in the file.
    pub pass: f64,
    /// When it was read, from the first sample on, s.
    pub time_s: f64,
    /// Where it was read, mm.
    pub position_mm: f64,
    /// The same as turns of the spindle.
    pub angle_rev: f64,
    /// How far it lies from its neighbours, µm (arcsec).
    pub off_um: f64,
}

/// Those of what a model leaves; `None` without any.
#[must_use]
pub(crate) fn far_readings(problem: &Problem, left: &[f64]) -> Option<FarReadings> {
    let far = problem.far_rows();
    let first = of_row(problem, left, *far.first()?)?;
    let (readings, of) = (far.len(), problem.samples.len());
    Some(FarReadings { readings, of, rest_um: rms_without(problem, left, &far), first })
}

fn of_row(problem: &Problem, left: &[f64], row: usize) -> Option<FarReading> {
    let block = problem.layout.blocks.iter().find(|block| block.rows.contains(&row))?;
    let from = row.saturating_sub(OUTLIER_NEIGHBOURS).max(block.rows.start);
    let to = (row + OUTLIER_NEIGHBOURS + 1).min(block.rows.end);
    let sample = problem.samples[row];
    Some(FarReading {
        sensor: problem.sensors[block.sensor],
        pass: problem.measurement.pass_names[block.pass],
        time_s: problem.measurement.time_s[sample],
        position_mm: problem.measurement.position_mm[sample],
        angle_rev: problem.measurement.angle_rev[sample],
        off_um: departures(&left[from..to])[row - from],
    })
}

/// Root mean square about the mean of each pass, without some rows in order.
fn rms_without(problem: &Problem, left: &[f64], far: &[usize]) -> f64 {
    let (mut square, mut number) = (0.0, 0.0);
    for block in &problem.layout.blocks {
        let is_near = |row: &usize| far.binary_search(row).is_err();
        let rest = || block.rows.clone().filter(is_near).map(|row| left[row]);
        let rows = count(rest().count());
        let mean = rest().sum::<f64>() / rows;
        square += rest().map(|value| (value - mean) * (value - mean)).sum::<f64>();
        number += rows;
    }
    (square / f64::max(number, 1.0)).sqrt()
}
