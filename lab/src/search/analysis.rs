//! The search for what a model lacks: round by round, until what is left is noise.

use std::collections::BTreeMap;

use helixlock_plant::Role;
use rayon::prelude::*;

use super::acceptance::refusal;
use super::court::shape_beside;
use super::likeness;
use super::pruning::{Dropped, pruned};
use super::refusal::Refusal;
use crate::hypotheses::{Candidate, Trial, candidates, setting_trials, try_candidate};
use crate::model::{
    Columns, Component, Fit, Judged, Problem, Stage, State, holdout_rms, noises_of, settle_beside,
    with_noise,
};
use crate::noise::{Noise, rms};
use crate::numerics::{chi_squared_tail, count, deviation};
use crate::policy::chance::NAMED;
use crate::policy::evidence::{MARGIN, SET_MARGIN};
use crate::policy::extent::{KNOWN_IN_SETS, MOST_ROUNDS, NEAR_THE_BEST, SHORTLIST};

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

/// The step from a model to the one with one effect more.
fn with_one_more(problem: &mut Problem, now: &State, best: &Judged) -> Option<Step> {
    let mut components = now.components.clone();
    components.push(best.component.clone());
    problem.mark_outliers(&best.fit.left);
    let state = State::settled(problem, components, &best.fit.noises)?;
    let (state, dropped) = pruned(problem, state);
    let name = &best.component.term.name;
    // What is dropped at once would only be found again.
    let again = dropped.iter().any(|one| one.name == *name);
    (!again).then(|| Step::to(state, Some(name.clone()), dropped))
}

fn go_on(problem: &mut Problem, steps: &mut Vec<Step>) {
    for _ in 0..MOST_ROUNDS {
        let last = steps.len() - 1;
        let now = &steps[last].state;
        let mut tried = tried(problem, now);
        let refused: Vec<Refusal> =
            tried.iter().map_while(|judged| refusal(problem, now, judged)).collect();
        for (judged, why) in tried.iter_mut().zip(&refused) {
            judged.p_value = why.chance().unwrap_or(judged.p_value);
        }
        let best = tried.get(refused.len()).cloned();
        if let Some(members) = known_together(problem, now, &tried) {
            steps[last].tried = tried;
            steps[last].refused = refused;
            add_together(problem, steps, members);
            continue;
        }
        let next = best.and_then(|best| with_one_more(problem, now, &best));
        steps[last].tried = tried;
        steps[last].refused = refused;
        let Some(next) = next else { break };
        steps.push(next);
    }
}

/// Adds the members of a set one a step.
fn add_together(problem: &mut Problem, steps: &mut Vec<Step>, members: Vec<Component>) {
    let bare = State::bare(problem).fit.noises;
    for member in members {
        let before = &steps[steps.len() - 1].state;
        let components = [before.components.clone(), vec![member.clone()]].concat();
        let Some(state) = State::settled(problem, components, &bare) else { return };
        let added = Some(member.term.name);
        steps.push(Step::to(state, added, Vec::new()));
    }
    let left = steps[steps.len() - 1].state.fit.left.clone();
    problem.mark_outliers(&left);
}

/// Several effects of known size that together beat every single effect.
///
/// Logged physics comes together: a warm day has weather too, and one part of it alone may fit
/// worse than none. Which of the sets it is, is chosen at the price of a number for each member.
/// Whether it is there at all is another question: their sizes are known, so that noise multiplies
/// the likelihood by `x` no oftener than once in `x` (Markov's inequality), and by as much in one
/// of `n` sets `n` times as often.
fn known_together(problem: &Problem, now: &State, tried: &[Judged]) -> Option<Vec<Component>> {
    let coloured = Stage::new(problem, &now.columns, &now.fit.noises);
    let known: Vec<Component> = candidates(&coloured, &now.components)
        .into_iter()
        .map(|candidate| Component::new(candidate.term))
        .filter(|component| {
            component.term.parameters.iter().any(|what| matches!(what.role, Role::Known { .. }))
                && now.components.iter().all(|other| other.term.name != component.term.name)
        })
        .collect();
    let price = problem.price_of_a_number();
    let single = tried.first().map_or(0.0, |best| best.evidence);
    let known = &known[..known.len().min(KNOWN_IN_SETS)];
    let sets = (1_usize..1 << known.len()).filter(|set| 1 < set.count_ones());
    let looks = 2.0 * libm::log(count(sets.clone().count().max(1)));
    let (_, gain, members) = sets
        .filter_map(|set| {
            let members: Vec<Component> = (0..known.len())
                .filter(|index| set & (1 << index) != 0)
                .map(|index| known[index].clone())
                .collect();
            let all = [now.components.clone(), members.clone()].concat();
            let columns = Columns::of_model(problem, &all).ok()?;
            let rough = with_noise(
                &problem.layout,
                &columns,
                &problem.residual(),
                &plain_noises(problem, &now.fit),
            );
            let state = State::of(problem, all, &noises_of(problem, &rough.left))?;
            let gain = 2.0 * (state.fit.log_likelihood - now.fit.log_likelihood);
            Some((gain - price * count(members.len()), gain, members))
        })
        .max_by(|a, b| a.0.total_cmp(&b.0))?;
    let least = (single.max(0.0) + SET_MARGIN).max(-2.0 * libm::log(NAMED));
    (least < gain - looks).then_some(members)
}

/// All candidates on what a model leaves, best evidence first.
#[must_use]
pub(crate) fn tried(problem: &Problem, now: &State) -> Vec<Judged> {
    let coloured = Stage::new(problem, &now.columns, &now.fit.noises);
    let white = Stage::new(problem, &now.columns, &plain_noises(problem, &now.fit));
    let first = judged_shortlist(problem, now, &[trials(&white, now), trials(&coloured, now)]);
    let Some(best) = first.first() else { return first };
    if best.fit.noises.iter().zip(&now.fit.noises).all(|(a, b)| a.is_like(b)) {
        return first;
    }
    // Under the noise that the best one leaves, its rivals show what they can really do.
    let clear = Stage::new(problem, &now.columns, &best.fit.noises);
    let again = trials(&clear, now);
    let mut all = judged_shortlist(problem, now, &[again]);
    for judged in first {
        let known =
            all.iter().position(|other| other.component.term.name == judged.component.term.name);
        match known {
            Some(place) if all[place].evidence < judged.evidence => all[place] = judged,
            Some(_) => {}
            None => all.push(judged),
        }
    }
    all.sort_by(|a, b| b.evidence.total_cmp(&a.evidence));
    all
}

/// The strongest trials under a stage's noise and all that come near them, largest gain first, and
/// how many there were.
fn trials(stage: &Stage<'_>, now: &State) -> (Vec<Trial>, usize) {
    let all = candidates(stage, &now.components);
    let of = |candidate| Some((Some(candidate), try_candidate(stage, candidate)?));
    let mut trials: Vec<(Option<&Candidate>, Trial)> = all.par_iter().filter_map(of).collect();
    trials.extend(setting_trials(stage).map(|trial| (None, trial)));
    trials.sort_by(|a, b| b.1.gain.total_cmp(&a.1.gain));
    let tried = trials.len();
    let best = trials.first().map_or(0.0, |(_, trial)| trial.gain);
    let near = |place: usize, trial: &Trial| place < SHORTLIST || NEAR_THE_BEST * best < trial.gain;
    let strongest = trials.into_iter().enumerate().filter(|(place, (_, one))| near(*place, one));
    let strongest: Vec<(Option<&Candidate>, Trial)> = strongest.map(|(_, one)| one).collect();
    let with_looks = |(candidate, trial): (Option<&Candidate>, Trial)| match candidate {
        Some(candidate) => trial.with_looks(stage, candidate),
        None => trial,
    };
    (strongest.into_par_iter().map(with_looks).collect(), tried)
}

/// Trials with their noise fitted anew, the best of each name.
fn judged_shortlist(problem: &Problem, now: &State, lists: &[(Vec<Trial>, usize)]) -> Vec<Judged> {
    let mut chosen: BTreeMap<String, Vec<&Trial>> = BTreeMap::new();
    for trial in lists.iter().flat_map(|(trials, _)| trials) {
        let known = chosen.entry(trial.component.term.name.clone()).or_default();
        if !known.iter().any(|other| trial.leaves_as_much_as(other)) {
            known.push(trial);
        }
    }
    let tried = count(lists.iter().map(|(_, tried)| *tried).max().unwrap_or(1).max(1));
    let flat: Vec<&Trial> = chosen.into_values().flatten().collect();
    let judged: Vec<Judged> =
        flat.into_par_iter().filter_map(|trial| judge(problem, now, trial, tried)).collect();
    let mut best: Vec<Judged> = Vec::new();
    for one in judged {
        match best.iter_mut().find(|other| other.component.term.name == one.component.term.name) {
            Some(other) if other.evidence < one.evidence => *other = one,
            Some(_) => {}
            None => best.push(one),
        }
    }
    best.sort_by(|a, b| b.evidence.total_cmp(&a.evidence));
    best
}

/// Joint fit, evidence, chance and held-out error of one trial.
fn judge(problem: &Problem, now: &State, trial: &Trial, tried: f64) -> Option<Judged> {
    let more = Columns::of(problem, std::slice::from_ref(&trial.component)).ok()?;
    // The noise begins with what the trial leaves, lest the first noise hides the effect.
    let left = more.left(&now.fit.left, &trial.coefficients);
    let columns = now.columns.and(&more);
    let start = noises_of(problem, &left);
    let fit = settle_beside(problem, &columns, &start, &now.fit.noises);
    let gain = 2.0 * (fit.log_likelihood - now.fit.log_likelihood);
    let freedom = trial.freedom();
    let price = problem.price_of_a_number();
    let looks = trial.places(gain);
    Some(Judged {
        component: trial.component.clone(),
        gain,
        evidence: gain
            - freedom * price
            - 2.0 * libm::log(looks)
            - likeness::price(&trial.component, &now.components),
        looks,
        p_value: (chi_squared_tail(gain, freedom) * looks.max(1.0) * tried).min(1.0),
        rms_um: rms(&problem.layout, &fit.left),
        holdout_rms_um: holdout_rms(problem, &columns, &fit.noises),
        fit,
    })
}

/// White noise of the size that neighbouring samples differ by: no slow effect hides in it.
pub(super) fn plain_noises(problem: &Problem, fit: &Fit) -> Vec<Noise> {
    (0..problem.sensors.len())
        .map(|sensor| {
            let blocks = problem.layout.blocks.iter().filter(|block| block.sensor == sensor);
            let mut steps: Vec<f64> = blocks
                .flat_map(|block| block.rows.clone().skip(1))
                .map(|row| (fit.left[row] - fit.left[row - 1]).abs())
                .collect();
            let deviation = deviation(&mut steps).max(f64::MIN_POSITIVE.sqrt());
            Noise::white().scaled(0.5 * deviation * deviation)
        })
        .collect()
}
