//! Effects judged on what a model leaves: the strongest trials, their noise fitted anew.

use std::collections::{BTreeMap, BTreeSet};

use helixlock_plant::{Search, Term};

use super::acceptance::at_an_end;
use super::likeness;
use super::starts::worth_alone;
use crate::hypotheses::{
    Candidate, Trial, candidates, candidates_like, setting_trials, try_candidate,
};
use crate::model::{
    Columns, Judged, Problem, Stage, State, holdout_rms, noises_of, plain_noises, settle_beside,
};
use crate::noise::{Noise, rms};
use crate::numerics::{chi_squared_tail, count, in_parallel};
use crate::policy::chance::NAMED;
use crate::policy::extent::{NEAR_THE_BEST, SHORTLIST};

/// All candidates on what a model leaves, best evidence first.
#[must_use]
pub(crate) fn tried(problem: &Problem, now: &State) -> Vec<Judged> {
    let coloured = Stage::new(problem, &now.columns, &now.fit.noises);
    let white = Stage::new(problem, &now.columns, &plain_noises(problem, &now.fit.left));
    let first = judged_shortlist(problem, now, &[trials(&white, now), trials(&coloured, now)]);
    let Some(best) = first.first() else { return first };
    if best.fit.noises.iter().zip(&now.fit.noises).all(|(a, b)| a.is_like(b)) {
        return first;
    }
    // Under the noise that the best one leaves, its rivals show what they can really do.
    let clear = Stage::new(problem, &now.columns, &best.fit.noises);
    let again = trials(&clear, now);
    let all = judged_shortlist(problem, now, &[again]).into_iter().chain(first);
    best_of_each_name(problem, now, all)
}

/// The best of the candidates that are the same effect as one, on what a model leaves.
#[must_use]
pub(crate) fn tried_of(problem: &Problem, now: &State, like: (&Term, &[Noise])) -> Option<Judged> {
    best_of_each_name(problem, now, ways_of(problem, now, like).into_iter()).into_iter().next()
}

/// All candidates that are the same effect as one, on what a model leaves; where to look is told by the noise that is
/// left with such an effect.
#[must_use]
pub(super) fn ways_of(
    problem: &Problem,
    now: &State,
    (term, noises): (&Term, &[Noise]),
) -> Vec<Judged> {
    let stages = [noises, &plain_noises(problem, &now.fit.left)];
    let lists = stages.map(|noises| {
        let stage = Stage::new(problem, &now.columns, noises);
        strongest(&stage, &candidates_like(&stage, &now.components, term), None)
    });
    judged(problem, now, &lists)
}

/// The strongest trials under a stage's noise of all there are.
fn trials(stage: &Stage<'_>, now: &State) -> (Vec<Trial>, usize) {
    strongest(stage, &candidates(stage, &now.components), setting_trials(stage))
}

/// The strongest trials of candidates and of a setting, and all that come near them, largest gain first, and of how
/// many effects there were any: one that is looked for in several ways pays for them by itself.
fn strongest(
    stage: &Stage<'_>,
    all: &[Candidate],
    of_setting: Option<Trial>,
) -> (Vec<Trial>, usize) {
    let of = |candidate| Some((Some(candidate), try_candidate(stage, candidate)?));
    let mut trials: Vec<(Option<&Candidate>, Trial)> =
        in_parallel(all, of).into_iter().flatten().collect();
    trials.extend(of_setting.map(|trial| (None, trial)));
    trials.sort_by(|a, b| b.1.gain.total_cmp(&a.1.gain));
    let name = |trial: &Trial| trial.component.term.name.clone();
    let tried = trials.iter().map(|(_, trial)| name(trial)).collect::<BTreeSet<_>>().len();
    let best = trials.first().map_or(0.0, |(_, trial)| trial.gain);
    // One effect that is looked for in several ways takes the place of no other.
    let mut names = BTreeSet::new();
    let mut is_near = |trial: &Trial| {
        let before = names.len();
        names.insert(name(trial));
        before < SHORTLIST || NEAR_THE_BEST * best < trial.gain
    };
    trials.retain(|(_, trial)| is_near(trial));
    let with_looks = |(candidate, trial): (Option<&Candidate>, Trial)| match candidate {
        Some(candidate) => trial.with_looks(stage, candidate),
        None => trial,
    };
    (in_parallel(trials, with_looks), tried)
}

/// Trials with their noise fitted anew, the best of each name.
fn judged_shortlist(problem: &Problem, now: &State, lists: &[(Vec<Trial>, usize)]) -> Vec<Judged> {
    best_of_each_name(problem, now, judged(problem, now, lists).into_iter())
}

/// Trials with their noise fitted anew, but for those that leave what another of their name leaves.
fn judged(problem: &Problem, now: &State, lists: &[(Vec<Trial>, usize)]) -> Vec<Judged> {
    let mut chosen: BTreeMap<String, Vec<&Trial>> = BTreeMap::new();
    for trial in lists.iter().flat_map(|(trials, _)| trials) {
        let known = chosen.entry(trial.component.term.name.clone()).or_default();
        if !known.iter().any(|other| trial.leaves_as_much_as(other)) {
            known.push(trial);
        }
    }
    let tried = count(lists.iter().map(|(_, tried)| *tried).max().unwrap_or(1).max(1));
    let flat = chosen.into_values().flatten();
    let judged = in_parallel(flat, |trial| judge(problem, now, trial, tried));
    judged.into_iter().flatten().collect()
}

/// The best of each name, best evidence first.
fn best_of_each_name(
    problem: &Problem,
    now: &State,
    all: impl Iterator<Item = Judged>,
) -> Vec<Judged> {
    let mut of_name: BTreeMap<String, Vec<Judged>> = BTreeMap::new();
    for one in all {
        of_name.entry(one.component.term.name.clone()).or_default().push(one);
    }
    let best = of_name.into_values().map(|mut ways| {
        ways.sort_by(|a, b| b.evidence.total_cmp(&a.evidence));
        let place = ways.iter().position(|one| stands_for(problem, now, one, &ways[0]));
        ways.swap_remove(place.unwrap_or(0))
    });
    let mut best: Vec<Judged> = best.collect();
    best.sort_by(|a, b| b.evidence.total_cmp(&a.evidence));
    best
}

/// True of a form of an effect that may be named, and is the clearest or taken up at once. Play is no less there because
/// a way as long as the stroke follows a bow as well.
fn stands_for(problem: &Problem, now: &State, one: &Judged, clearest: &Judged) -> bool {
    (is_at_once(&one.component.term) || std::ptr::eq(one, clearest))
        && one.p_value < NAMED
        && at_an_end(problem, now, one).is_none()
}

/// True of an effect that takes a way to be taken up elsewhere, and none here.
fn is_at_once(term: &Term) -> bool {
    term.parameters.iter().any(|what| what.of_way && what.search == Search::Fixed)
}

/// Joint fit, evidence, chance and held-out error of one trial.
fn judge(problem: &Problem, now: &State, trial: &Trial, tried: f64) -> Option<Judged> {
    let more = Columns::of(problem, std::slice::from_ref(&trial.component)).ok()?;
    // The noise begins with what the trial leaves, lest the first noise hides the effect.
    let left = more.left(&now.fit.left, &trial.coefficients);
    let columns = now.columns.and(&more);
    let start = noises_of(problem, &left);
    let fit = settle_beside(problem, &columns, &start, &now.fit.noises);
    let alone = worth_alone(problem, now, &trial.component, &fit.noises);
    let gain = 2.0 * (fit.log_likelihood - now.fit.log_likelihood) - alone;
    let freedom = trial.freedom();
    let looks = trial.places(gain);
    Some(Judged {
        component: trial.component.clone(),
        gain,
        evidence: gain
            - trial.component.price(problem)
            - 2.0 * libm::log(looks)
            - likeness::price(&trial.component, &now.components),
        looks,
        tried,
        p_value: (chi_squared_tail(gain, freedom) * looks.max(1.0) * tried).min(1.0),
        rms_um: rms(&problem.layout, &fit.left),
        holdout_rms_um: holdout_rms(problem, &columns, &fit.noises),
        fit,
    })
}
