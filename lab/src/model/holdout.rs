//! Error on data a fit has not seen.

use super::columns::Columns;
use super::problem::Problem;
use crate::noise::{Layout, Noise, Whitener, about_means, rms, swift_rms, weighed_rms};
use crate::numerics::{count, in_parallel, least_squares};
use crate::policy::evidence::{PARTS, TOLD};

/// Root mean square of the residual on held-out data, µm (arcsec).
///
/// Whole passes are held out in turn when the others tell every coefficient; otherwise stretches
/// of a fifth of each pass, or of two rows, twice with other bounds, for what happens at a bound shows on neither
/// side of it, and of those the ones beside which every coefficient is told, if there are any. A
/// held-out part may have its own zero, as a pass has.
#[must_use]
pub(crate) fn holdout_rms(problem: &Problem, columns: &Columns, noises: &[Noise]) -> f64 {
    holdout_rms_where(problem, columns, (columns, noises))
}

/// The same of a model on what is held out of another one's columns.
#[must_use]
pub(crate) fn holdout_rms_where(problem: &Problem, told: &Columns, model: Unseen<'_>) -> f64 {
    size(&unseen(problem, &folds(problem, told), model), |part| part.rms)
}

/// A model as it is held out: its columns and its noise.
pub(crate) type Unseen<'a> = (&'a Columns, &'a [Noise]);

/// True when one model does better on unseen data than another: in all, or in what is swift.
///
/// Slow effects that both lack may lie in the way of a swift one, and weigh more than it does. An
/// outlier has no say. Where what the models differ by lies in rows that none may be held out of, as
/// a warming-up at the start of a long record does, unseen data have no say either.
#[must_use]
pub(crate) fn helps_unseen(problem: &Problem, model: Unseen<'_>, without: Unseen<'_>) -> bool {
    let folds = folds(problem, model.0);
    if !tells_apart(problem, &folds, model, without) {
        return true;
    }
    let (model, without) = (unseen(problem, &folds, model), unseen(problem, &folds, without));
    let better = |of: fn(&Part) -> f64| size(&model, of) < size(&without, of);
    better(|part| part.weighed_rms) || better(|part| part.swift_rms)
}

/// True when enough of what two models differ by lies in rows that are held out some time.
fn tells_apart(
    problem: &Problem,
    folds: &[Vec<bool>],
    model: Unseen<'_>,
    without: Unseen<'_>,
) -> bool {
    let rows = 0..problem.layout.len();
    let never: Vec<bool> = rows.map(|row| folds.iter().all(|held| !held[row])).collect();
    if never.iter().all(|never| !never) {
        return true;
    }
    let nothing = vec![false; never.len()];
    let residual = problem.residual();
    let [with_it, without] =
        [model, without].map(|one| left_unseen(problem, &residual, one, &nothing));
    let difference: Vec<f64> = with_it.iter().zip(&without).map(|(a, b)| a - b).collect();
    tells(&problem.layout, &difference, &never)
}

/// What a model leaves of a part that is held out.
struct Part {
    rms: f64,
    weighed_rms: f64,
    swift_rms: f64,
    rows: usize,
}

fn unseen(problem: &Problem, folds: &[Vec<bool>], (columns, noises): Unseen<'_>) -> Vec<Part> {
    let residual = problem.residual();
    let of_fold = |held: &Vec<bool>| {
        let left = left_unseen(problem, &residual, (columns, noises), held);
        let (layout, rows) = problem.layout.of_rows(held);
        let left: Vec<f64> = rows.iter().map(|&row| left[row]).collect();
        Part {
            rms: rms(&layout, &left),
            weighed_rms: weighed_rms(&layout, &left),
            swift_rms: swift_rms(&layout, &left),
            rows: rows.len(),
        }
    };
    in_parallel(folds, of_fold)
}

/// Size of all parts together, `of` being that of one.
fn size(parts: &[Part], of: fn(&Part) -> f64) -> f64 {
    let square: f64 = parts.iter().map(|part| of(part) * of(part) * count(part.rows)).sum();
    let rows: usize = parts.iter().map(|part| part.rows).sum();
    (square / count(rows.max(1))).sqrt()
}

/// Per fold: true for the rows held out.
fn folds(problem: &Problem, columns: &Columns) -> Vec<Vec<bool>> {
    let layout = &problem.layout;
    let by_pass: Vec<Vec<bool>> = (0..layout.passes())
        .map(|pass| rows_where(layout, |block, _| layout.blocks[block].pass == pass))
        .filter(|held| held.iter().any(|held| *held))
        .collect();
    let told = |held: &Vec<bool>| columns.raw.iter().all(|column| tells(layout, column, held));
    if 1 < by_pass.len() && by_pass.iter().all(told) {
        return by_pass;
    }
    // A part of one row is all zero of its own.
    let longest = layout.blocks.iter().map(|block| block.rows.len()).max().unwrap_or(0);
    let parts = PARTS.min(longest / 2).max(2);
    let whole = (0..parts).map(|part| (part, 0));
    let shifted = (0..=parts).map(|part| (part, 1));
    let stretch = |(part, halves): (usize, usize)| {
        rows_where(layout, |block, row| {
            let rows = &layout.blocks[block].rows;
            (2 * (row - rows.start) * parts + halves * rows.len()) / (2 * rows.len()) == part
        })
    };
    let stretches: Vec<Vec<bool>> = whole.chain(shifted).map(stretch).collect();
    let telling: Vec<Vec<bool>> = stretches.iter().filter(|held| told(held)).cloned().collect();
    if telling.is_empty() { stretches } else { telling }
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

/// True when the rows left carry enough of what a column varies.
fn tells(layout: &Layout, column: &[f64], held: &[bool]) -> bool {
    let (mut kept, mut all) = (0.0, 0.0);
    for (value, held) in about_means(layout, column).iter().zip(held) {
        all += value * value;
        kept += if *held { 0.0 } else { value * value };
    }
    TOLD * all <= kept
}

/// What a model that was fitted to the other rows leaves.
fn left_unseen(
    problem: &Problem,
    residual: &[f64],
    (columns, noises): Unseen<'_>,
    held: &[bool],
) -> Vec<f64> {
    if columns.raw.is_empty() {
        return columns.left(residual, &[]);
    }
    let layout = problem.layout.without(|row| held[row]);
    let whitener = Whitener::new(&layout, noises);
    let white = columns.whitened(&whitener);
    let views: Vec<&[f64]> = white.iter().map(Vec::as_slice).collect();
    let fit = least_squares::fit(&views, &columns.target(&whitener, residual));
    columns.left(residual, &fit.coefficients)
}
