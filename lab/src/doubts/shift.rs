//! Another zero of the position, or of one pass's: all that is fixed to the travel stands beside its place.
//!
//! The clock's zero is none of this: time counts from the start of a record, whatever its clock says.

use std::ops::Range;

use rayon::prelude::*;

use super::hypothesis::Hypothesis;
use crate::measurement::Measurement;
use crate::model::{Columns, Problem, Stage, noises_of};
use crate::numerics::{count, golden_maximum, mean};
use crate::policy::mistakes::{NEAR_THE_BEST_DOUBT, SHIFT_TURNS, WORSE_PASS, WORTH_A_FIT};

/// Places looked at, a turn of the spindle: each shortest wave of a screw more than four times.
const PLACES_A_TURN: u16 = 20;

/// Most places of the grid that are looked at closely: a wave comes back every turn.
const TOPS: usize = 6;

/// Halvings of an interval after the best place of the grid is known.
const STEPS: usize = 16;

/// Whose zero is another.
#[derive(Clone, Copy, Debug)]
enum Zero {
    Position,
    /// The position's, which counts the other way.
    FarEnd,
    /// The position of a pass, by its index.
    Pass(usize),
}

/// For each zero the shift that brings what the file predicts nearest to the data; none where nothing
/// that it predicts depends on it.
pub(super) fn shifts(problem: &Problem) -> Vec<Hypothesis> {
    if problem.measurement.rotary || problem.model.effects.is_empty() {
        return Vec::new();
    }
    let stage = Stage::new(problem, &Columns::default(), &noises_of(problem, &problem.residual()));
    zeros(problem).into_iter().filter_map(|zero| shift(&stage, zero)).collect()
}

/// The position's zero, at either end, and that of the pass which the file explains far worse than the others.
fn zeros(problem: &Problem) -> Vec<Zero> {
    let left = problem.residual();
    let passes = problem.measurement.pass_names.len();
    let mut sizes: Vec<(f64, usize)> = (0..passes)
        .map(|pass| {
            let blocks = problem.layout.blocks.iter();
            let of_pass = |rows: &Range<usize>| {
                rows.start < rows.end && problem.record.pass[problem.samples[rows.start]] == pass
            };
            let rows = blocks.map(|block| block.rows.clone()).filter(of_pass);
            let (squares, number) = rows.fold((0.0, 0), |(squares, number), rows| {
                let values = &left[rows];
                let mean = mean(values);
                let own: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
                (squares + own, number + values.len())
            });
            (squares / count(number.max(1)), pass)
        })
        .collect();
    sizes.sort_by(|a, b| b.0.total_cmp(&a.0));
    let worst = match sizes.as_slice() {
        [(most, pass), (next, _), ..] if WORSE_PASS * next < *most => Some(Zero::Pass(*pass)),
        _ => None,
    };
    [Zero::Position, Zero::FarEnd].into_iter().chain(worst).collect()
}

fn shift(stage: &Stage<'_>, zero: Zero) -> Option<Hypothesis> {
    let problem = stage.problem;
    let gain = |shift: f64| gain(stage, zero, shift).unwrap_or(f64::NEG_INFINITY);
    let step = problem.model.workpiece.lead.mm() / f64::from(PLACES_A_TURN);
    // Half a place off a turn: what repeats every turn would not show that it moves.
    let probe = moved(problem, zero, 0.5 * step)?;
    if probe.iter().all(|value| value.abs() <= 0.0) {
        return None;
    }
    let most = i32::from(SHIFT_TURNS * PLACES_A_TURN);
    let places: Vec<f64> = (-most..=most).map(f64::from).collect();
    let gains: Vec<f64> = places.par_iter().map(|place| gain(place * step)).collect();
    let most = gains.iter().copied().fold(0.0, f64::max);
    let is_top = |&at: &usize| {
        let near = &gains[at.saturating_sub(1)..(at + 2).min(gains.len())];
        let is_high = 0.0 < most && NEAR_THE_BEST_DOUBT * most <= gains[at];
        is_high && near.iter().all(|gain| *gain <= gains[at])
    };
    let mut tops: Vec<usize> = (0..gains.len()).filter(is_top).collect();
    // Shifts by a period more are no other shift.
    let looks = count(places.len()) / count(tops.len().max(1));
    tops.sort_by(|&a, &b| gains[b].total_cmp(&gains[a]));
    tops.truncate(TOPS);
    let refined = tops.into_par_iter().map(|at| {
        let (from, to) = ((places[at] - 1.0) * step, (places[at] + 1.0) * step);
        golden_maximum(&mut |place| gain(place), (from, to), STEPS)
    });
    let shift = nearest_of_the_best(refined.collect())?;
    let shifted = zero.shifted(problem, shift);
    let one = Hypothesis::of_measurement(problem, &shifted, zero.words(problem, shift))?;
    Some(Hypothesis { numbers: 1.0, looks, usual: 0.0, ..one })
}

/// The least shift of those that gain as much as the best: a wave comes back every turn.
fn nearest_of_the_best(mut refined: Vec<(f64, f64)>) -> Option<f64> {
    let most = refined.iter().map(|(_, gain)| *gain).fold(f64::NEG_INFINITY, f64::max);
    refined.retain(|(_, gain)| most - WORTH_A_FIT <= *gain);
    refined.into_iter().map(|(shift, _)| shift).min_by(|a, b| a.abs().total_cmp(&b.abs()))
}

impl Zero {
    fn shifted(self, problem: &Problem, shift_mm: f64) -> Measurement {
        let measurement = &problem.measurement;
        let (mut mended, by_mm) = match self {
            Self::FarEnd => (measurement.turned(), shift_mm - both_ends_mm(measurement)),
            Self::Position | Self::Pass(_) => (measurement.clone(), shift_mm),
        };
        let turns = by_mm / problem.model.workpiece.lead.mm();
        for (row, pass) in problem.record.pass.iter().enumerate() {
            if !matches!(self, Self::Pass(only) if only != *pass) {
                mended.samples.position_mm[row] -= by_mm;
                mended.samples.angle_rev[row] -= turns;
            }
        }
        mended
    }

    fn words(self, problem: &Problem, shift_mm: f64) -> (&'static str, String, String) {
        let (what, of_pass) = match self {
            Self::FarEnd => return far_end(problem, shift_mm),
            Self::Position => ("the position".to_owned(), String::new()),
            Self::Pass(pass) => {
                let name = problem.measurement.pass_names[pass];
                (format!("the position of pass {name}"), format!(" of pass {name}"))
            }
        };
        let says = format!("the data's zero of {what} lies {shift_mm:.3} mm from the file's");
        let (less, more) = if shift_mm < 0.0 { ("add", "to") } else { ("take", "off") };
        let mend = format!("{less} {:.3} mm {more} `position_mm`{of_pass}", shift_mm.abs());
        ("shift", format!("{says} (offset)"), mend)
    }
}

/// What is said of a position that counts from the other end.
fn far_end(problem: &Problem, shift_mm: f64) -> (&'static str, String, String) {
    let from_mm = both_ends_mm(&problem.measurement) - shift_mm;
    let says = format!("`position_mm` counts the other way, from {from_mm:.3} mm (reversed)");
    ("shift", says, format!("take `position_mm` from {from_mm:.3} mm"))
}

/// Sum of the least and the largest place, mm: where a travel ends that counts from its other end.
fn both_ends_mm(measurement: &Measurement) -> f64 {
    let places = || measurement.position_mm.iter().copied();
    places().fold(f64::INFINITY, f64::min) + places().fold(f64::NEG_INFINITY, f64::max)
}

/// By how much a shift moves what is predicted.
fn moved(problem: &Problem, zero: Zero, shift: f64) -> Option<Vec<f64>> {
    let mended = Problem::new(&problem.model, &zero.shifted(problem, shift)).ok()?;
    let pairs = mended.predicted.iter().zip(&problem.predicted);
    mended.has_rows_of(problem).then(|| pairs.map(|(a, b)| a - b).collect())
}

/// What a shift takes away under the noise of the file as it is.
fn gain(stage: &Stage<'_>, zero: Zero, shift: f64) -> Option<f64> {
    let moved = moved(stage.problem, zero, shift)?;
    Some(stage.gain(&Columns { fixed: Some(moved.into()), ..Columns::default() }).gain)
}
