//! Effects that were the nearest to another shape: beside all others, too, a way beyond their range follows it best.

use super::acceptance::at_an_end;
use super::court::curve_of_nobody;
use super::judging::{is_at_once, ways_of};
use crate::hypotheses::Structure;
use crate::model::{Problem, State};

/// Places of those effects of a model that are taken up at once, and what they show.
#[must_use]
pub(crate) fn running_off(problem: &Problem, state: &State) -> Vec<(usize, Structure)> {
    let is_at_once = |index: &usize| is_at_once(&state.components[*index].term);
    let places = (0..state.components.len()).filter(is_at_once);
    places.filter_map(|index| Some((index, runs_off(problem, state, index)?))).collect()
}

fn runs_off(problem: &Problem, state: &State, index: usize) -> Option<Structure> {
    let fewer = state.settled_without(problem, &[index])?;
    let ways = ways_of(problem, &fewer, (&state.components[index].term, &state.fit.noises));
    let clearest = ways.iter().max_by(|a, b| a.evidence.total_cmp(&b.evidence))?;
    let why = at_an_end(problem, &fewer, clearest)?;
    curve_of_nobody(problem, &fewer, clearest, &why)
}
