//! Readings that stand some rows beside their place, as a column does that was pasted a row too low.

use std::ops::Range;

use super::hypothesis::Hypothesis;
use super::view::{View, rough_noises};
use super::worst_pass::saying;
use crate::measurement::sensor_column;
use crate::model::{Columns, Problem};
use crate::policy::mistakes::{DOUBT, MOST_ROWS_SLIPPED};

/// What each sensor shows, so many rows too low or too high in every pass, of a problem whose ends of passes say
/// nothing.
///
/// A reversal is often late by itself, as play is taken up: a slip shows where no turn is near, too.
pub(super) fn slips(problem: &Problem) -> Vec<Hypothesis> {
    let apart = apart_from_turns(problem);
    let view = View::new(&apart, &Columns::default(), &rough_noises(&apart));
    let as_it_is = view.left(problem);
    let is_elsewhere = |one: &Hypothesis| DOUBT < as_it_is - view.left(&one.mended);
    let sensors = 0..problem.sensors.len();
    let rows = -MOST_ROWS_SLIPPED..=MOST_ROWS_SLIPPED;
    let moved = rows.filter(|rows| *rows != 0);
    let all = sensors.flat_map(|sensor| moved.clone().map(move |rows| (sensor, rows)));
    all.map(|(sensor, rows)| slip(problem, sensor, rows)).filter(is_elsewhere).collect()
}

/// A problem in which the rows at the ends of its passes say nothing, where what a slipped column shows is lost or
/// another pass's.
pub(super) fn apart_from_ends(problem: &Problem) -> Problem {
    silent(problem, |rows, row| reached(rows, row).all(|meant| meant.is_some()))
}

/// The same for rows near a turn, where it is of the other way.
fn apart_from_turns(problem: &Problem) -> Problem {
    let way = |row: usize| problem.record.direction[problem.samples[row]];
    silent(problem, |rows, row| {
        reached(rows, row).all(|meant| meant.is_some_and(|meant| 0.0 < way(row) * way(meant)))
    })
}

/// The rows of a pass that one may stand for at most, before it and behind.
fn reached(rows: &Range<usize>, row: usize) -> impl Iterator<Item = Option<usize>> {
    [-MOST_ROWS_SLIPPED, MOST_ROWS_SLIPPED].into_iter().map(move |by| meant(rows, row, by))
}

/// The row of a pass that stands so many beside another, if it is there.
fn meant(rows: &Range<usize>, row: usize, by: isize) -> Option<usize> {
    row.checked_add_signed(by).filter(|meant| rows.contains(meant))
}

/// A problem in which only some rows say anything.
fn silent(problem: &Problem, speaks: impl Fn(&Range<usize>, usize) -> bool) -> Problem {
    let mut quiet = vec![false; problem.samples.len()];
    for rows in problem.layout.blocks.iter().map(|block| &block.rows) {
        rows.clone().for_each(|row| quiet[row] = !speaks(rows, row));
    }
    Problem { layout: problem.layout.without(|row| quiet[row]), ..problem.clone() }
}

/// What is predicted of a row stands where its reading does.
fn slip(problem: &Problem, sensor: usize, too_low: isize) -> Hypothesis {
    let mut predicted = problem.predicted.to_vec();
    for block in problem.layout.blocks.iter().filter(|block| block.sensor == sensor) {
        for row in block.rows.clone() {
            if let Some(meant) = meant(&block.rows, row, -too_low) {
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
