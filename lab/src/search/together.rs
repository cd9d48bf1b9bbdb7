//! Effects that show only together.
//!
//! Slow noise that takes up one of some curves takes up the others while it is missing: then each alone explains
//! nothing.

use helixlock_plant::{CATALOGUE, Parameter, Search, Term};

use super::acceptance::{is_of_whole_waves, refusal, worth};
use super::judging::tried;
use super::known_together::of_known_size_alone;
use crate::hypotheses::chance_in_noise;
use crate::model::{Columns, Component, Judged, Problem, State};
use crate::numerics::count;
use crate::policy::chance::{NAMED, SWALLOWED};
use crate::policy::evidence::{MARGIN, SET_MARGIN};
use crate::policy::extent::{FIRST_OF_PAIRS, MANY_NUMBERS, SAME_CURVE};

/// Effects taken in turn, though none may be accepted yet, and what was tried beside them.
struct Start {
    /// Each, judged beside those before it, and the model with it.
    taken: Vec<(Judged, State)>,
    /// Others, best evidence first.
    listed: Vec<Judged>,
}

impl Start {
    fn with(
        problem: &Problem,
        now: &State,
        before: &[(Judged, State)],
        one: &Judged,
    ) -> Option<Self> {
        let model = before.last().map_or(now, |(_, state)| state);
        let state = with(problem, model, one)?;
        let taken = [before, &[(one.clone(), state.clone())]].concat();
        let mut listed = tried(problem, &state);
        listed.retain(|other| !taken.iter().any(|(one, _)| imitate(one, other)));
        Some(Self { taken, listed })
    }

    /// The same and the best of what was tried; `None` where they do not pay for themselves.
    fn and_the_best(&self, problem: &Problem, now: &State) -> Option<Self> {
        let best = self.listed.first()?;
        (0.0 < self.evidence_with(now, best)).then_some(())?;
        Self::with(problem, now, &self.taken, best)
    }

    /// Evidence of all of them and another.
    fn evidence_with(&self, now: &State, other: &Judged) -> f64 {
        let gain = 2.0 * (other.fit.log_likelihood - now.fit.log_likelihood);
        let before: f64 = self.taken.iter().map(|(one, _)| one.price()).sum();
        gain - before - other.price()
    }

    /// The set with the best of what is accepted beside them.
    fn complete(&self, problem: &Problem, now: &State) -> Option<Together> {
        let (_, state) = self.taken.last()?;
        let last = self.listed.iter().find(|other| refusal(problem, state, other).is_none())?;
        let evidence = self.evidence_with(now, last);
        Some(Together { firsts: self.taken.clone(), last: last.clone(), evidence })
    }
}

/// Effects each of which is accepted beside the others.
pub(super) struct Together {
    /// All but one, and the models with them.
    pub(super) firsts: Vec<(Judged, State)>,
    /// That one, judged beside the others.
    pub(super) last: Judged,
    /// Evidence of all.
    evidence: f64,
}

impl Together {
    fn members(&self) -> impl Iterator<Item = &Judged> {
        self.firsts.iter().map(|(one, _)| one).chain([&self.last])
    }

    /// Names of all.
    pub(super) fn names(&self) -> Vec<&str> {
        self.members().map(|one| one.component.term.name.as_str()).collect()
    }

    /// How many sets of as many effects there are to choose from: of those that were tried, or of all that there
    /// might be where one bends to anything.
    fn sets(&self) -> f64 {
        let bends = self.members().any(|one| bends(&one.component.term));
        let among = if bends { count(CATALOGUE.len()) } else { self.firsts[0].0.tried };
        let sets = (0..=self.firsts.len()).map(|place| (among - count(place)) / count(place + 1));
        sets.product::<f64>().max(1.0)
    }

    /// True where noise like that of the model, which may be slow, hardly ever does as much.
    fn is_beyond_noise(&self, problem: &Problem, now: &State) -> bool {
        let all: Vec<Component> = self.members().map(|one| one.component.clone()).collect();
        let Ok(columns) = Columns::of(problem, &all) else { return false };
        let gain = 2.0 * (self.last.fit.log_likelihood - now.fit.log_likelihood);
        let looks = self.members().map(|one| one.looks.max(1.0)).product::<f64>() * self.sets();
        let model = (&now.columns, &now.fit);
        looks * chance_in_noise(problem, model, &columns.raw, gain, NAMED / looks) < NAMED
    }

    /// True where each is accepted beside the others, as the last is.
    fn is_mutual(&self, problem: &Problem, now: &State) -> bool {
        (0..self.firsts.len()).all(|place| self.needs(problem, now, place).unwrap_or(false))
    }

    /// True where one of the first is accepted beside all others; `None` without a fit of those.
    fn needs(&self, problem: &Problem, now: &State, place: usize) -> Option<bool> {
        let mut others: Vec<&Judged> = self.members().collect();
        let one = others.remove(place);
        let all = others.iter().map(|other| other.component.clone());
        let components = now.components.iter().cloned().chain(all).collect();
        let model = State::settled(problem, components, &self.last.fit.noises)?;
        let listed = tried(problem, &model);
        let again =
            listed.iter().find(|other| other.component.term.name == one.component.term.name)?;
        Some(refusal(problem, &model, again).is_none())
    }
}

/// Two or three effects that together explain most, where slow noise may hide each while another is missing;
/// `None` unless they beat every single one, all others of as many, and noise. Three must leave noise that hides
/// nothing: what they leave else is the rest of a shape that they begin to draw.
pub(super) fn together(problem: &Problem, now: &State, single: &[Judged]) -> Option<Together> {
    if SWALLOWED <= worth(problem, &now.fit) {
        return None;
    }
    let firsts = &single[..single.len().min(FIRST_OF_PAIRS)];
    let known = of_known_size_alone(problem, now);
    let is_new = |one: &&Judged| !firsts.iter().any(|first| imitate(one, first));
    let firsts = firsts.iter().chain(known.iter().filter(is_new));
    let ones: Vec<Start> = firsts.filter_map(|one| Start::with(problem, now, &[], one)).collect();
    clear_winner(problem, now, single, &ones).or_else(|| {
        let twos = ones.iter().filter_map(|one| one.and_the_best(problem, now));
        let three = clear_winner(problem, now, single, &twos.collect::<Vec<Start>>());
        three.filter(|all| SWALLOWED <= worth(problem, &all.last.fit))
    })
}

/// The best set that some starts lead to, where it is ahead of every single effect and of sets without any of its
/// members.
fn clear_winner(
    problem: &Problem,
    now: &State,
    single: &[Judged],
    starts: &[Start],
) -> Option<Together> {
    let complete = starts.iter().filter_map(|start| start.complete(problem, now));
    let mut sets: Vec<Together> = complete.collect();
    sets.sort_by(|a, b| a.evidence.total_cmp(&b.evidence));
    let best = sets.pop()?;
    let rivals =
        sets.iter().filter(|other| !other.names().iter().any(|a| best.names().contains(a)));
    let rival = rivals.map(|other| other.evidence).fold(f64::NEG_INFINITY, f64::max);
    let alone = single.first().map_or(0.0, |best| best.evidence).max(0.0);
    let wins = alone + SET_MARGIN < best.evidence && rival + MARGIN < best.evidence;
    (wins && best.is_beyond_noise(problem, now) && best.is_mutual(problem, now)).then_some(best)
}

/// Two effects in the place of one of many numbers, or of a free place or moment, which may bend to what they draw
/// together, as a hop of the laser does to a slope and a slip: one of few, such as a play, and one that is accepted
/// beside it. `None` unless they are clearly ahead of that one, and likelier than it with the best beside it.
pub(super) fn instead(
    problem: &Problem,
    now: &State,
    best: &Judged,
    single: &[Judged],
) -> Option<Together> {
    let numbers = |one: &Judged| one.component.width() + one.component.term.nonlinear().len();
    let name = best.component.term.name.as_str();
    if numbers(best) < MANY_NUMBERS && !bends(&best.component.term) {
        return None;
    }
    let is_other = |one: &&Judged| numbers(one) < MANY_NUMBERS && one.component.term.name != name;
    let mut firsts: Vec<&Judged> = Vec::new();
    for one in single.iter().filter(is_other) {
        let is_like = |other: &&Judged| (other.gain - one.gain).abs() < SAME_CURVE;
        if !firsts.iter().any(is_like) {
            firsts.push(one);
        }
    }
    let of = |one: &Judged| Start::with(problem, now, &[], one)?.complete(problem, now);
    let pairs = firsts.into_iter().take(FIRST_OF_PAIRS).filter_map(of);
    let others = pairs.filter(|pair| !pair.names().contains(&name));
    let two = others.max_by(|a, b| a.evidence.total_cmp(&b.evidence))?;
    let is_likelier = || of(best).is_none_or(|more| more.evidence < two.evidence);
    let wins = best.evidence + MARGIN < two.evidence && is_likelier();
    (wins && two.is_mutual(problem, now)).then_some(two)
}

/// A model with one effect more.
fn with(problem: &Problem, now: &State, one: &Judged) -> Option<State> {
    State::settled(problem, now.with(&one.component), &one.fit.noises)
}

/// True for an effect whose shape is free, such as a bump of any width at any place.
fn bends(term: &Term) -> bool {
    let free = |what: &Parameter| {
        matches!(
            what.search,
            Search::Linear | Search::Logarithmic | Search::Position | Search::Time
        )
    };
    term.parameters.iter().any(free)
}

/// True for two of one name that imitate a spell of anything, such as a slip there and one back.
fn imitate(one: &Judged, other: &Judged) -> bool {
    let (one, other) = (&one.component.term, &other.component.term);
    one.name == other.name && !is_of_whole_waves(one)
}
