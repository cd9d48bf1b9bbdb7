//! The search for what a model lacks: round by round, until what is left is noise.

use super::acceptance::refusal;
use super::chosen_again::{chosen_again, known_beside_other_values};
use super::court::shape_beside;
use super::judging::tried;
use super::known_together::known_together;
use super::pruning::{Dropped, pruned};
use super::refusal::Refusal;
use super::together::{Together, instead, together};
use crate::model::{Component, Judged, Problem, State};
use crate::policy::evidence::MARGIN;
use crate::policy::extent::MOST_ROUNDS;

/// Everything that happened in one round.
#[derive(Debug, Clone)]
pub(crate) struct Step {
    /// The state after it.
    pub(crate) state: State,
    /// Effects tried, best first.
    pub(crate) tried: Vec<Judged>,
    /// Why the first ones of those were not taken, in their order.
    pub(crate) refused: Vec<Refusal>,
    /// Name of the effect added.
    pub(crate) added: Option<String>,
    /// Effects that became superfluous.
    pub(crate) dropped: Vec<Dropped>,
}

impl Step {
    /// A step to a state, nothing tried on it yet.
    pub(crate) fn to(state: State, added: Option<String>, dropped: Vec<Dropped>) -> Self {
        Self { state, tried: Vec::new(), refused: Vec::new(), added, dropped }
    }
}

/// Looks for effects until none is significant; every step begins where the last one ended.
///
/// Outliers are marked anew whenever the model has changed, so that no effect passes for them.
#[must_use]
pub(crate) fn search(problem: &mut Problem) -> Vec<Step> {
    let bare = State::bare(problem);
    let mut steps = vec![Step::to(bare, None, Vec::new())];
    go_on(problem, &mut steps);
    steps
}

/// Takes the effect that noise might do as much as, where it explains more than a shape without a
/// name that noise does not, and goes on.
///
/// Such a shape says that something is there: what remains to be asked is what it is.
pub(crate) fn take_for_a_shape(problem: &mut Problem, steps: &mut Vec<Step>) {
    let end = steps.len() - 1;
    let last = &steps[end];
    let by_chance = last.tried.iter().zip(&last.refused).position(|(judged, why)| {
        matches!(why, Refusal::Chance { .. }) && MARGIN < judged.evidence
    });
    let Some(place) = by_chance else { return };
    let Some(shape) = shape_beside(problem, &last.state) else { return };
    let best = Judged { p_value: shape.shown.p_value, ..last.tried[place].clone() };
    if best.evidence <= shape.ahead {
        return;
    }
    if let Some(step) = with_one_more(problem, &last.state, &best) {
        steps[end].tried[place] = best;
        steps.push(step);
        go_on(problem, steps);
    }
}

/// What was tried beside the effects of the last model, though others may have come and gone since.
#[must_use]
pub(crate) fn tried_beside(steps: &[Step]) -> &[Judged] {
    let names = |step: &Step| -> Vec<String> {
        step.state.components.iter().map(|one| one.term.name.clone()).collect()
    };
    let last = steps.last().map(names);
    let same = |step: &&Step| !step.tried.is_empty() && Some(names(step)) == last;
    steps.iter().rfind(same).map_or(&[], |step| &step.tried)
}

/// The step from a model to the one with effects more, the last of which is judged beside the others;
/// `None`, and outliers marked as before, where one of them is dropped at once: it would only be found again.
fn with_more(problem: &mut Problem, names: &[&str], now: &State, last: &Judged) -> Option<Step> {
    let marks = problem.layout.inflation.clone();
    problem.mark_outliers(&last.fit.left);
    let state = State::settled(problem, now.with(&last.component), &last.fit.noises);
    let stays = |dropped: &[Dropped]| dropped.iter().all(|one| !names.contains(&one.name.as_str()));
    let next = state.map(|state| pruned(problem, state)).filter(|(_, dropped)| stays(dropped));
    if next.is_none() {
        problem.layout.inflation = marks;
    }
    next.map(|(state, dropped)| Step::to(state, Some(last.component.term.name.clone()), dropped))
}

/// The step from a model to the one with one effect more.
fn with_one_more(problem: &mut Problem, now: &State, best: &Judged) -> Option<Step> {
    with_more(problem, &[&best.component.term.name], now, best)
}

/// The steps from a model to the one with several effects more.
fn with_all(problem: &mut Problem, all: &Together) -> Option<Vec<Step>> {
    let (_, before) = all.firsts.last()?;
    let end = with_more(problem, &all.names(), before, &all.last)?;
    let to = |(one, state): &(Judged, State)| {
        Step::to(state.clone(), Some(one.component.term.name.clone()), Vec::new())
    };
    Some(all.firsts.iter().map(to).chain([end]).collect())
}

fn go_on(problem: &mut Problem, steps: &mut Vec<Step>) {
    for _ in 0..MOST_ROUNDS {
        if let Some(step) = chosen_again(problem, &steps[steps.len() - 1].state) {
            take(problem, steps, step);
        }
        let last = steps.len() - 1;
        let now = &steps[last].state;
        let mut tried = tried(problem, now);
        let mut refused = first_refused(problem, now, &mut tried, 0);
        let best = tried.get(refused.len()).cloned();
        if let Some(members) = known_together(problem, now, &tried) {
            steps[last].tried = tried;
            steps[last].refused = refused;
            add_together(problem, steps, members);
            continue;
        }
        let mut next = next(problem, now, best.as_ref(), &tried);
        if next.is_empty() && best.is_some() {
            // What is dropped at once stands before no other.
            refused.push(Refusal::AtOnce);
            refused.extend(first_refused(problem, now, &mut tried, refused.len()));
            let second = tried.get(refused.len());
            next.extend(second.and_then(|one| with_one_more(problem, now, one)));
        }
        steps[last].tried = tried;
        steps[last].refused = refused;
        if !next.is_empty() {
            steps.extend(next);
            continue;
        }
        let Some(step) = known_beside_other_values(problem, &steps[last].state) else { break };
        take(problem, steps, step);
    }
}

/// Goes to another model of the same record, beside which other readings may be outliers.
fn take(problem: &mut Problem, steps: &mut Vec<Step>, step: Step) {
    problem.mark_outliers(&step.state.fit.left);
    steps.push(step);
}

/// Why the first of the effects tried from a place on are not taken; those have the chance of it.
fn first_refused(
    problem: &Problem,
    now: &State,
    tried: &mut [Judged],
    from: usize,
) -> Vec<Refusal> {
    let rest = &mut tried[from..];
    let refused: Vec<Refusal> =
        rest.iter().map_while(|judged| refusal(problem, now, judged)).collect();
    for (judged, why) in rest.iter_mut().zip(&refused) {
        judged.p_value = why.chance().unwrap_or(judged.p_value);
    }
    refused
}

/// The steps to the model with the best effect more, or with several where they explain what it bends to, or where
/// there is none; none where there is nothing more.
fn next(problem: &mut Problem, now: &State, best: Option<&Judged>, tried: &[Judged]) -> Vec<Step> {
    let two = best.and_then(|best| instead(problem, now, best, tried));
    if let Some(steps) = two.and_then(|two| with_all(problem, &two)) {
        return steps;
    }
    if let Some(step) = best.and_then(|best| with_one_more(problem, now, best)) {
        return vec![step];
    }
    let all = together(problem, now, tried);
    all.and_then(|all| with_all(problem, &all)).unwrap_or_default()
}

/// Adds the members of a set one a step.
fn add_together(problem: &mut Problem, steps: &mut Vec<Step>, members: Vec<Component>) {
    let bare = State::bare(problem).fit.noises;
    for member in members {
        let before = &steps[steps.len() - 1].state;
        let Some(state) = State::settled(problem, before.with(&member), &bare) else { return };
        let added = Some(member.term.name);
        steps.push(Step::to(state, added, Vec::new()));
    }
    let left = steps[steps.len() - 1].state.fit.left.clone();
    problem.mark_outliers(&left);
}
