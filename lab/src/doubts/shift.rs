//! Another zero of the position, or of one pass's: all that is fixed to the travel stands beside its place.
//!
//! The clock's zero is none of this: time counts from the start of a record, whatever its clock says.

use std::ops::Range;

use super::hypothesis::{Hypothesis, Words};
use super::law::follows_from_clock;
use crate::measurement::Measurement;
use crate::model::{Columns, Gain, Problem, Stage};
use crate::noise::{Noise, rms};
use crate::numerics::{count, golden_maximum, in_parallel};
use crate::policy::mistakes::{A_PLACE, NEAR_THE_BEST_DOUBT, SHIFT_TURNS, WORTH_A_FIT};

/// Places looked at, a turn of the spindle: each shortest wave of a screw more than four times.
const PLACES_A_TURN: u16 = 20;

/// Finest grid of the places of a turn that is a whole one, as a power of two.
const FINEST: i32 = 11;

/// Most places of the grid that are looked at closely: a wave comes back every turn.
const TOPS: usize = 6;

/// Halvings of an interval after the best place of the grid is known.
const STEPS: usize = 16;

/// Whose zero is another.
#[derive(Clone, Copy, Debug)]
enum Zero {
    All,
    /// That of a position which counts the other way.
    FarEnd,
    /// That of a pass, by its index.
    Pass(usize),
}

/// For each zero the shift that brings what the file predicts nearest to the data; none where nothing
/// that it predicts depends on it.
pub(super) fn shifts(
    problem: &Problem,
    odd: Option<usize>,
    noises: &[Vec<Noise>],
) -> Vec<Hypothesis> {
    let (rotary, effects) = (problem.measurement.rotary, &problem.model.effects);
    if effects.is_empty() || rotary && follows_from_clock(&problem.measurement, &problem.model) {
        return Vec::new();
    }
    let stages = stages(problem, noises);
    let of_all: &[Zero] = if rotary { &[Zero::All] } else { &[Zero::All, Zero::FarEnd] };
    let zeros = of_all.iter().copied().chain(odd.map(Zero::Pass));
    zeros.flat_map(|zero| hypotheses(&stages, zero)).collect()
}

/// A problem under each noise.
pub(super) fn stages<'a>(problem: &'a Problem, noises: &[Vec<Noise>]) -> Vec<Stage<'a>> {
    noises.iter().map(|noises| Stage::new(problem, &Columns::default(), noises)).collect()
}

/// The best shift of a zero under either noise; both pay for as many looks.
fn hypotheses(stages: &[Stage<'_>], zero: Zero) -> Vec<Hypothesis> {
    let problem = stages[0].problem;
    let Ok(before) = problem.predicted_of(&problem.measurement) else { return Vec::new() };
    let moved = |turns: f64| moved(problem, &zero.shifted(problem, turns), &before);
    let Some(grid) = grid(problem, &moved) else { return Vec::new() };
    let found: Vec<_> = stages.iter().filter_map(|stage| best(stage, &moved, grid)).collect();
    let looks = found.iter().map(|(_, looks)| *looks).fold(1.0, f64::max);
    let hypothesis = |(turns, _): &(f64, f64)| {
        let shifted = zero.shifted(problem, *turns);
        let one = Hypothesis::of_measurement(problem, &shifted, zero.words(problem, *turns))?;
        Some(Hypothesis { numbers: 1.0, looks, usual: 0.0, pass: zero.pass(), ..one })
    };
    found.iter().filter_map(hypothesis).collect()
}

/// By how much a shift moves what is predicted; `None` where an effect cannot be worked out.
pub(super) type Moved<'a> = dyn Fn(f64) -> Option<Vec<f64>> + Sync + 'a;

/// The best shift, looked for so many places of a grid either way, and at how many independent places that was:
/// shifts by a period more are no other shift.
pub(super) fn best(
    stage: &Stage<'_>,
    moved: &Moved<'_>,
    (step, most): (f64, i32),
) -> Option<(f64, f64)> {
    let evidence =
        |shift: f64| moved(shift).map_or(f64::NEG_INFINITY, |moved| evidence(stage, moved));
    let places: Vec<f64> = (-most..=most).map(f64::from).collect();
    let said = in_parallel(&places, |place| evidence(place * step));
    let highest = said.iter().copied().fold(0.0, f64::max);
    let is_top = |&at: &usize| {
        let near = &said[at.saturating_sub(1)..(at + 2).min(said.len())];
        let is_high = 0.0 < highest && NEAR_THE_BEST_DOUBT * highest <= said[at];
        is_high && near.iter().all(|other| *other <= said[at])
    };
    let mut tops: Vec<(usize, f64)> =
        (0..said.len()).filter(is_top).map(|at| (at, height(&said, at))).collect();
    let looks = count(places.len()) / count(tops.len().max(1));
    tops.sort_by(|a, b| b.1.total_cmp(&a.1));
    tops.truncate(TOPS);
    let refined = in_parallel(tops, |(at, _)| {
        let (from, to) = ((places[at] - 1.0) * step, (places[at] + 1.0) * step);
        golden_maximum(&mut |shift| evidence(shift), (from, to), STEPS)
    });
    Some((nearest_of_the_best(refined)?, looks))
}

/// Distance of the places of a grid, in turns of the spindle, and how many there are either way; `None` where
/// nothing that is predicted depends on the zero.
///
/// A rotary chain has one turn, and gears of any speed in it.
fn grid(problem: &Problem, moved: &Moved<'_>) -> Option<(f64, i32)> {
    let change = |turns: f64| Some(rms(&problem.layout, &moved(turns)?));
    let step = 1.0 / f64::from(PLACES_A_TURN);
    if !problem.measurement.rotary {
        // Half a place off a turn: what repeats every turn would not show that it moves.
        let is_moved = 0.0 < change(0.5 * step)?;
        return is_moved.then_some((step, i32::from(SHIFT_TURNS * PLACES_A_TURN)));
    }
    let power = a_place(problem, moved, 1..FINEST)?;
    Some((libm::exp2(-f64::from(power)), 1 << (power - 1)))
}

/// The least power of a half that moves what is predicted by no more than a place, or the end of those; `None` where
/// nothing is predicted.
pub(super) fn a_place(problem: &Problem, moved: &Moved<'_>, powers: Range<i32>) -> Option<i32> {
    let predicted = rms(&problem.layout, &problem.predicted);
    let most = A_PLACE.sqrt() * std::f64::consts::SQRT_2 * predicted;
    let change = |power: i32| Some(rms(&problem.layout, &moved(libm::exp2(-f64::from(power)))?));
    let is_near = |power: &i32| change(*power).is_some_and(|by| by < most);
    let end = powers.end;
    (0.0 < most).then(|| powers.rev().take_while(is_near).last().unwrap_or(end))
}

/// Height of a parabola through the top of a grid and its neighbours.
fn height(said: &[f64], at: usize) -> f64 {
    let top = said[at];
    let (Some(before), Some(after)) = (at.checked_sub(1).map(|at| said[at]), said.get(at + 1))
    else {
        return top;
    };
    let bend = 2.0 * top - before - after;
    if 0.0 < bend { top + (after - before).powi(2) / (8.0 * bend) } else { top }
}

/// The least shift of those that explain as much as the best: a wave comes back every turn.
fn nearest_of_the_best(mut refined: Vec<(f64, f64)>) -> Option<f64> {
    let most = refined.iter().map(|(_, said)| *said).fold(f64::NEG_INFINITY, f64::max);
    refined.retain(|(_, said)| most - WORTH_A_FIT <= *said);
    refined.into_iter().map(|(shift, _)| shift).min_by(|a, b| a.abs().total_cmp(&b.abs()))
}

impl Zero {
    /// The pass that it is of, where it is of one.
    fn pass(self) -> Option<usize> {
        if let Self::Pass(pass) = self { Some(pass) } else { None }
    }

    fn shifted(self, problem: &Problem, turns: f64) -> Measurement {
        let measurement = &problem.measurement;
        let lead_mm = problem.model.workpiece.lead.mm();
        let (mut mended, by) = match self {
            Self::FarEnd => (measurement.turned(), turns - both_ends_mm(measurement) / lead_mm),
            Self::All | Self::Pass(_) => (measurement.clone(), turns),
        };
        for (row, pass) in problem.record.pass.iter().enumerate() {
            if !matches!(self, Self::Pass(only) if only != *pass) {
                mended.samples.position_mm[row] -= by * lead_mm;
                mended.samples.angle_rev[row] -= by;
            }
        }
        mended
    }

    fn words(self, problem: &Problem, turns: f64) -> Words {
        let of_pass = match self {
            Self::FarEnd => return far_end(problem, turns),
            Self::All => String::new(),
            Self::Pass(pass) => format!(" of pass {}", problem.measurement.pass_names[pass]),
        };
        let (what, column, shift, unit) = if problem.measurement.rotary {
            ("angle", "angle_rev", format!("{:.4}", turns.abs()), "turns")
        } else {
            let shift_mm = turns * problem.model.workpiece.lead.mm();
            ("position", "position_mm", format!("{:.3}", shift_mm.abs()), "mm")
        };
        let (sign, less, more) = if turns < 0.0 { ("-", "add", "to") } else { ("", "take", "off") };
        let says = format!(
            "the data's zero of the {what}{of_pass} lies {sign}{shift} {unit} from the file's"
        );
        let mend = format!("{less} {shift} {unit} {more} `{column}`{of_pass}");
        ("shift", format!("{says} (offset)"), mend)
    }
}

/// What is said of a position that counts from the other end.
fn far_end(problem: &Problem, turns: f64) -> Words {
    let shift_mm = turns * problem.model.workpiece.lead.mm();
    let from_mm = both_ends_mm(&problem.measurement) - shift_mm;
    let says = format!("`position_mm` counts the other way, from {from_mm:.3} mm (reversed)");
    ("shift", says, format!("take `position_mm` from {from_mm:.3} mm"))
}

/// Sum of the least and the largest place, mm: where a travel ends that counts from its other end.
fn both_ends_mm(measurement: &Measurement) -> f64 {
    let places = || measurement.position_mm.iter().copied();
    places().fold(f64::INFINITY, f64::min) + places().fold(f64::NEG_INFINITY, f64::max)
}

/// By how much what is predicted of a shifted measurement is another than before.
pub(super) fn moved(problem: &Problem, shifted: &Measurement, before: &[f64]) -> Option<Vec<f64>> {
    let after = problem.predicted_of(shifted).ok()?;
    Some(after.iter().zip(before).map(|(after, before)| after - before).collect())
}

/// What a change explains under noise of the stage's slowness and of whatever size it leaves.
fn evidence(stage: &Stage<'_>, moved: Vec<f64>) -> f64 {
    let Gain { gain, fit } =
        stage.gain(&Columns { fixed: Some(moved.into()), ..Columns::default() });
    let left = fit.residual_square.max(f64::MIN_POSITIVE);
    count(stage.problem.samples.len()) * libm::log((gain + left) / left)
}
