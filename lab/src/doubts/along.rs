//! A position where the error should be: what runs along with the travel is no error.

use super::doubt::{Doubt, recipe};
use crate::measurement::{ARCSEC_A_TURN, UM_A_MM, sensor_column};
use crate::model::Problem;
use crate::numerics::count;
use crate::policy::mistakes::{RUNS_ALONG, RUNS_ALONG_SHARE};

/// The line over the travel that is nearest to values of a sensor, where every pass has a zero of its own.
pub(super) struct Line {
    /// Share of the travel in the values.
    pub(super) share: f64,
    /// Share of the values' square that the line explains.
    pub(super) explained: f64,
    rows: usize,
}

/// The doubt, where an error moves as a tenth of the travel does, and the file does not say so.
pub(super) fn runs_along(problem: &Problem) -> Option<Doubt> {
    let left = problem.residual();
    (0..problem.sensors.len()).find_map(|sensor| {
        let line = Line::of(problem, sensor, &left).filter(Line::runs_along)?;
        Line::of(problem, sensor, &problem.observed).filter(Line::runs_along)?;
        Some(said(sensor_column(problem.sensors[sensor], problem.measurement.rotary), &line))
    })
}

impl Line {
    /// That of a sensor's rows, of a square that they have.
    pub(super) fn of(problem: &Problem, sensor: usize, values: &[f64]) -> Option<Self> {
        let (mut xx, mut xy, mut yy, mut rows) = (0.0, 0.0, 0.0, 0);
        for block in problem.layout.blocks.iter().filter(|block| block.sensor == sensor) {
            let mean = |of: &dyn Fn(usize) -> f64| {
                block.rows.clone().map(of).sum::<f64>() / count(block.rows.len())
            };
            let (x0, y0) = (mean(&|row| travel(problem, row)), mean(&|row| values[row]));
            for row in block.rows.clone() {
                let (x, y) = (travel(problem, row) - x0, values[row] - y0);
                (xx, xy, yy) = (xx + x * x, xy + x * y, yy + y * y);
                rows += 1;
            }
        }
        let line = Self { share: xy / xx, explained: xy * xy / (xx * yy), rows };
        line.explained.is_finite().then_some(line)
    }

    fn runs_along(&self) -> bool {
        RUNS_ALONG <= self.share.abs() && RUNS_ALONG_SHARE <= self.explained
    }

    /// Twice the logarithm by which values are likelier to be the line and what it leaves than to be noise.
    pub(super) fn evidence(&self) -> f64 {
        -count(self.rows) * libm::log((1.0 - self.explained).max(f64::EPSILON))
    }
}

/// How far a row is along the travel, µm (arcsec).
pub(super) fn travel(problem: &Problem, row: usize) -> f64 {
    let sample = problem.samples[row];
    if problem.measurement.rotary {
        ARCSEC_A_TURN * problem.measurement.angle_rev[sample]
    } else {
        UM_A_MM * problem.record.position_mm[sample]
    }
}

fn said(column: &'static str, line: &Line) -> Doubt {
    // Another unit or ratio is hardly ever so near.
    let share = line.share;
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
    Doubt { what: "position-for-error", evidence: line.evidence(), says, mend }
}
