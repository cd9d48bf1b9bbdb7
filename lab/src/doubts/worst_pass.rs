//! The one pass that the file explains far worse than the others: a mistake may be in it alone.

use std::ops::Range;

use crate::model::Problem;
use crate::numerics::{count, mean};
use crate::policy::mistakes::WORSE_PASS;

/// That pass, by its index.
pub(super) fn worst_pass(problem: &Problem) -> Option<usize> {
    let left = problem.residual();
    let mut sizes: Vec<(f64, usize)> = (0..problem.measurement.pass_names.len())
        .map(|pass| (mean_square(rows_of(problem, pass), &left), pass))
        .collect();
    sizes.sort_by(|a, b| b.0.total_cmp(&a.0));
    match sizes.as_slice() {
        [(most, pass), (next, _), ..] if WORSE_PASS * next < *most => Some(*pass),
        _ => None,
    }
}

/// The rows of a pass, those of each sensor together.
pub(super) fn rows_of(problem: &Problem, pass: usize) -> impl Iterator<Item = Range<usize>> {
    let blocks = problem.layout.blocks.iter();
    blocks.filter(move |block| block.pass == pass).map(|block| block.rows.clone())
}

/// A problem that predicts something else.
pub(super) fn saying(problem: &Problem, predicted: Vec<f64>) -> Problem {
    Problem { predicted: predicted.into(), ..problem.clone() }
}

/// A problem that predicts nothing in a pass.
pub(super) fn silent(problem: &Problem, pass: usize) -> Problem {
    let mut predicted = problem.predicted.to_vec();
    rows_of(problem, pass).for_each(|rows| predicted[rows].fill(0.0));
    saying(problem, predicted)
}

/// Mean square about the mean of each sensor.
fn mean_square(rows: impl Iterator<Item = Range<usize>>, left: &[f64]) -> f64 {
    let (squares, number) = rows.fold((0.0, 0), |(squares, number), rows| {
        let values = &left[rows];
        let mean = mean(values);
        let own: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
        (squares + own, number + values.len())
    });
    squares / count(number.max(1))
}
