//! Plain shapes that no effect makes, held against the effects that can imitate them.
//!
//! A cubic with a bump follows a kink to within the noise, a slip in every pass follows a step at
//! one place, and a slip with a hop of the laser follows a step of any size, so a good fit alone
//! does not name them: where a plain shape with fewer numbers explains the same data better, they
//! are imitations.

use helixlock_plant::{Entry, Parameter, Search};

use super::candidates::{around, between_samples, evenly_among};
use super::probes::Structure;
use crate::model::{Columns, Component, Problem, Stage, State, settle};
use crate::noise::rms;
use crate::numerics::count;
use crate::policy::evidence::PLAIN_SHAPE;

/// Places tried for a plain shape before it is looked for nearby.
const PLACES: usize = 100;

/// The plain shape that explains more than some imitators of a model, with fewer numbers.
///
/// Its chance is the odds that the imitators are right, by the Bayesian information criterion.
#[must_use]
pub(crate) fn better_shape(problem: &Problem, state: &State) -> Option<Structure> {
    let places: Vec<usize> =
        (0..state.components.len()).filter(|&i| imitates(&state.components[i])).collect();
    if places.is_empty() {
        return None;
    }
    groups(&places, state.components.len())
        .iter()
        .find_map(|group| better_than(problem, state, group))
}

/// What a plain shape may stand in for: all imitators, each of them, all but one, the whole model.
fn groups(imitators: &[usize], components: usize) -> Vec<Vec<usize>> {
    let mut groups: Vec<Vec<usize>> = vec![imitators.to_vec()];
    groups.extend(imitators.iter().map(|&one| vec![one]));
    let others = |one: &usize| imitators.iter().copied().filter(|i| i != one).collect();
    groups.extend(imitators.iter().map(others));
    groups.push((0..components).collect());
    groups.retain(|group| !group.is_empty());
    groups.sort();
    groups.dedup();
    groups
}

/// The plain shape that explains more than a group of effects in their place.
fn better_than(problem: &Problem, state: &State, group: &[usize]) -> Option<Structure> {
    let (imitators, others): (Vec<_>, Vec<_>) =
        state.components.iter().enumerate().partition(|(index, _)| group.contains(index));
    let imitators: Vec<&Component> = imitators.into_iter().map(|(_, one)| one).collect();
    let others: Vec<Component> = others.into_iter().map(|(_, one)| one.clone()).collect();
    let base = Columns::of(problem, &others).ok()?;
    let trial = Stage::new(problem, &base, &state.fit.noises);
    let (axis, best) = strongest(&trial, &imitators)?;
    let fit = settle(problem, &base.and(&best.columns), &state.fit.noises);
    let price = problem.price_of_a_number();
    // A size a column, and the place.
    let freedom = count(best.columns.raw.len() + 1);
    let saved = imitators.iter().map(|one| numbers(one)).sum::<f64>() - freedom;
    // The shape's own noise may suit the imitators, too.
    let own = settle(problem, &state.columns, &fit.noises).log_likelihood;
    let own = own.max(state.fit.log_likelihood);
    let ahead = 2.0 * (fit.log_likelihood - own) + price * saved;
    let mut names: Vec<&str> = imitators.iter().map(|one| one.term.name.as_str()).collect();
    names.sort_unstable();
    names.dedup();
    (PLAIN_SHAPE < ahead).then(|| Structure {
        along: axis.name().to_owned(),
        shape: format!("{}, better than {}", best.name, names.join(" and ")),
        rms_um: rms(&problem.layout, &settle(problem, &base, &state.fit.noises).left),
        p_value: libm::exp(-0.5 * ahead),
        at: Some(best.at),
        at_stderr: None,
        line: None,
    })
}

/// True for a curve over the travel, and for an effect with a place or a moment of its own: of
/// these, several make up any shape.
fn imitates(component: &Component) -> bool {
    let term = &component.term;
    let placed = |what: &Parameter| matches!(what.search, Search::Position | Search::Time);
    term.nature().curve || term.parameters.iter().any(placed)
}

/// Linear and nonlinear numbers of an effect.
fn numbers(component: &Component) -> f64 {
    count(component.width() + component.term.nonlinear_indices().len())
}

/// What a shape stands along.
#[derive(Clone, Copy)]
enum Axis {
    Travel,
    Time,
}

impl Axis {
    fn name(self) -> &'static str {
        match self {
            Self::Travel => "position",
            Self::Time => "time",
        }
    }
}

/// A shape at a place or a moment.
struct Shape {
    name: &'static str,
    at: f64,
    columns: Columns,
}

/// The shape that takes the most away, of both axes, and which it stands along.
fn strongest(trial: &Stage<'_>, imitators: &[&Component]) -> Option<(Axis, Shape)> {
    let axes = [Axis::Travel, Axis::Time];
    let best = axes.map(|axis| Some((axis, strongest_along(trial, axis, imitators)?)));
    let best = best.into_iter().flatten().max_by(|a, b| a.1.0.total_cmp(&b.1.0));
    best.map(|(axis, (_, shape))| (axis, shape))
}

/// Gain and shape of the best place: looked for evenly and where the imitators stand, then
/// between all samples nearby.
fn strongest_along(
    trial: &Stage<'_>,
    axis: Axis,
    imitators: &[&Component],
) -> Option<(f64, Shape)> {
    let record = &trial.problem.record;
    let (values, search) = match axis {
        Axis::Travel => (&record.position_mm, Search::Position),
        Axis::Time => (&record.time_s, Search::Time),
    };
    let gaps = between_samples(values);
    let of = |one: &&Component| {
        let with_values = one.term.parameters.iter().zip(&one.term.values);
        with_values.filter(|(what, _)| what.search == search).map(|(_, at)| *at).collect::<Vec<_>>()
    };
    let mut coarse = evenly_among(&gaps, PLACES);
    coarse.extend(imitators.iter().flat_map(of));
    let near = best_of(trial, axis, &coarse)?.1.at;
    let nearby = around(&gaps, near, gaps.len() / PLACES + 1);
    best_of(trial, axis, &[nearby, &[near]].concat())
}

fn best_of(trial: &Stage<'_>, axis: Axis, places: &[f64]) -> Option<(f64, Shape)> {
    let shapes = places.iter().flat_map(|at| shapes_at(trial.problem, axis, *at));
    let judged = shapes.map(|shape| (trial.gain(&shape.columns).gain, shape));
    judged.max_by(|a, b| a.0.total_cmp(&b.0))
}

/// A kink, a bend into a parabola and a step of the travel, with the slope that goes with them; in
/// time a step alone, for a slope there is a drift.
fn shapes_at(problem: &Problem, axis: Axis, at: f64) -> Vec<Shape> {
    let column = |values: &[f64], of: &dyn Fn(f64) -> f64| {
        let deltas: Vec<f64> = values.iter().map(|value| of(*value)).collect();
        problem.column(Entry::Motion, &deltas)
    };
    let beyond = |x: f64| f64::from(u8::from(at < x));
    match axis {
        Axis::Time => {
            let step = column(&problem.record.time_s, &beyond);
            vec![Shape { name: "step at one moment", at, columns: Columns::free(vec![step]) }]
        }
        Axis::Travel => {
            let travel = &problem.record.position_mm;
            let metres = |x: f64| (x - at).max(0.0) / 1000.0;
            let slope = column(travel, &|x| x / 1000.0);
            let shapes = [
                ("kink at one place", column(travel, &metres)),
                ("bend from one place on", column(travel, &|x| metres(x) * metres(x))),
                ("step at one place", column(travel, &beyond)),
            ];
            let with_slope = |raw| Columns::free(vec![slope.clone(), raw]);
            shapes.map(|(name, raw)| Shape { name, at, columns: with_slope(raw) }).into()
        }
    }
}
