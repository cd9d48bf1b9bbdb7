//! Plain shapes of the travel that no effect makes, held against the effects that can imitate them.
//!
//! A cubic with a bump follows a kink to within the noise, and a slip in every pass follows a step
//! at one place, so a good fit alone does not name them: where a kink or a step with fewer numbers
//! explains the same data better, they are imitations.

use helixlock_plant::{Entry, Parameter, Search};

use crate::analysis::State;
use crate::candidates::between_samples;
use crate::component::Component;
use crate::count;
use crate::fit::{Columns, rms, settle};
use crate::measurement::spread;
use crate::probes::Structure;
use crate::problem::Problem;
use crate::stage::Stage;

/// Effects that are smooth curves or stairs over the travel.
const CURVES: [&str; 3] = ["screw-progressive", "steady-sag", "compensator-staircase"];

/// Places tried for a kink or a step.
const PLACES: u32 = 100;

/// Free numbers of a plain shape: a slope, a size and a place.
const FREEDOM: f64 = 3.0;

/// Evidence by which a plain shape must be better.
const BETTER: f64 = 10.0;

/// The plain shape that explains more than the imitators of a model, with fewer numbers.
///
/// Its chance is the odds that the imitators are right, by the Bayesian information criterion.
#[must_use]
pub fn better_shape(problem: &Problem, state: &State) -> Option<Structure> {
    let imitators: Vec<&Component> = state.components.iter().filter(|one| imitates(one)).collect();
    if imitators.is_empty() {
        return None;
    }
    let others: Vec<Component> =
        state.components.iter().filter(|one| !imitates(one)).cloned().collect();
    let base = Columns::of(problem, &others).ok()?;
    let trial = Stage::new(problem, &base, &state.fit.noises);
    let best = strongest(&trial)?;
    let fit = settle(problem, &base.and(&best.columns), &state.fit.noises);
    let price = libm::log(count(problem.rows.len()).max(3.0));
    let freedom: f64 = imitators.iter().map(|one| numbers(one)).sum();
    let ahead = 2.0 * (fit.log_likelihood - state.fit.log_likelihood) + price * (freedom - FREEDOM);
    let mut names: Vec<&str> = imitators.iter().map(|one| one.term.name.as_str()).collect();
    names.sort_unstable();
    names.dedup();
    (BETTER < ahead).then(|| Structure {
        along: "position".to_owned(),
        shape: format!("{} at one place, better than {}", best.name, names.join(" and ")),
        rms_um: rms(&problem.layout, &settle(problem, &base, &state.fit.noises).left),
        p_value: libm::exp(-0.5 * ahead),
        at: Some(best.place_mm),
        at_stderr: None,
        line: None,
    })
}

/// True for a curve over the travel, and for an effect with a place or a moment of its own: of
/// these, several make up any shape.
fn imitates(component: &Component) -> bool {
    let term = &component.term;
    let placed = |what: &Parameter| matches!(what.search, Search::Position | Search::Time);
    CURVES.contains(&term.kind()) || term.parameters.iter().any(placed)
}

/// Linear and nonlinear numbers of an effect.
fn numbers(component: &Component) -> f64 {
    count(component.width() + component.term.nonlinear_indices().len())
}

/// A shape at a place, with the slope that goes with it.
struct Shape {
    name: &'static str,
    place_mm: f64,
    columns: Columns,
}

/// The shape that takes the most away, looked for evenly first, then between all samples nearby.
fn strongest(trial: &Stage<'_>) -> Option<Shape> {
    let travel = &trial.problem.record.position_mm;
    let low = travel.iter().copied().fold(f64::INFINITY, f64::min);
    let apart = spread(travel) / f64::from(PLACES);
    let evenly: Vec<f64> = (1..PLACES).map(|i| low + apart * f64::from(i)).collect();
    let near = best_of(trial, &evenly)?.place_mm;
    let gaps = between_samples(travel);
    let nearby = gaps.into_iter().filter(|gap| (gap - near).abs() <= apart);
    best_of(trial, &nearby.chain([near]).collect::<Vec<f64>>())
}

fn best_of(trial: &Stage<'_>, places: &[f64]) -> Option<Shape> {
    let shapes = places.iter().flat_map(|place_mm| shapes_at(trial.problem, *place_mm));
    let judged = shapes.map(|shape| (trial.gain(&shape.columns).gain, shape));
    judged.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, shape)| shape)
}

fn shapes_at(problem: &Problem, place_mm: f64) -> [Shape; 2] {
    let travel = &problem.record.position_mm;
    let column = |of: &dyn Fn(f64) -> f64| {
        let deltas: Vec<f64> = travel.iter().map(|x| of(*x)).collect();
        problem.column(Entry::Motion, &deltas)
    };
    let slope = column(&|x| x / 1000.0);
    let kink = column(&|x| (x - place_mm).max(0.0) / 1000.0);
    let step = column(&|x| f64::from(u8::from(place_mm < x)));
    [("kink", kink), ("step", step)].map(|(name, shape)| Shape {
        name,
        place_mm,
        columns: Columns::free(vec![slope.clone(), shape]),
    })
}
