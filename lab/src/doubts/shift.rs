//! Another zero of the position: all that is fixed to the travel stands beside its place.

use rayon::prelude::*;

use super::hypothesis::Hypothesis;
use crate::measurement::Measurement;
use crate::model::{Columns, Problem, Stage, noises_of};
use crate::numerics::{count, golden_maximum};
use crate::policy::mistakes::SHIFT_TURNS;

/// Places looked at, a turn of the spindle: each shortest wave of a screw more than four times.
const PLACES_A_TURN: u16 = 20;

/// Halvings of an interval after the best place of the grid is known.
const STEPS: usize = 16;

/// The shift that brings what the file predicts nearest to the data; `None` when it predicts
/// nothing that has a place.
pub(super) fn shift(problem: &Problem) -> Option<Hypothesis> {
    if problem.measurement.rotary || problem.model.effects.is_empty() {
        return None;
    }
    let stage = Stage::new(problem, &Columns::default(), &noises_of(problem, &problem.residual()));
    let gain = |shift_mm: f64| gain(&stage, shift_mm).unwrap_or(f64::NEG_INFINITY);
    let lead_mm = problem.model.workpiece.lead.mm();
    let step_mm = lead_mm / f64::from(PLACES_A_TURN);
    let places = 1..=SHIFT_TURNS * PLACES_A_TURN;
    let places: Vec<f64> = places.map(f64::from).flat_map(|place| [place, -place]).collect();
    let tried: Vec<(f64, f64)> =
        places.par_iter().map(|place| (gain(place * step_mm), place * step_mm)).collect();
    let (best, near_mm) = tried.into_iter().max_by(|a, b| a.0.total_cmp(&b.0))?;
    if best <= 0.0 {
        return None;
    }
    let ends = (near_mm - step_mm, near_mm + step_mm);
    let (shift_mm, _) = golden_maximum(&mut |place| gain(place), ends, STEPS);
    let says = format!("the data's zero of the position lies {shift_mm:.3} mm from the file's");
    let (less, more) = if shift_mm < 0.0 { ("add", "to") } else { ("take", "off") };
    let mend = format!("{less} {:.3} mm {more} `position_mm`", shift_mm.abs());
    let one = Hypothesis::of_measurement(
        problem,
        &shifted(&problem.measurement, shift_mm, lead_mm),
        ("shift", format!("{says} (offset)"), mend),
    )?;
    Some(Hypothesis { numbers: 1.0, looks: count(places.len()), usual: 0.0, ..one })
}

fn shifted(measurement: &Measurement, shift_mm: f64, lead_mm: f64) -> Measurement {
    let less = |values: &[f64], shift: f64| values.iter().map(|value| value - shift).collect();
    Measurement {
        position_mm: less(&measurement.position_mm, shift_mm),
        angle_rev: less(&measurement.angle_rev, shift_mm / lead_mm),
        ..measurement.clone()
    }
}

/// What a shift takes away under the noise of the file as it is.
fn gain(stage: &Stage<'_>, shift_mm: f64) -> Option<f64> {
    let problem = stage.problem;
    let lead_mm = problem.model.workpiece.lead.mm();
    let mended =
        Problem::new(&problem.model, &shifted(&problem.measurement, shift_mm, lead_mm)).ok()?;
    let moved = mended.predicted.iter().zip(&problem.predicted).map(|(a, b)| a - b).collect();
    Some(stage.gain(&Columns { fixed: Some(moved), ..Columns::default() }).gain)
}
