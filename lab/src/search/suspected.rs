//! Mistakes of input against the effects that were found: what a shifted zero explains with one number,
//! waves explain with two for each.

use super::court::{Court, groups};
use super::polish::polished;
use super::rivals::Rivals;
use crate::doubts::{Doubt, Suspect};
use crate::hypotheses::structures;
use crate::model::{Problem, State};
use crate::policy::evidence::MARGIN;

/// What mistakes have to say against a model.
#[derive(Debug, Default)]
pub(crate) struct Suspected {
    /// The mistake that is farthest ahead of the effects in whose place it stands.
    pub(crate) doubt: Option<Doubt>,
    /// What explains as much as an effect, by its place in the model.
    pub(crate) witnesses: Vec<(usize, String)>,
}

/// Holds mistakes against the effects of a model, each in the place of none, of one, of several and of all.
///
/// All that the data hold has been searched for by now: a mistake that leaves more than noise is told of no one.
#[must_use]
pub(crate) fn suspected(
    problem: &Problem,
    state: &State,
    found: &[Rivals],
    suspects: &[Suspect],
) -> Suspected {
    let court = Court::new(problem, state, found, &[], (0, 0.0));
    let mut said = Suspected::default();
    for suspect in suspects {
        let Some(mended) = mended(problem, suspect) else { continue };
        let Some(best) = best_in_place(&court, suspect, &mended) else { continue };
        let farthest = said.doubt.as_ref().map_or(MARGIN, |doubt| doubt.evidence);
        let leaves_noise = || structures(&mended, &best.state.columns, &best.state.fit).is_empty();
        if farthest < best.ahead && leaves_noise() {
            said.doubt = Some(Doubt { evidence: best.ahead, ..suspect.doubt.clone() });
        } else if best.ahead.abs() <= MARGIN {
            let says = || suspect.doubt.says.clone();
            said.witnesses.extend(best.beaten.iter().map(|&index| (index, says())));
        }
    }
    said
}

/// A problem with a mistake put right.
fn mended(problem: &Problem, suspect: &Suspect) -> Option<Problem> {
    let predicted = problem.predicted.iter().zip(&suspect.change).map(|(said, by)| said + by);
    let mended = Problem {
        predicted: predicted.collect::<Vec<f64>>().into(),
        observed: problem.observed.clone(),
        layout: problem.layout.clone(),
        free: problem.free.clone(),
        starts: problem.starts,
        ..suspect.mended.clone()
    };
    mended.has_samples_of(problem).then_some(mended)
}

/// A mistake in the place of effects.
struct Mended {
    /// By how much it is ahead of them.
    ahead: f64,
    /// Their places in the model.
    beaten: Vec<usize>,
    /// What is left of the model then.
    state: State,
}

/// The mistake where it is farthest ahead.
fn best_in_place(court: &Court<'_>, suspect: &Suspect, mended: &Problem) -> Option<Mended> {
    let of = |in_place_of: Vec<usize>| {
        let fewer = court.state.without(&in_place_of);
        let state = State::settled(mended, fewer, &court.state.fit.noises)?;
        let state = polished(mended, state);
        let listed = if in_place_of.is_empty() { suspect.listed } else { 0.0 };
        let ahead = court.ahead(&in_place_of, &state.fit) - suspect.price - listed;
        let ahead = ahead.min(suspect.of_one_sensor);
        Some(Mended { ahead, beaten: in_place_of, state })
    };
    groups(court.state.components.len())
        .into_iter()
        .filter_map(of)
        .max_by(|a, b| a.ahead.total_cmp(&b.ahead))
}
