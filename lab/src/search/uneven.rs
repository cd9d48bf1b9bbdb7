//! What an effect's gain is worth when the noise is not what the model of the noise says.
//!
//! A likelihood ratio takes the whitened residual for equally large and unrelated everywhere. Where
//! a stretch of the record is louder, or a filter has smoothed it, a coefficient scatters by more.
//! By how much, the residual tells along the effect's own curve: the estimate of its variance that
//! allows for both (Newey and West 1987, *A simple, positive semi-definite, heteroskedasticity and
//! autocorrelation consistent covariance matrix*, Econometrica 55:703), over that of the model.

use std::ops::Range;

use crate::model::{Columns, Fit, Problem, Stage, State};
use crate::noise::{Block, Whitener, fit_noise};
use crate::numerics::least_squares::{dot, lagged};
use crate::numerics::{count, median};
use crate::policy::chance::{
    A_PART, ANOTHER_NOISE, NEARLY_ALL, NEIGHBOURHOOD, ROWS_A_LAG, UNEVEN_DEVIATIONS,
};

/// Median of the square of a standard normal variable, and the square of the relative scatter of
/// such a median of one value.
const MEDIAN_OF_A_SQUARE: f64 = 0.455;
const SCATTER_OF_MEDIAN: f64 = 5.4;

/// By what the variance of an effect's coefficient exceeds the model's, 1 where that is no more than
/// scatter.
#[must_use]
pub(super) fn inflation(problem: &Problem, now: &State, fit: &Fit, taken: &Taken) -> f64 {
    let Taken { curve, left } = taken;
    let rows = problem.samples.len();
    let square = dot(&curve[..rows], &curve[..rows]);
    let size = square * dot(&left[..rows], &left[..rows]);
    if size <= 0.0 {
        return 1.0;
    }
    let scale = (count(rows) / size).sqrt();
    let scores: Vec<f64> = (0..rows).map(|row| scale * curve[row] * left[row]).collect();
    let fourth: f64 = curve[..rows].iter().map(|value| value.powi(4)).sum();
    let stands_on = square * square / fourth;
    let along = along(problem, &scores, stands_on);
    let Some(block) = block_of(problem, &curve[..rows]) else { return along };
    let beside = beside(problem, block, (curve, left), stands_on);
    along.max(beside).max(nearby(problem, block, now, fit, (&curve[..rows], square)))
}

/// What an effect takes of the whitened residual of a model, and what it leaves.
pub(super) struct Taken {
    pub(super) curve: Vec<f64>,
    pub(super) left: Vec<f64>,
}

impl Taken {
    /// By some columns, under the noise of the fit with them.
    pub(super) fn by(problem: &Problem, now: &State, columns: &Columns, fit: &Fit) -> Self {
        let stage = Stage::new(problem, &now.columns, &fit.noises);
        let (mut curve, mut left) = (vec![0.0; stage.target.len()], stage.target.clone());
        for direction in stage.span(columns) {
            let along = dot(&direction, &stage.target);
            for (row, value) in direction.iter().enumerate() {
                curve[row] += along * value;
                left[row] -= along * value;
            }
        }
        Self { curve, left }
    }
}

/// The largest of the ratios over windows of 1, 2, 4 … lags that stands out of its scatter; `rows`
/// is how many rows the curve stands on.
fn along(problem: &Problem, scores: &[f64], rows: f64) -> f64 {
    let mut most: f64 = 1.0;
    let mut window = 1;
    while ROWS_A_LAG * count(window) <= rows.max(ROWS_A_LAG) {
        let ratio = ratio(problem, scores, window);
        let deviation = (2.0 / rows * (1.0 + 2.0 / 3.0 * count(window - 1))).sqrt();
        if 1.0 + UNEVEN_DEVIATIONS * deviation < ratio {
            most = most.max(ratio);
        }
        window *= 2;
    }
    most
}

/// Sum of the products of scores less than `window` rows of a pass apart, weighted to fall linearly.
fn ratio(problem: &Problem, scores: &[f64], window: usize) -> f64 {
    let mut sum = 0.0;
    for block in &problem.layout.blocks {
        let scores = &scores[block.rows.clone()];
        for lag in 0..window.min(scores.len()) {
            let weight = if lag == 0 { 1.0 } else { 2.0 - 2.0 * count(lag) / count(window) };
            sum += weight * lagged(scores, lag);
        }
    }
    sum
}

/// The same for a curve that stands on a small part of a pass, where the residual has lost what the
/// curve took: how well the curve would follow it elsewhere in the pass.
///
/// Elsewhere it is the median that counts, which another curve of that kind does not move.
fn beside(problem: &Problem, block: &Block, (curve, left): (&[f64], &[f64]), rows: f64) -> f64 {
    let noise = dot(left, left) / count(problem.samples.len());
    let (curve, left) = (&curve[block.rows.clone()], &left[block.rows.clone()]);
    if count(curve.len()) < ROWS_A_LAG * rows {
        return 1.0;
    }
    let wide = support(curve).len().max(2);
    let steps = (wide..curve.len() / 2).step_by(wide / 2);
    let squares = steps.flat_map(|step| {
        [false, true].map(|back| followed(curve, left, step, back).map(|square| square / noise))
    });
    let mut elsewhere: Vec<f64> = squares.flatten().collect();
    let number = elsewhere.len().max(1);
    let usual = median(&mut elsewhere) / MEDIAN_OF_A_SQUARE;
    let least = 1.0 + UNEVEN_DEVIATIONS * (SCATTER_OF_MEDIAN / count(number)).sqrt();
    if least < usual { usual } else { 1.0 }
}

/// The same for a curve in whose neighbourhood the noise is another than on the whole: what it gains
/// there under the one, over what it gains under the other.
fn nearby(
    problem: &Problem,
    block: &Block,
    now: &State,
    fit: &Fit,
    (curve, square): (&[f64], f64),
) -> f64 {
    let there = support(&curve[block.rows.clone()]);
    let start = block.rows.start;
    let reaches = [there.len().max(NEIGHBOURHOOD), block.rows.len()];
    let around = reaches.map(|reach| {
        let from = (start + there.start).saturating_sub(reach).max(start);
        from..(start + there.end + reach).min(block.rows.end)
    });
    // The noise of many rows is the noise of all, and in a pass of its own any smooth curve is slow
    // noise.
    let of_sensor = problem.layout.blocks.iter().filter(|one| one.sensor == block.sensor);
    let rows_of_sensor: usize = of_sensor.map(|one| one.rows.len()).sum();
    let a_part = around.into_iter().filter(|rows| A_PART * rows.len() <= rows_of_sensor);
    let stands = |rows: &Range<usize>| {
        let there = &curve[rows.clone()];
        NEARLY_ALL * square <= dot(there, there)
    };
    a_part
        .filter(stands)
        .map(|rows| gained_apart(problem, now, fit, &Block { rows, ..*block }))
        .fold(1.0, f64::max)
}

/// What a fit gains on a part of a block under the noise of all, over its gain there under a noise of
/// their own; 1 where they do not need one. It gains no more there than in all: without a large step the
/// noise is not that which the step leaves, but the step itself.
fn gained_apart(problem: &Problem, now: &State, fit: &Fit, part: &Block) -> f64 {
    let layout = problem.layout.stretch(part);
    let (before, after) = (&now.fit.left[part.rows.clone()], &fit.left[part.rows.clone()]);
    let whitener = Whitener::new(&layout, &fit.noises[part.sensor..=part.sensor]);
    let own = fit_noise(&layout, after, None).log_likelihood;
    let with_it = whitener.log_likelihood(after);
    if 2.0 * (own - with_it) < ANOTHER_NOISE {
        return 1.0;
    }
    let in_all = (fit.log_likelihood - now.fit.log_likelihood).max(0.0);
    let gained = (with_it - whitener.log_likelihood(before)).min(in_all);
    let apart = own - fit_noise(&layout, before, None).log_likelihood;
    gained / apart.clamp(f64::MIN_POSITIVE, gained.max(f64::MIN_POSITIVE))
}

/// The block in which a curve is highest.
fn block_of<'a>(problem: &'a Problem, curve: &[f64]) -> Option<&'a Block> {
    let peak = |row: &usize| curve[*row].abs();
    let highest = (0..problem.samples.len()).max_by(|a, b| peak(a).total_cmp(&peak(b)))?;
    problem.layout.blocks.iter().find(|one| one.rows.contains(&highest))
}

/// Rows from the first to the last at which a curve is more than a tenth of its peak.
fn support(curve: &[f64]) -> Range<usize> {
    let peak = curve.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    let is_high = |value: &f64| 0.1 * peak < value.abs();
    let first = curve.iter().position(is_high).unwrap_or(0);
    first..curve.iter().rposition(is_high).map_or(first, |last| last + 1)
}

/// Square that a curve, moved by so many rows, takes of a residual; `None` where most of it would
/// leave the pass.
fn followed(curve: &[f64], left: &[f64], by: usize, back: bool) -> Option<f64> {
    let rest = curve.len() - by;
    let (curve_part, left_part) =
        if back { (&curve[by..], &left[..rest]) } else { (&curve[..rest], &left[by..]) };
    let size = dot(curve_part, curve_part);
    let product = dot(curve_part, left_part);
    (0.5 * dot(curve, curve) < size).then(|| product * product / size)
}
