//! Readings that stand some rows beside their place, as a column does that was pasted a row too low.

use super::court::saying;
use super::hypothesis::Hypothesis;
use crate::measurement::sensor_column;
use crate::model::Problem;
use crate::policy::mistakes::MOST_ROWS_SLIPPED;

/// What each sensor shows, so many rows too low or too high in every pass.
pub(super) fn slips(problem: &Problem) -> Vec<Hypothesis> {
    let sensors = 0..problem.sensors.len();
    let rows = -MOST_ROWS_SLIPPED..=MOST_ROWS_SLIPPED;
    let moved = rows.filter(|rows| *rows != 0);
    sensors.flat_map(|sensor| moved.clone().map(move |rows| slip(problem, sensor, rows))).collect()
}

/// What is predicted of a row stands where its reading does, but for rows that would come from before a turn or from
/// another pass: a reversal is often late by itself, as play is taken up.
fn slip(problem: &Problem, sensor: usize, too_low: isize) -> Hypothesis {
    let mut predicted = problem.predicted.to_vec();
    let way = |row: usize| problem.record.direction[problem.samples[row]];
    for block in problem.layout.blocks.iter().filter(|block| block.sensor == sensor) {
        for row in block.rows.clone() {
            let meant = row.saturating_add_signed(-too_low);
            if block.rows.contains(&meant) && 0.0 < way(row) * way(meant) {
                predicted[row] = problem.predicted[meant];
            }
        }
    }
    let column = sensor_column(problem.sensors[sensor], problem.measurement.rotary);
    let (below, back) = if 0 < too_low { ("below", "up") } else { ("above", "down") };
    let rows = too_low.unsigned_abs();
    let rows = if rows == 1 { "1 row".to_owned() } else { format!("{rows} rows") };
    let says = format!("`{column}` stands {rows} {below} its place in every pass");
    let mend = format!("move `{column}` {back} by {rows} in every pass");
    let slipped = Hypothesis::new(("shift", says, mend), saying(problem, predicted));
    Hypothesis { slips: true, ..slipped }
}
