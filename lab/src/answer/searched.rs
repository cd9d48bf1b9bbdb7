//! A search on few rows, and what it has found on all.

use crate::hypotheses::{Structure, at_targets, between_ways};
use crate::model::{Problem, State};
use crate::numerics::in_parallel;
use crate::search::{
    Dropped, Step, left_at_targets, own_errors, polished, pruned_in_doubt, search, take_for_a_shape,
};

/// What a search has found, on few rows and on all.
pub(super) struct Searched {
    pub(super) small: Problem,
    pub(super) problem: Problem,
    pub(super) steps: Vec<Step>,
    pub(super) states: Vec<State>,
    /// What targets show at every visit, or each way, and no effect explains.
    pub(super) of_targets: Option<Structure>,
}

/// The search on so many rows, means of neighbours where there are more.
pub(super) fn search_on_all_rows(problem: &Problem, rows: usize) -> Searched {
    let mut small = problem.thinned(rows).unwrap_or_else(|| problem.clone());
    let mut steps = search(&mut small);
    let end = &steps[steps.len() - 1].state;
    let left = left_at_targets(problem, &small, end, at_targets);
    let mut of_targets = left.or_else(|| own_errors(&small, &steps));
    if of_targets.is_some() {
        small = small.with_targets_free();
        steps = search(&mut small);
    }
    let end = &steps[steps.len() - 1].state;
    if let Some(each_way) = left_at_targets(problem, &small, end, between_ways) {
        small = small.with_ways_free();
        steps = search(&mut small);
        of_targets = Some(each_way);
    }
    take_for_a_shape(&mut small, &mut steps);
    let (problem, mut states) = on_all_rows(problem, &small, &steps);
    if let Some(last) = states.pop() {
        states.push(polished(&problem, last));
    }
    let of_small = &steps[steps.len() - 1].state;
    if let Some((step, state)) = pruned_again(&problem, &small, of_small, &states[states.len() - 1])
    {
        steps.push(step);
        states.push(state);
    }
    Searched { small, problem, steps, states, of_targets }
}

/// Every state of a search fitted to all rows, outliers marked as the last one leaves them.
fn on_all_rows(problem: &Problem, small: &Problem, steps: &[Step]) -> (Problem, Vec<State>) {
    if small.samples.len() == problem.samples.len() {
        return (small.clone(), steps.iter().map(|step| step.state.clone()).collect());
    }
    let mut whole = problem.clone();
    let last = steps[steps.len() - 1].state.on(&whole).unwrap_or_else(|| State::bare(&whole));
    whole.mark_outliers(&last.fit.left);
    // The last noise is the one that no effect is left in: all begin with it.
    let near = |step: &Step| {
        State::of(&whole, step.state.components.clone(), &last.fit.noises)
            .unwrap_or_else(|| State::bare(&whole))
    };
    let states = in_parallel(steps, near);
    (whole, states)
}

/// One more step without the effects that all rows show to be superfluous, if there are any.
fn pruned_again(
    problem: &Problem,
    small: &Problem,
    of_small: &State,
    last: &State,
) -> Option<(Step, State)> {
    let (state, dropped) = pruned_in_doubt(problem, last, (small, of_small));
    if dropped.is_empty() {
        return None;
    }
    without_dropped(small, state, dropped)
}

/// A step to a state of all rows that some effects were taken out of.
pub(super) fn without_dropped(
    small: &Problem,
    state: State,
    dropped: Vec<Dropped>,
) -> Option<(Step, State)> {
    Some((Step::to(state.on(small)?, None, dropped), state))
}
