//! Choices of an effect that were made beside other effects than those of the model.
//!
//! Which powers a curve has, which frequency a wave, which moment a jump, is chosen under the noise of its round.
//! What joins the model later, or leaves it, takes noise or a curve along that may have decided it; and what is of
//! known size may look as if it had another beside such a choice.

use super::acceptance::refusal;
use super::analysis::Step;
use super::judging::tried_of;
use super::known_together::of_known_size_alone;
use super::pruning::{Dropped, pruned};
use crate::model::{Judged, Problem, State, settle_beside};
use crate::policy::evidence::MARGIN;

/// Why an effect is taken out that comes again with other values.
const CHOSEN_AGAIN: &str = "other values explain more beside the others";

/// The step to a model one effect of which has other values, where those are clearly ahead beside the others; `None`
/// where each is as it would be chosen now.
pub(super) fn chosen_again(problem: &Problem, now: &State) -> Option<Step> {
    let (index, state) = with_other_values(problem, now, now.components.len())?;
    let name = &now.components[index].term.name;
    Some(step(problem, state, (name, name)))
}

/// The step to a model with an effect of known size more, which is accepted beside other values of one that the
/// model has.
pub(super) fn known_beside_other_values(problem: &Problem, now: &State) -> Option<Step> {
    let known = of_known_size_alone(problem, now);
    known.iter().find_map(|one| {
        let (index, state) = beside(problem, now, one)?;
        let names = (one.component.term.name.as_str(), now.components[index].term.name.as_str());
        Some(step(problem, state, names))
    })
}

fn step(problem: &Problem, state: State, (added, again): (&str, &str)) -> Step {
    let (state, dropped) = pruned(problem, state);
    let out = Dropped { name: again.to_owned(), reason: CHOSEN_AGAIN.to_owned() };
    Step::to(state, Some(added.to_owned()), [vec![out], dropped].concat())
}

/// One of the first effects of a model with other values beside all others, and which.
fn with_other_values(problem: &Problem, now: &State, first: usize) -> Option<(usize, State)> {
    if now.components.len() < 2 {
        return None;
    }
    // Of several of one name the next that is found is another choice already.
    let name = |index: usize| &now.components[index].term.name;
    let is_one = |index: &usize| {
        (0..now.components.len()).all(|other| other == *index || name(other) != name(*index))
    };
    let of = |index: usize| Some((index, chosen(problem, now, index)?));
    let log_likelihood = |one: &(usize, State)| one.1.fit.log_likelihood;
    (0..first)
        .filter(is_one)
        .filter_map(of)
        .max_by(|a, b| log_likelihood(a).total_cmp(&log_likelihood(b)))
}

/// A model with an effect more, and with other values of one that it had beside which that one is accepted.
fn beside(problem: &Problem, now: &State, one: &Judged) -> Option<(usize, State)> {
    let more = State::settled(problem, now.with(&one.component), &one.fit.noises)?;
    let (index, state) = with_other_values(problem, &more, now.components.len())?;
    let place = state.components.len() - 2;
    let others = state.settled_without(problem, &[place])?;
    let again = tried_of(problem, &others, (&one.component.term, &state.fit.noises))?;
    refusal(problem, &others, &again).is_none().then_some((index, state))
}

/// A model with an effect, the last of it then, as it is chosen beside all others, where that is clearly ahead.
fn chosen(problem: &Problem, now: &State, index: usize) -> Option<State> {
    let own = &now.components[index];
    let fewer = now.settled_without(problem, &[index])?;
    let best = tried_of(problem, &fewer, (&own.term, &now.fit.noises))?;
    let state = State::settled(problem, fewer.with(&best.component), &best.fit.noises)?;
    // Outliers have been marked since the model was fitted.
    let as_it_is = settle_beside(problem, &now.columns, &now.fit.noises, &best.fit.noises);
    let saved = own.price(problem) - best.component.price(problem);
    let ahead = 2.0 * (state.fit.log_likelihood - as_it_is.log_likelihood) + saved;
    (MARGIN < ahead && refusal(problem, &fewer, &best).is_none()).then_some(state)
}
