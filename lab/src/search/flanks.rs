//! Far readings at the flanks of what has one place.
//!
//! A bell follows a tooth but for its edge, whose readings then lie far from their neighbours and weigh little: of
//! what is another shape nothing is left. So where readings are far within reach of such an effect, they weigh as
//! all others do, and shapes without a name are heard once more in its place.

use std::collections::BTreeSet;

use helixlock_plant::Search;

use super::court::{Winner, in_place_of_any};
use super::rivals::Rivals;
use super::span::shown;
use crate::formulas::nameless;
use crate::model::{Problem, State};
use crate::numerics::{count, middle};
use crate::policy::evidence::MARGIN;
use crate::policy::reading::WITHIN_REACH;

/// The shape without a name that explains more than effects of one place and wild readings near them, once those
/// weigh as others do.
#[must_use]
pub(crate) fn at_flanks(problem: &Problem, state: &State, found: &[Rivals]) -> Option<Winner> {
    let has_a_place = |index: &usize| {
        let parameters = &state.components[*index].term.parameters;
        parameters.iter().any(|what| what.search == Search::Position)
    };
    let far = problem.weighed_down();
    let beside_far: Vec<(usize, Vec<usize>)> = (0..state.components.len())
        .filter(has_a_place)
        .map(|index| (index, reach(problem, state, index)))
        .filter(|(_, rows)| rows.iter().any(|row| far[*row]))
        .collect();
    if beside_far.is_empty() {
        return None;
    }
    let rows: BTreeSet<usize> = beside_far.iter().flat_map(|(_, rows)| rows).copied().collect();
    let whole = problem.weighing_fully(&rows);
    let in_full = state.on(&whole)?;
    let groups = beside_far.into_iter().map(|(index, _)| vec![index]).collect();
    let won = in_place_of_any(&whole, &in_full, found, groups, &nameless(&whole))?;
    // They may be wild: each of them anywhere.
    let excused = 2.0 * (state.fit.log_likelihood - in_full.fit.log_likelihood);
    let wild = count(rows.iter().filter(|row| far[**row]).count());
    let price = 2.0 * wild * libm::log(count(far.len()));
    let ahead = won.ahead - (excused - price).max(0.0);
    (MARGIN < ahead).then_some(Winner { ahead, ..won })
}

/// Rows in which an effect shows anything.
fn reach(problem: &Problem, state: &State, index: usize) -> Vec<usize> {
    let Some(shown) = shown(problem, state, index) else { return Vec::new() };
    let middle = middle(&mut shown.clone());
    let off = |row: &usize| (shown[*row] - middle).abs();
    let most = (0..shown.len()).map(|row| off(&row)).fold(0.0, f64::max);
    (0..shown.len()).filter(|row| WITHIN_REACH * most < off(row)).collect()
}
