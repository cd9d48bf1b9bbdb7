//! Residuals drawn over travel or time.

use helixlock_lab::Problem;

use super::residual_table::about_zero;

/// What residuals are drawn over: travel, or time for a rotary chain.
pub(crate) fn x_axis(problem: &Problem) -> &'static str {
    if problem.model.rotary { "time in s" } else { "position in mm" }
}

/// Values of one sensor about the zero of each pass, the passes apart.
pub(crate) fn points(problem: &Problem, sensor: usize, values: &[f64]) -> Vec<[f64; 2]> {
    let values = about_zero(problem, values);
    let mut points = Vec::new();
    for block in problem.layout.blocks.iter().filter(|block| block.sensor == sensor) {
        for row in block.rows.clone() {
            let sample = problem.samples[row];
            let x = if problem.model.rotary {
                problem.record.time_s[sample]
            } else {
                problem.record.position_mm[sample]
            };
            points.push([x, values[row]]);
        }
        points.push([f64::NAN, f64::NAN]);
    }
    points
}
