//! A position where the error should be: what runs along with the travel is no error.

use super::doubt::{Doubt, recipe};
use crate::measurement::sensor_column;
use crate::model::Problem;
use crate::numerics::count;
use crate::policy::mistakes::{RUNS_ALONG, RUNS_ALONG_SHARE};

/// The doubt, where an error moves as a tenth of the travel does, and the file does not say so.
pub(super) fn runs_along(problem: &Problem) -> Option<Doubt> {
    let left = problem.residual();
    (0..problem.sensors.len()).find_map(|sensor| {
        let (share, evidence) = along(problem, sensor, &left)?;
        along(problem, sensor, &problem.observed)?;
        Some(said(
            sensor_column(problem.sensors[sensor], problem.measurement.rotary),
            share,
            evidence,
        ))
    })
}

/// Share of the travel in values, and its evidence; every pass has a zero of its own.
fn along(problem: &Problem, sensor: usize, values: &[f64]) -> Option<(f64, f64)> {
    let (mut xx, mut xy, mut yy, mut rows) = (0.0, 0.0, 0.0, 0);
    let travel = |row: usize| {
        let sample = problem.samples[row];
        if problem.measurement.rotary {
            1_296_000.0 * problem.measurement.angle_rev[sample]
        } else {
            1000.0 * problem.record.position_mm[sample]
        }
    };
    for block in problem.layout.blocks.iter().filter(|block| block.sensor == sensor) {
        let mean = |of: &dyn Fn(usize) -> f64| {
            block.rows.clone().map(of).sum::<f64>() / count(block.rows.len())
        };
        let (x0, y0) = (mean(&travel), mean(&|row| values[row]));
        for row in block.rows.clone() {
            let (x, y) = (travel(row) - x0, values[row] - y0);
            (xx, xy, yy) = (xx + x * x, xy + x * y, yy + y * y);
            rows += 1;
        }
    }
    let (share, explained) = (xy / xx, xy * xy / (xx * yy));
    let found = RUNS_ALONG <= share.abs() && RUNS_ALONG_SHARE <= explained;
    let left = (1.0 - explained).max(f64::EPSILON);
    found.then(|| (share, -count(rows) * libm::log(left)))
}

fn said(column: &'static str, share: f64, evidence: f64) -> Doubt {
    // Another unit or ratio is hardly ever so near.
    let near = |whole: f64| (share.abs() - whole).abs() < 0.1 * RUNS_ALONG;
    let mend = if near(1.0) {
        recipe(column, "minus = \"the column of the position aimed at\"\nsign = -1")
    } else if near(2.0) {
        "turn one of the two positions, as they count in opposite directions: `sign = -1` for the position in the recipe that made the table".to_owned()
    } else {
        let times = (1.0 - share).abs();
        format!(
            "bring the two positions to one unit and one gear ratio: one moves {times:.4} times as far"
        )
    };
    let says =
        format!("`{column}` runs along with the travel, {share:.4} of it: is it a position?");
    Doubt { what: "position-for-error", evidence, says, mend }
}
