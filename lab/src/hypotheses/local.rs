//! Anything at all that stands in a short stretch: of the travel in every pass, or of one pass.
//!
//! The whitened residual is cut into cells of equal width, and windows of neighbouring cells are
//! held against the noise inside those very cells by Fisher's law: a shape makes their means
//! differ from zero, a louder stretch makes all of it loud. What the windows of a record show in
//! the middle of their order is taken for the smoothness of its noise.

use statrs::distribution::{ContinuousCDF, FisherSnedecor};

use crate::model::{Fit, Problem};
use crate::noise::swift_rms;
use crate::numerics::{count, median, spread};
use crate::policy::extent::{CELLS, ROWS_A_CELL, WINDOWS};

/// Median of Fisher's law for a window; it hardly changes with the rows of its cells.
const USUAL: f64 = 0.9;

/// A stretch that is no noise.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Local {
    /// Root mean square over the whole record, µm (arcsec).
    pub(super) rms_um: f64,
    /// Chance of as much in any stretch of noise.
    pub(super) p_value: f64,
    /// Its middle, on the coordinate.
    pub(super) at: f64,
}

/// A cell of whitened rows.
struct Cell {
    /// Square of the mean against its variance in noise.
    square: f64,
    /// Square about the mean.
    within: f64,
    rows: f64,
    at: f64,
}

impl Cell {
    fn of(rows: &[(f64, f64)]) -> Self {
        let number = count(rows.len());
        let mean = rows.iter().map(|(_, white)| white).sum::<f64>() / number;
        let within = rows.iter().map(|(_, white)| (white - mean) * (white - mean)).sum();
        let at = rows.iter().map(|(at, _)| at).sum::<f64>() / number;
        Self { square: number * mean * mean, within, rows: number, at }
    }
}

/// The clearest stretch of the travel at which all passes show the same; `white` is what a fit
/// leaves, whitened.
#[must_use]
pub(super) fn along_travel(problem: &Problem, fit: &Fit, white: &[f64]) -> Option<Local> {
    let position = &problem.record.position_mm;
    if spread(position) <= 0.0 {
        return None;
    }
    let lines = (0..problem.sensors.len()).map(|sensor| {
        let blocks = problem.layout.blocks.iter().filter(|block| block.sensor == sensor);
        let rows = blocks.flat_map(|block| block.rows.clone());
        let mut line: Vec<(f64, f64)> =
            rows.map(|row| (position[problem.samples[row]], white[row])).collect();
        line.sort_by(|a, b| a.0.total_cmp(&b.0));
        line
    });
    clearest(problem, fit, &lines.collect::<Vec<_>>())
}

/// The clearest stretch of any single pass.
#[must_use]
pub(super) fn in_one_pass(problem: &Problem, fit: &Fit, white: &[f64]) -> Option<Local> {
    let time = &problem.record.time_s;
    let lines = problem.layout.blocks.iter().map(|block| {
        block.rows.clone().map(|row| (time[problem.samples[row]], white[row])).collect()
    });
    clearest(problem, fit, &lines.collect::<Vec<_>>())
}

/// The clearest window over some lines of rows, its chance for all that were looked at.
fn clearest(problem: &Problem, fit: &Fit, lines: &[Vec<(f64, f64)>]) -> Option<Local> {
    let longest = lines.iter().map(Vec::len).max()?;
    let widths = std::iter::successors(Some(ROWS_A_CELL), |width| Some(2 * width));
    let widths = widths.take_while(|width| WINDOWS * CELLS * width <= longest);
    let mut looked = 0.0;
    let mut best: Option<(f64, f64, f64)> = None;
    for width in widths {
        let windows = windows(lines, width);
        looked += count(windows.len());
        let mut ratios: Vec<f64> = windows.iter().map(|(ratio, ..)| *ratio).collect();
        let usual = (median(&mut ratios) / USUAL).max(1.0);
        for (ratio, freedom, at) in windows {
            let chance = fisher_tail(ratio / usual, freedom);
            if best.is_none_or(|(least, ..)| chance < least) {
                best = Some((chance, ratio, at));
            }
        }
    }
    let (chance, ratio, at) = best?;
    let share = count(CELLS) * (ratio - 1.0).max(0.0) / count(problem.samples.len());
    let rms_um = swift_rms(&problem.layout, &fit.left) * share.sqrt();
    Some(Local { rms_um, p_value: (chance * looked).min(1.0), at })
}

/// Of every window, half of one apart: the mean square of its cells against the noise inside them,
/// the degrees of freedom of that, and its middle.
fn windows(lines: &[Vec<(f64, f64)>], width: usize) -> Vec<(f64, f64, f64)> {
    let of_line = |line: &Vec<(f64, f64)>| {
        let cells: Vec<Cell> = line.chunks_exact(width).map(Cell::of).collect();
        let windows = cells.windows(CELLS).step_by(CELLS / 2).map(judged);
        windows.collect::<Vec<_>>()
    };
    lines.iter().flat_map(of_line).collect()
}

fn judged(cells: &[Cell]) -> (f64, f64, f64) {
    let sum = |of: fn(&Cell) -> f64| cells.iter().map(of).sum::<f64>();
    let freedom = sum(|cell| cell.rows - 1.0);
    let noise = (sum(|cell| cell.within) / freedom).max(1.0);
    let number = count(cells.len());
    (sum(|cell| cell.square) / number / noise, freedom, sum(|cell| cell.at) / number)
}

fn fisher_tail(ratio: f64, freedom: f64) -> f64 {
    FisherSnedecor::new(count(CELLS), freedom).map_or(1.0, |law| law.sf(ratio))
}
