//! The answer: what is missing in a model, how sure that is, and what would make it surer.

use std::collections::BTreeSet;

use helixlock_plant::{Role, Search, Term};

use super::experiment::{self, Advice};
use super::far_readings::{FarReadings, far_readings};
use super::harmonics::one_of_several;
use super::loud_passes::{LoudPass, loud_passes};
use super::searched::{Searched, search_on_all_rows, without_dropped};
use crate::doubts::{Doubt, Suspect, doubts_and_suspects};
use crate::hypotheses::{
    Disagreement, Likelihood, Structure, disagreements, no_all_clear, no_larger_than,
    samples_a_pass, slow_or_smooth, structures, waves_left,
};
use crate::model::{
    Component, JointCovariance, Judged, Problem, State, holdout_rms, told_covariances,
};
use crate::noise::rms;
use crate::numerics::least_squares::covariance_rows;
use crate::policy::chance::{AT_AN_END, STANDARD_ERRORS};
use crate::policy::extent::{COARSER, COMPARED_ROWS, FEWEST_COARSE, SEARCHED_ROWS, STEPPED_ROWS};
use crate::search::{
    Dropped, Refusal, Rivals, Step, at_flanks, come_again, errors_of_counts, hear, nobodys,
    not_told, one_cause, one_comb, pruned, rivals, running_off, suspected, tried_beside,
    unlisted_order, untold,
};

/// What can be said about a model and a measurement.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// Effects were found, and what they leave is noise.
    Explained,
    /// Two or more effects explain the data alike.
    Ambiguous,
    /// Structure is left that no effect accounts for.
    Unexplained,
    /// The model leaves nothing but noise.
    NothingMissing,
    /// The data or the machine file look mistaken; no effect is named.
    DoubtfulInput,
}

impl Verdict {
    /// As results spell it.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Explained => "explained",
            Self::Ambiguous => "ambiguous",
            Self::Unexplained => "unexplained",
            Self::NothingMissing => "nothing-missing",
            Self::DoubtfulInput => "doubtful-input",
        }
    }
}

/// A fitted parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct FittedParameter {
    /// Name with unit.
    pub key: String,
    /// Value in that unit.
    pub value: f64,
    /// Standard error under the noise model; `None` for numbers that were chosen from a list.
    pub stderr: Option<f64>,
    /// Why the value should not be trusted as it is, if so.
    pub warning: Option<&'static str>,
    /// What the machine file says, where it has the effect already.
    pub file_says: Option<f64>,
}

/// An effect with its fitted parameters.
#[derive(Debug, Clone)]
pub struct FittedEffect {
    /// Name of the effect.
    pub name: String,
    /// The effect with its values, ready for a machine file.
    pub term: Term,
    /// Its parameters.
    pub parameters: Vec<FittedParameter>,
}

/// One round of the search.
#[derive(Debug, Clone)]
pub struct Round {
    /// From 0, the model as it was.
    pub round: usize,
    /// Effect added.
    pub added: Option<String>,
    /// Effects that became superfluous by it.
    pub dropped: Vec<String>,
    /// Root mean square of the residual about the zero of each pass.
    pub rms_um: f64,
    /// The same on held-out data.
    pub holdout_rms_um: f64,
    /// Chance of the added effect in noise.
    pub p_value: Option<f64>,
    /// The model after the round: every added effect with its parameters.
    pub effects: Vec<FittedEffect>,
    /// Effects tried next and not taken, with the reason.
    pub rejected: Vec<(String, String)>,
}

/// An effect that was tried.
#[derive(Debug, Clone)]
pub struct Ranked {
    /// Name of the effect.
    pub name: String,
    /// True when it is part of the final model.
    pub accepted: bool,
    /// Root mean square left when it alone is added.
    pub rms_um: f64,
    /// The same on held-out data.
    pub holdout_rms_um: f64,
    /// Chance in noise, corrected for the number tried.
    pub p_value: f64,
    /// Evidence against the best one, in units of twice the log likelihood; 0 is best.
    pub behind: f64,
    /// Names the data cannot tell from it.
    pub confounded_with: Vec<String>,
    /// Experiment that would tell.
    pub separate_by: Option<String>,
}

/// The whole answer.
#[derive(Debug, Clone)]
pub struct Diagnosis {
    /// The verdict.
    pub verdict: Verdict,
    /// What looks mistaken, by evidence; empty but for [`Verdict::DoubtfulInput`].
    pub doubts: Vec<Doubt>,
    /// Size of what the final model leaves as noise, µm (arcsec).
    pub noise_um: f64,
    /// Independent samples that a pass of that noise is worth: few, and slow causes may be in it.
    pub samples_a_pass: f64,
    /// Readings that lie far from the rest and weigh little, if there are any.
    pub far_readings: Option<FarReadings>,
    /// Passes that weigh less.
    pub loud_passes: Vec<LoudPass>,
    /// Rounds of the search, the first without any effect.
    pub rounds: Vec<Round>,
    /// Effects tried, those of the final model first.
    pub candidates: Vec<Ranked>,
    /// What the final model leaves that is not noise.
    pub residual: Vec<Structure>,
    /// Experiments that would separate, best first.
    pub experiments: Vec<Advice>,
    /// What the final model leaves, row by row.
    pub left: Vec<f64>,
    /// The residual of the file's model, for pictures.
    pub before: Vec<f64>,
    /// The final model.
    pub(crate) accepted: State,
}

/// Diagnoses a problem.
///
/// Mistakes of input come first: with one of them nothing is searched for.
/// The search works on at most a few thousand rows, means of neighbours where there are more; effects
/// and what they leave are fitted to all rows, and what was tried beside them is told with the
/// scatter that means hide. Where structure is left the search is made once more on far fewer: waves that are
/// short against a turn make noise so loud from row to row that it draws any long one.
#[must_use]
pub fn diagnose(problem: &Problem) -> Diagnosis {
    let (doubts, suspects) = doubts_and_suspects(problem);
    if !doubts.is_empty() {
        return doubtful(problem, doubts);
    }
    let searched = search_on_all_rows(problem, SEARCHED_ROWS);
    let fine = answered(searched, &suspects, SEARCHED_ROWS);
    let rows = problem.samples.len().min(SEARCHED_ROWS) / COARSER;
    if fine.verdict != Verdict::Unexplained || rows < FEWEST_COARSE {
        return fine;
    }
    // What follows a search takes effects out and adds none.
    let searched = search_on_all_rows(problem, rows);
    if !fine.may_grow_to(&searched) {
        return fine;
    }
    let coarse = answered(searched, &suspects, rows);
    if coarse.adds_to(&fine) { coarse } else { fine }
}

impl Diagnosis {
    /// True when it has all names that another one has, each as often, and waves beside them: of a curve at one
    /// place, few rows do not tell what is left beside it, nor which shape has a wave.
    fn adds_to(&self, known: &Self) -> bool {
        let more = known.missing_of(self.last_effects().iter().collect(), |effect| &effect.name);
        let is_new = |one: &&FittedEffect| one.term.is_wave() && !known.has_beaten(&one.name);
        more.is_some_and(|more| !more.is_empty() && more.iter().all(is_new))
    }

    /// True when a shape without a name stands in the place of such an effect.
    fn has_beaten(&self, name: &str) -> bool {
        let rejected = self.rounds.iter().flat_map(|round| &round.rejected);
        rejected.into_iter().any(|(other, reason)| other == name && reason == BEATEN)
    }

    /// True when a search has found all of its names and more.
    fn may_grow_to(&self, searched: &Searched) -> bool {
        let found = searched.steps.last().map_or(&[][..], |last| &last.state.components);
        let more = self.missing_of(found.iter().collect(), |component| &component.term.name);
        more.is_some_and(|more| !more.is_empty())
    }

    /// Those of a list whose names it lacks, each as often; `None` where the list lacks one of its own.
    fn missing_of<'a, T>(&self, list: Vec<&'a T>, name: fn(&T) -> &str) -> Option<Vec<&'a T>> {
        let mut more = list;
        for effect in self.last_effects() {
            let place = more.iter().position(|other| name(other) == effect.name)?;
            more.swap_remove(place);
        }
        Some(more)
    }

    /// Effects of the final model.
    fn last_effects(&self) -> &[FittedEffect] {
        self.rounds.last().map_or(&[], |last| &last.effects)
    }
}

/// What a diagnosis accepts, where a search on fewer rows finds waves that are not among some effects.
#[must_use]
pub(crate) fn accepted_beyond(problem: &Problem, known: &[FittedEffect]) -> Option<State> {
    let rows = problem.samples.len().min(SEARCHED_ROWS) / COARSER;
    if rows < FEWEST_COARSE {
        return None;
    }
    let is_same =
        |one: &Term, other: &Term| one.name == other.name && one.nonlinear() == other.nonlinear();
    let is_known = |term: &Term| known.iter().any(|effect| is_same(&effect.term, term));
    let is_new_wave = |one: &Component| one.term.is_wave() && !is_known(&one.term);
    let searched = search_on_all_rows(problem, rows);
    searched.steps.last()?.state.components.iter().any(is_new_wave).then_some(())?;
    let accepted = diagnose(problem).accepted;
    accepted.components.iter().any(is_new_wave).then_some(accepted)
}

/// The diagnosis of mistaken input: the model as it is, and nothing added.
fn doubtful(problem: &Problem, doubts: Vec<Doubt>) -> Diagnosis {
    let steps = [Step::to(State::bare(problem), None, Vec::new())];
    let state = steps[0].state.clone();
    Diagnosis {
        verdict: Verdict::DoubtfulInput,
        doubts,
        noise_um: rms(&problem.layout, &state.fit.left),
        samples_a_pass: samples_a_pass(problem, &state.fit),
        far_readings: far_readings(problem, &state.fit.left),
        loud_passes: loud_passes(problem),
        rounds: rounds(problem, &steps, std::slice::from_ref(&state)),
        candidates: Vec::new(),
        residual: Vec::new(),
        experiments: Vec::new(),
        left: state.fit.left.clone(),
        before: problem.residual(),
        accepted: state,
    }
}

/// The answer that a search on so many rows leads to.
fn answered(searched: Searched, suspects: &[Suspect], rows: usize) -> Diagnosis {
    let Searched { small, problem, mut steps, mut states, of_targets } = searched;
    let last = &steps[steps.len() - 1].state;
    let mut found = rivals(&small, last, &steps[0].tried);
    let mut residual = structures(&small, &last.columns, &last.fit);
    let of_small = residual.len();
    let heard = hear(&small, last, &found);
    let suspected = suspected(&small, last, &found, suspects);
    if let Some(doubt) = suspected.doubt {
        return doubtful(&problem, vec![doubt]);
    }
    residual.extend(nobodys(&small, &steps));
    if residual.is_empty() {
        residual.extend(slow_or_smooth(&small, last, tried_beside(&steps)));
    }
    confuse(&mut found, heard.witnesses.into_iter().chain(suspected.witnesses));
    let problems = (&problem, &small);
    let asked = || at_flanks(&small, last, &found).or_else(|| come_again(&small, last, &found));
    let first =
        [heard.winner, one_cause(&small, last, &found), unlisted_order(&small, last, &found)];
    let first = first.into_iter().flatten().max_by(|a, b| a.ahead.total_cmp(&b.ahead));
    if let Some(winner) = first.or_else(asked) {
        found = take_out(problems, (&mut steps, &mut states), (&winner.beaten, BEATEN), found);
        residual.push(winner.shown);
    }
    let differing;
    (found, differing) = without_denied(problems, (&mut steps, &mut states), found);
    residual.extend(differing);
    found = without_untold(problems, (&mut steps, &mut states), &mut residual, found);
    let last = &steps[steps.len() - 1].state;
    let experiments = experiment::advice(&small, last, &found);
    let state = &states[states.len() - 1];
    let noise_um = rms(&problem.layout, &state.fit.left);
    let mut candidates = ranked(state, &found, &steps[0].tried, &experiments);
    let of_means_um = rms(&small.layout, &last.fit.left);
    if residual.is_empty() {
        residual.extend(thinned_away(&problem, &small, last));
    }
    if rows < SEARCHED_ROWS {
        residual.splice(..of_small, left_on_more_rows(&problem, last));
    }
    no_larger_than(noise_um, &mut residual);
    residual.extend(of_targets);
    residual.extend(no_all_clear(&problem, state, &residual));
    add_scatter(&mut candidates, (noise_um * noise_um - of_means_um * of_means_um).max(0.0));
    Diagnosis {
        verdict: verdict(state, &found, &residual),
        doubts: Vec::new(),
        noise_um,
        samples_a_pass: samples_a_pass(&problem, &state.fit),
        far_readings: far_readings(&problem, &state.fit.left),
        loud_passes: loud_passes(&problem),
        rounds: rounds(&problem, &steps, &states),
        candidates,
        residual,
        experiments,
        before: problem.residual(),
        accepted: state.clone(),
        left: states.pop().map(|state| state.fit.left).unwrap_or_default(),
    }
}

/// What a model that was found on few rows leaves of as many as are searched.
fn left_on_more_rows(problem: &Problem, last: &State) -> Vec<Structure> {
    let thinned = problem.thinned(SEARCHED_ROWS);
    let more = thinned.as_ref().unwrap_or(problem);
    last.on(more).map_or_else(Vec::new, |state| structures(more, &state.columns, &state.fit))
}

/// Waves that a comparison finds in so many more rows than were searched.
fn thinned_away(problem: &Problem, small: &Problem, last: &State) -> Vec<Structure> {
    if small.has_rows_of(problem) {
        return Vec::new();
    }
    let thinned = problem.thinned(COMPARED_ROWS);
    let compared = thinned.as_ref().unwrap_or(problem);
    let state = last.on(compared);
    state.map_or_else(Vec::new, |state| waves_left(compared, &state.columns, &state.fit))
}

/// Adds what rivals effects without beating them.
fn confuse(found: &mut [Rivals], witnesses: impl Iterator<Item = (usize, String)>) {
    for (index, witness) in witnesses {
        if let Some(rivals) = found.iter_mut().find(|rivals| rivals.index == index) {
            rivals.confused.push(witness);
        }
    }
}

/// Why an effect is taken out in whose place a shape without a name explains more.
const BEATEN: &str = "a shape without a name explains more in its place";

/// Why waves are taken out of which one shape has all.
const ONE_COMB: &str = "harmonics of one shape that comes again evenly";

/// Why an effect is taken out that is the nearest to another shape.
const RUNS_OFF: &str = "a way beyond its range explains more in its place";

/// Why an effect is taken out that is not needed beside what is left.
const NOT_TOLD: &str = "not told from what is left";

/// Goes one more step without some effects, and without those that are superfluous then; the rivals
/// of those that stay.
fn take_out(
    (problem, small): (&Problem, &Problem),
    (steps, states): (&mut Vec<Step>, &mut Vec<State>),
    (out, reason): (&[usize], &str),
    found: Vec<Rivals>,
) -> Vec<Rivals> {
    if out.is_empty() {
        return found;
    }
    let last = &states[states.len() - 1];
    let dropped = out.iter().map(|&index| Dropped {
        name: last.components[index].term.name.clone(),
        reason: reason.to_owned(),
    });
    let Some(state) = last.settled_without(problem, out) else {
        return found;
    };
    let (state, useless) = pruned(problem, state);
    let Some((step, state)) = without_dropped(small, state, dropped.chain(useless).collect())
    else {
        return found;
    };
    let found = besides(found, &out_of(last, &state));
    steps.push(step);
    states.push(state);
    found
}

/// Goes on without effects that what they themselves leave denies, until none of those that stay is; how these and
/// those differ.
fn without_denied(
    problems: (&Problem, &Problem),
    (steps, states): (&mut Vec<Step>, &mut Vec<State>),
    mut found: Vec<Rivals>,
) -> (Vec<Rivals>, Vec<Structure>) {
    let mut told = Vec::new();
    loop {
        let (small, last) = (problems.1, &steps[steps.len() - 1].state);
        let (denied, others): (Vec<_>, Vec<_>) =
            disagreements(small, last).into_iter().partition(|one| one.is_denied);
        let out: Vec<usize> = denied.iter().map(|one| one.index).collect();
        let shown = out.iter().filter_map(|&index| untold(small, last, index));
        told.extend(denied.into_iter().map(|one| one.differs).chain(shown));
        let before = steps.len();
        found = take_out(problems, (steps, states), (&out, NOT_TOLD), found);
        if steps.len() == before {
            told.extend(others.into_iter().map(|one: Disagreement| one.differs));
            return (found, told);
        }
    }
}

/// Goes on without effects that are the nearest to another shape, without waves that are those of one, and without
/// effects that are not told from what is left; what they show is left too.
fn without_untold(
    problems: (&Problem, &Problem),
    (steps, states): (&mut Vec<Step>, &mut Vec<State>),
    residual: &mut Vec<Structure>,
    mut found: Vec<Rivals>,
) -> Vec<Rivals> {
    let small = problems.1;
    let (off, shown) = running_off(small, &steps[steps.len() - 1].state);
    found = take_out(problems, (steps, states), (&off, RUNS_OFF), found);
    residual.extend(shown);
    if let Some((waves, shape)) = one_comb(small, &steps[steps.len() - 1].state) {
        found = take_out(problems, (steps, states), (&waves, ONE_COMB), found);
        residual.push(shape);
    }
    let not_told = not_told(small, steps, residual);
    let last = &steps[steps.len() - 1].state;
    residual.extend(not_told.iter().filter_map(|&index| untold(small, last, index)));
    take_out(problems, (steps, states), (&not_told, NOT_TOLD), found)
}

/// Places of the effects of a state that another one has no more.
fn out_of(before: &State, after: &State) -> Vec<usize> {
    let known = |component: &Component| (component.term.name.clone(), component.term.nonlinear());
    let mut left = after.components.iter().map(known).peekable();
    let all = before.components.iter().map(known).enumerate();
    all.filter_map(|(index, one)| left.next_if_eq(&one).is_none().then_some(index)).collect()
}

/// The rivals of the effects that stay when some are taken out.
fn besides(found: Vec<Rivals>, out: &[usize]) -> Vec<Rivals> {
    let stays = found.into_iter().filter(|rivals| !out.contains(&rivals.index));
    let place = |index: usize| index - out.iter().filter(|one| **one < index).count();
    stays.map(|rivals| Rivals { index: place(rivals.index), ..rivals }).collect()
}

fn verdict(state: &State, found: &[Rivals], residual: &[Structure]) -> Verdict {
    if !residual.is_empty() {
        return Verdict::Unexplained;
    }
    if state.components.is_empty() {
        return Verdict::NothingMissing;
    }
    if found.iter().any(|found| !found.confused.is_empty()) {
        return Verdict::Ambiguous;
    }
    Verdict::Explained
}

fn rounds(problem: &Problem, steps: &[Step], states: &[State]) -> Vec<Round> {
    let mut rounds = Vec::with_capacity(steps.len());
    for (number, step) in steps.iter().enumerate() {
        let state = &states[number];
        let chosen = steps.get(number + 1).and_then(|next| next.added.clone());
        let before = number.checked_sub(1).map(|last| &steps[last].tried);
        let own = before.and_then(|tried| {
            tried.iter().find(|judged| Some(&judged.component.term.name) == step.added.as_ref())
        });
        rounds.push(Round {
            round: number,
            added: step.added.clone(),
            dropped: step.dropped.iter().map(|one| one.name.clone()).collect(),
            rms_um: rms(&problem.layout, &state.fit.left),
            holdout_rms_um: holdout_rms(problem, &state.columns, &state.fit.noises),
            p_value: own.map(|judged| judged.p_value),
            effects: effects(problem, state),
            rejected: rejected(step, chosen.as_deref()),
        });
    }
    rounds
}

/// What was dropped, refused or beaten in a round, with the reason.
fn rejected(step: &Step, chosen: Option<&str>) -> Vec<(String, String)> {
    let name = |judged: &Judged| judged.component.term.name.clone();
    let is_chosen = |judged: &Judged| Some(judged.component.term.name.as_str()) == chosen;
    let dropped = step.dropped.iter().map(|one| (one.name.clone(), one.reason.clone()));
    let refused = step.tried.iter().zip(&step.refused);
    let beaten = step.tried.iter().find(|judged| is_chosen(judged)).into_iter().flat_map(|best| {
        let behind = step.tried.iter().skip(step.refused.len());
        behind.map(|judged| (judged, Refusal::victor(best, judged)))
    });
    let refused = refused.map(|(judged, refusal)| (judged, refusal.clone())).chain(beaten);
    let refused = refused.filter(|(judged, _)| !is_chosen(judged));
    dropped.chain(refused.map(|(judged, refusal)| (name(judged), refusal.to_string()))).collect()
}

/// Said of a whole number that the places of the samples do not tell from others.
const OR_ANOTHER: &str = "or another that shows the same at these places";

/// How much larger a standard error is told to be wider because of what other values of an effect may be.
const WIDENED: f64 = 1.2;

/// Every component of a state with its parameters.
#[must_use]
pub(crate) fn effects(problem: &Problem, state: &State) -> Vec<FittedEffect> {
    let both = told_covariances(problem, state);
    let of_counts = errors_of_counts(problem, state).into_iter().enumerate();
    of_counts.map(|(index, of_count)| fitted(problem, state, &both, (index, of_count))).collect()
}

/// A component with its values; their covariance with its other values at 0, and with what those may be, and the
/// standard error of its count where it may be any.
fn fitted(
    problem: &Problem,
    state: &State,
    [of_used, of_all]: &[JointCovariance; 2],
    (index, of_count): (usize, Option<f64>),
) -> FittedEffect {
    let component = &state.components[index];
    let (used, from) = state.coefficients(index);
    let estimates = |covariance: &JointCovariance| {
        component.estimates(used, &covariance_rows(&covariance.linear, from, component.width()))
    };
    let term = component.valued(used);
    let before = term.instead_of.and_then(|place| problem.model.effects.get(place));
    let file_says = |parameter: usize| before.map(|before| before.values[parameter]);
    let mut parameters = Vec::new();
    for (estimate, wider) in estimates(of_used).into_iter().zip(estimates(of_all)) {
        let what = &component.term.parameters[estimate.parameter];
        if component.is_counted(estimate.parameter) {
            let (key, value) = (what.key(), estimate.value.round());
            let (stderr, file_says) = (of_count, file_says(estimate.parameter));
            parameters.push(FittedParameter { key, value, stderr, warning: None, file_says });
            continue;
        }
        let of_nature = component.term.nature().uncertainty * estimate.value;
        let [narrow, stderr] = [&estimate, &wider].map(|one| libm::hypot(one.stderr, of_nature));
        // Neither zero nor half a turn is a special phase.
        let has_ends = what.role != Role::Phase;
        let warning = (has_ends && before.is_none())
            .then(|| warning(estimate.value, narrow, &what.range))
            .flatten()
            .or_else(|| another_material(&component.term, estimate.parameter))
            .or((WIDENED * narrow < stderr).then_some("± with what its values left at 0 may be"));
        parameters.push(FittedParameter {
            key: what.key(),
            value: estimate.value,
            stderr: Some(stderr),
            warning,
            file_says: file_says(estimate.parameter),
        });
    }
    for (place, &parameter) in component.term.nonlinear_indices().iter().enumerate() {
        let what = &component.term.parameters[parameter];
        let value = component.term.values[parameter];
        // A setting that is as it should be, and a way that takes nothing up.
        let is_set = matches!(what.search, Search::Switch | Search::Fixed);
        let unused = is_set && what.default == Some(0.0) && value == 0.0;
        if unused || !component.depends_on(problem, used, place) {
            continue;
        }
        let stderr = of_all.nonlinear[index][place];
        let stderr = if what.search == Search::Time {
            Some(stderr.unwrap_or(0.0).max(between_samples_s(problem, value)))
        } else {
            stderr
        };
        let stderr = match (stderr, stepwise(problem, state, index, place)) {
            (Some(least), stepwise) => Some(least.max(stepwise)),
            // Between two samples a step has no slope at all.
            (None, stepwise) => (!what.is_listed() && 0.0 < stepwise).then_some(stepwise),
        };
        let value = if setting_counts(&term, what) { value.round() } else { value };
        let warning = stderr
            .and_then(|stderr| warning_at_bound(value, stderr, &what.range))
            .or_else(|| one_of_several(problem, state, index, place).then_some(OR_ANOTHER));
        let file_says = file_says(parameter);
        parameters.push(FittedParameter { key: what.key(), value, stderr, warning, file_says });
    }
    FittedEffect { name: component.term.name.clone(), term, parameters }
}

/// Standard deviation of a value that moves steps of a curve from sample to sample, as the likelihood has it, of means
/// of neighbours where there are very many samples; 0 of one that bends a smooth curve.
fn stepwise(problem: &Problem, state: &State, index: usize, place: usize) -> f64 {
    if !state.components[index].is_rough(problem) {
        return 0.0;
    }
    let deviation = |problem: &Problem, state: &State| {
        Likelihood::of(problem, state, index).and_then(|likelihood| likelihood.deviation(place))
    };
    let told = match problem.thinned(STEPPED_ROWS) {
        None => deviation(problem, state),
        Some(few) => state.on(&few).and_then(|state| deviation(&few, &state)),
    };
    told.unwrap_or(0.0)
}

/// Standard deviation, in s, of a moment that lies anywhere between two samples.
fn between_samples_s(problem: &Problem, at_s: f64) -> f64 {
    let time_s = &problem.record.time_s;
    let after = time_s.partition_point(|time| *time < at_s);
    let around =
        after.checked_sub(1).and_then(|before| Some((time_s[before], *time_s.get(after)?)));
    around.map_or(0.0, |(before, after)| (after - before) / f64::sqrt(12.0))
}

/// True for a setting that is a whole number: every one that has no unit.
fn setting_counts(term: &Term, what: &helixlock_plant::Parameter) -> bool {
    term.nature().is_setting() && what.unit.suffix().is_empty()
}

fn warning(value: f64, stderr: f64, range: &std::ops::RangeInclusive<f64>) -> Option<&'static str> {
    if value.abs() < STANDARD_ERRORS * stderr {
        return Some("useless: not two standard errors from zero");
    }
    warning_at_bound(value, stderr, range)
}

/// Said of a constant of physics that was fitted freely.
fn another_material(term: &Term, parameter: usize) -> Option<&'static str> {
    let known = &Term::card(term.kind())?.parameters.get(parameter)?.role;
    let freed = term.parameters[parameter].role == Role::Linear;
    (freed && matches!(known, Role::Known { .. }))
        .then_some("not what the machine file's material does")
}

fn warning_at_bound(
    value: f64,
    stderr: f64,
    range: &std::ops::RangeInclusive<f64>,
) -> Option<&'static str> {
    let (low, high) = (*range.start(), *range.end());
    let open = low < high;
    let slack = AT_AN_END * stderr;
    (open && (value <= low + slack || high - slack <= value))
        .then_some("at the bound of its plausible range")
}

fn ranked(
    state: &State,
    found: &[Rivals],
    first: &[Judged],
    experiments: &[Advice],
) -> Vec<Ranked> {
    let best = first.iter().map(|judged| judged.evidence).fold(f64::NEG_INFINITY, f64::max);
    let mut all: Vec<Ranked> = Vec::new();
    for found in found {
        let name = &state.components[found.index].term.name;
        let own = found.tried.iter().find(|judged| judged.component.term.name == *name);
        let Some(own) = own.or_else(|| first.iter().find(|j| j.component.term.name == *name))
        else {
            continue;
        };
        let mut one = of_judged(own, own.evidence, true);
        one.confounded_with.clone_from(&found.confused);
        one.separate_by = (!found.confused.is_empty())
            .then(|| experiment::for_pair(experiments, name, &state.components[found.index]));
        all.push(one);
    }
    for judged in first {
        if all.iter().all(|known| known.name != judged.component.term.name) {
            let mut one = of_judged(judged, best, false);
            mirror(&mut one, state, found, experiments);
            all.push(one);
        }
    }
    all
}

/// Candidates were tried on means, which do not scatter as the samples do: what is missing comes to
/// their squares.
fn add_scatter(candidates: &mut [Ranked], square_um: f64) {
    let with_scatter = |rms_um: f64| libm::sqrt(rms_um * rms_um + square_um);
    for one in candidates {
        one.rms_um = with_scatter(one.rms_um);
        one.holdout_rms_um = with_scatter(one.holdout_rms_um);
    }
}

/// Confusion is mutual: a rival names the effect it is confused with.
fn mirror(one: &mut Ranked, state: &State, found: &[Rivals], experiments: &[Advice]) {
    for found in found.iter().filter(|found| found.confused.contains(&one.name)) {
        let component: &Component = &state.components[found.index];
        one.confounded_with.push(component.term.name.clone());
        one.confounded_with
            .extend(found.confused.iter().filter(|name| **name != one.name).cloned());
        one.separate_by = Some(experiment::for_pair(experiments, &one.name, component));
    }
    let mut known = BTreeSet::new();
    one.confounded_with.retain(|name| known.insert(name.clone()));
}

fn of_judged(judged: &Judged, best: f64, accepted: bool) -> Ranked {
    Ranked {
        name: judged.component.term.name.clone(),
        accepted,
        rms_um: judged.rms_um,
        holdout_rms_um: judged.holdout_rms_um,
        p_value: judged.p_value,
        behind: (best - judged.evidence).max(0.0),
        confounded_with: Vec::new(),
        separate_by: None,
    }
}
