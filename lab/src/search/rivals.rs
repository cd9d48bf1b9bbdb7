//! Who explains the data as well as an effect that was found, so that no name is safe.

use super::acceptance::may_rival;
use super::aliases::by_sampling;
use super::judging::tried;
use super::likeness::{by_physics, far_fetched};
use super::pruning::counts;
use crate::model::{Columns, Component, Judged, Problem, State, pattern, settle};
use crate::noise::Whitener;
use crate::numerics::count;
use crate::numerics::least_squares;
use crate::numerics::least_squares::dot;
use crate::policy::evidence::{CLEAR_MARGIN, CLEAR_OF_BENDS, COINCIDENCE, INFLATION, MARGIN};

/// What was judged in the place of a component, and what the data cannot tell from it.
#[derive(Debug, Clone)]
pub(crate) struct Rivals {
    /// Its place among the components.
    pub(crate) index: usize,
    /// All effects tried in its place, best evidence first.
    pub(crate) tried: Vec<Judged>,
    /// Names that the data cannot tell from it.
    pub(crate) confused: Vec<String>,
}

/// What a count cannot be told from whose whole numbers lie closer than the data tell apart.
const JUMP: &str = "jump of any size";

/// Rivals of every component of a model, given the others.
///
/// `first` are the effects tried on the bare model; they save the work for a single effect.
#[must_use]
pub(crate) fn rivals(problem: &Problem, state: &State, first: &[Judged]) -> Vec<Rivals> {
    let counts = counts(problem, state);
    (0..state.components.len())
        .map(|index| {
            let tried = if state.components.len() == 1 {
                first.to_vec()
            } else {
                instead_of(problem, state, index)
            };
            let mut confused = confused(problem, state, index, &tried);
            let alike = by_physics(problem, state, index).into_iter();
            let alike = alike.chain(by_sampling(problem, state, index));
            for name in alike.chain(beside_a_part(problem, state, index)) {
                if !confused.contains(&name) {
                    confused.push(name);
                }
            }
            if counts.iter().any(|count| count.index == index && count.is_of_any_size()) {
                confused.push(JUMP.to_owned());
            }
            Rivals { index, tried, confused }
        })
        .collect()
}

/// Everything tried in the place of one component, the others kept.
fn instead_of(problem: &Problem, state: &State, index: usize) -> Vec<Judged> {
    let mut others: Vec<Component> = state.components.clone();
    others.remove(index);
    State::of(problem, others, &state.fit.noises)
        .map(|fewer| tried(problem, &fewer))
        .unwrap_or_default()
}

fn confused(problem: &Problem, state: &State, index: usize, tried: &[Judged]) -> Vec<String> {
    let component = &state.components[index];
    let name = &component.term.name;
    let own = tried.iter().find(|judged| judged.component.term.name == *name);
    let Some(own) = own else { return Vec::new() };
    let whitener = Whitener::new(&problem.layout, &own.fit.noises);
    let shape = pattern(problem, state, index, &whitener);
    let is_no_bend = component.term.nature().at_reversal || !component.term.needs().is_empty();
    let clear = if is_no_bend { CLEAR_OF_BENDS } else { CLEAR_MARGIN };
    tried
        .iter()
        .filter(|judged| judged.component.term.name != *name && 0.0 < judged.gain)
        .filter(|judged| may_rival(problem, judged))
        .filter(|judged| !far_fetched(&judged.component, component, &state.components))
        .filter(|judged| {
            let behind = own.evidence - judged.evidence;
            if clear <= behind {
                return false;
            }
            let behind = behind + evidence_beside(problem, state, judged);
            behind < MARGIN
                || (behind < clear
                    && judged.looks < COINCIDENCE * own.looks
                    && !is_exact(component)
                    && INFLATION < inflation(problem, &judged.component, &whitener, &shape))
        })
        .map(|judged| judged.component.term.name.clone())
        .collect()
}

/// Names that explain as much beside a part of an effect as the whole of it does: a tilted guide and a slope
/// draw what a screw's cubic does. What has a place or a length of its own bends to anything.
fn beside_a_part(problem: &Problem, state: &State, index: usize) -> Vec<String> {
    let whole = &state.components[index];
    let mut names = Vec::new();
    for part in whole.parts() {
        let saved = problem.price_of_a_number() * count(whole.width() - part.width());
        let mut components = state.without(&[index]);
        components.push(part);
        let Some(fewer) = State::of(problem, components, &state.fit.noises) else { continue };
        let others = tried(problem, &fewer).into_iter().filter(|judged| {
            let term = &judged.component.term;
            term.name != whole.term.name && term.nonlinear().is_empty()
        });
        let alike = others.filter(|judged| {
            State::of(problem, fewer.with(&judged.component), &state.fit.noises).is_some_and(
                |both| {
                    let ahead = 2.0 * (both.fit.log_likelihood - state.fit.log_likelihood);
                    let judged = Judged { fit: both.fit, ..judged.clone() };
                    -MARGIN < ahead + saved - judged.price() && may_rival(problem, &judged)
                },
            )
        });
        names.extend(alike.map(|judged| judged.component.term.name));
    }
    names
}

/// Evidence of a rival beside the whole model, none where it is not worth its price: what it
/// explains there is no part of what it stands in for.
fn evidence_beside(problem: &Problem, state: &State, rival: &Judged) -> f64 {
    let Ok(own) = Columns::of(problem, std::slice::from_ref(&rival.component)) else { return 0.0 };
    let fit = settle(problem, &state.columns.and(&own), &state.fit.noises);
    let gain = 2.0 * (fit.log_likelihood - state.fit.log_likelihood);
    (gain - rival.price()).max(0.0)
}

/// True for a number of the file, and for a count: that it fits exactly is evidence of its own, and
/// no free size gives way to another.
fn is_exact(component: &Component) -> bool {
    component.term.nature().is_setting() || component.whole.iter().any(Option::is_some)
}

/// Variance inflation of a pattern by another effect's fitted pattern: `1/(1 − R²)`.
pub(super) fn inflation(
    problem: &Problem,
    rival: &Component,
    whitener: &Whitener,
    shape: &[f64],
) -> f64 {
    let Ok((design, _)) = rival.without_starts().design(problem) else { return 1.0 };
    let columns: Vec<&[f64]> = design.columns.iter().map(|column| column.as_slice()).collect();
    let white = whitener.whiten_all(&columns);
    let views: Vec<&[f64]> = white.iter().map(Vec::as_slice).collect();
    let fit = least_squares::fit(&views, shape);
    dot(shape, shape) / fit.residual_square.max(f64::MIN_POSITIVE)
}
