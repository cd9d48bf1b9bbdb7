//! Error on data a fit has not seen.

use rayon::prelude::*;

use crate::fit::Columns;
use crate::layout::Layout;
use crate::least_squares;
use crate::noise::{Noise, Whitener};
use crate::problem::Problem;

/// Parts a pass is cut into when whole passes cannot be held out.
const PARTS: usize = 5;

/// Root mean square of the residual on held-out data, µm (arcsec).
///
/// Whole passes are held out in turn when the others tell every coefficient; otherwise stretches
/// of a fifth of each pass, twice with other bounds, for what happens at a bound shows on neither
/// side of it. A held-out part may have its own zero, as a pass has.
#[must_use]
pub fn holdout_rms(problem: &Problem, columns: &Columns, noises: &[Noise]) -> f64 {
    let folds = folds(problem, columns);
    let parts: Vec<_> =
        folds.par_iter().map(|fold| held_out_square(problem, columns, noises, fold)).collect();
    let square: f64 = parts.iter().map(|(square, _)| square).sum();
    let rows: usize = parts.iter().map(|(_, rows)| rows).sum();
    (square / crate::count(rows.max(1))).sqrt()
}

/// Per fold: true for the rows held out.
fn folds(problem: &Problem, columns: &Columns) -> Vec<Vec<bool>> {
    let layout = &problem.layout;
    let passes = layout.blocks.iter().map(|block| block.pass + 1).max().unwrap_or(0);
    let by_pass: Vec<Vec<bool>> = (0..passes)
        .map(|pass| rows_where(layout, |block, _| layout.blocks[block].pass == pass))
        .filter(|held| held.iter().any(|held| *held))
        .collect();
    let told = |held: &Vec<bool>| columns.raw.iter().all(|column| tells(layout, column, held));
    if 1 < by_pass.len() && by_pass.iter().all(told) {
        return by_pass;
    }
    let fifths = (0..PARTS).map(|part| (part, 0));
    let shifted = (0..=PARTS).map(|part| (part, 1));
    let stretch = |(part, halves): (usize, usize)| {
        rows_where(layout, |block, row| {
            let rows = &layout.blocks[block].rows;
            (2 * (row - rows.start) * PARTS + halves * rows.len()) / (2 * rows.len()) == part
        })
    };
    fifths.chain(shifted).map(stretch).collect()
}

fn rows_where(layout: &Layout, held: impl Fn(usize, usize) -> bool) -> Vec<bool> {
    let mut rows = vec![false; layout.len()];
    for (index, block) in layout.blocks.iter().enumerate() {
        for row in block.rows.clone() {
            rows[row] = held(index, row);
        }
    }
    rows
}

/// True when the rows left carry at least a tenth of what a column varies.
fn tells(layout: &Layout, column: &[f64], held: &[bool]) -> bool {
    let (mut kept, mut all) = (0.0, 0.0);
    for block in &layout.blocks {
        let part = &column[block.rows.clone()];
        let mean = part.iter().sum::<f64>() / crate::count(part.len().max(1));
        for row in block.rows.clone() {
            let square = (column[row] - mean) * (column[row] - mean);
            all += square;
            kept += if held[row] { 0.0 } else { square };
        }
    }
    0.1 * all <= kept
}

fn held_out_square(
    problem: &Problem,
    columns: &Columns,
    noises: &[Noise],
    held: &[bool],
) -> (f64, usize) {
    let residual = problem.residual();
    // A held-out row gets so much noise that the fit does not see it.
    let mut layout = problem.layout.clone();
    layout.inflation.iter_mut().zip(held).filter(|(_, held)| **held).for_each(|(f, _)| *f *= 1e8);
    let whitener = Whitener::new(&layout, noises);
    let white = columns.whitened(&whitener);
    let views: Vec<&[f64]> = white.iter().map(Vec::as_slice).collect();
    let fit = least_squares::fit(&views, &columns.target(&whitener, &residual));
    let left = columns.left(&residual, &fit.coefficients);
    let (mut square, mut count) = (0.0, 0);
    for block in &problem.layout.blocks {
        let part: Vec<f64> =
            block.rows.clone().filter(|&row| held[row]).map(|row| left[row]).collect();
        let mean = part.iter().sum::<f64>() / crate::count(part.len().max(1));
        square += part.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>();
        count += part.len();
    }
    (square, count)
}
