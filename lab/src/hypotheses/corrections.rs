//! The machine file's own effects at other values.
//!
//! What was true of a machine when its file was written need not be true today. An effect of the file with
//! another size, phase, time or width takes the place of the one that stands there.

use helixlock_plant::{Entry, Formula, Parameter, Role, Search, Term};

use super::candidates::{Candidate, axis, in_motion, on_axes};
use crate::model::{Component, Stage};

/// Every effect of the file that no component of a model stands in for yet, at another size, and at any values it
/// may have.
///
/// A harmonic, a gear, a place and a moment remain what they are: another one is another effect.
pub(super) fn corrections(stage: &Stage<'_>, found: &[Component]) -> Vec<Candidate> {
    let problem = stage.problem;
    let is_free = |place: &usize| found.iter().all(|one| one.term.instead_of != Some(*place));
    let effects = problem.model.effects.iter().enumerate();
    effects
        .filter(|(place, term)| is_free(place) && is_correctable(term) && problem.sees(term.entry))
        .flat_map(|(place, term)| {
            let term = Term { instead_of: Some(place), ..term.clone() };
            let nonlinear = term.parameters.iter().filter(|what| what.is_nonlinear());
            let with_values = nonlinear.zip(term.nonlinear());
            let axes =
                with_values.map(|(what, value)| values(stage, term.entry, what, value)).collect();
            let any = on_axes(stage, term.clone(), axes);
            let moving = any.as_ref().and_then(|any| in_motion(stage, any));
            [in_size(stage, term), any, moving]
        })
        .flatten()
        .collect()
}

/// An effect of the file in another size, all else as the file says.
fn in_size(stage: &Stage<'_>, mut term: Term) -> Option<Candidate> {
    let own = term.nonlinear().into_iter().map(|value| vec![value]).collect();
    let nonlinear = term.parameters.iter_mut().filter(|what| what.is_nonlinear());
    nonlinear.for_each(|what| what.search = Search::Fixed);
    on_axes(stage, term, own)
}

/// True for an effect of the catalogue whose sizes neither physics nor counting fixes.
pub(super) fn is_correctable(term: &Term) -> bool {
    let is_fixed =
        |what: &Parameter| matches!(what.role, Role::Known { .. }) || what.name == "count";
    matches!(term.formula, Formula::Card(card) if card.candidate && !card.random)
        && !term.nature().is_setting()
        && !term.parameters.iter().any(is_fixed)
}

/// Values of a nonlinear parameter to be tried, the file's own among them.
fn values(stage: &Stage<'_>, entry: Entry, what: &Parameter, own: f64) -> Vec<f64> {
    let varies =
        matches!(what.search, Search::Linear | Search::Logarithmic) && !what.is_frequency();
    let mut values = if varies { axis(stage, entry, what) } else { Vec::new() };
    values.push(own);
    values.sort_by(f64::total_cmp);
    values.dedup();
    values
}
