//! Effects that were the nearest to another shape: beside all others, too, a way beyond their range follows it best.

use helixlock_plant::Parameter;

use super::acceptance::at_an_end;
use super::court::curve_of_nobody;
use super::judging::ways_of;
use crate::hypotheses::Structure;
use crate::model::{Problem, State};

/// Places of those effects of a model that may be taken up at once, and what they show.
#[must_use]
pub(crate) fn running_off(problem: &Problem, state: &State) -> (Vec<usize>, Vec<Structure>) {
    let may_be_at_once = |what: &Parameter| what.of_way && what.default == Some(0.0);
    let has_such_a_way =
        |index: &usize| state.components[*index].term.parameters.iter().any(may_be_at_once);
    let places = (0..state.components.len()).filter(has_such_a_way);
    places.filter_map(|index| Some((index, runs_off(problem, state, index)?))).unzip()
}

fn runs_off(problem: &Problem, state: &State, index: usize) -> Option<Structure> {
    let fewer = state.settled_without(problem, &[index])?;
    let ways = ways_of(problem, &fewer, (&state.components[index].term, &state.fit.noises));
    let clearest = ways.iter().max_by(|a, b| a.evidence.total_cmp(&b.evidence))?;
    let why = at_an_end(problem, &fewer, clearest)?;
    curve_of_nobody(problem, &fewer, clearest, &why)
}
