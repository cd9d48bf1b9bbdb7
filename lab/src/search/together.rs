//! Effects that show only together.
//!
//! Logged physics comes together, and slow noise that takes up one of two curves takes up the other while it is
//! missing: then each alone explains nothing.

use helixlock_plant::Role;

use super::acceptance::{refusal, worth};
use super::judging::{plain_noises, tried};
use crate::hypotheses::{candidates, chance_in_noise};
use crate::model::{Columns, Component, Judged, Problem, Stage, State, noises_of, with_noise};
use crate::numerics::count;
use crate::policy::chance::{NAMED, SWALLOWED};
use crate::policy::evidence::{MARGIN, SET_MARGIN};
use crate::policy::extent::{FIRST_OF_PAIRS, KNOWN_IN_SETS, MANY_NUMBERS, SAME_CURVE};

/// Several effects of known size that together beat every single effect.
///
/// Logged physics comes together: a warm day has weather too, and one part of it alone may fit
/// worse than none. Which of the sets it is, is chosen at the price of a number for each member.
/// Whether it is there at all is another question: their sizes are known, so that noise multiplies
/// the likelihood by `x` no oftener than once in `x` (Markov's inequality), and by as much in one
/// of `n` sets `n` times as often.
pub(super) fn known_together(
    problem: &Problem,
    now: &State,
    tried: &[Judged],
) -> Option<Vec<Component>> {
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

/// Two effects that are accepted beside each other.
pub(super) struct Pair {
    /// The first, judged alone.
    one: Judged,
    /// The model with it.
    pub(super) first: State,
    /// The second, judged beside it.
    pub(super) second: Judged,
    /// Evidence of both.
    evidence: f64,
}

impl Pair {
    /// A first effect and the best of another name that is accepted beside it: two of one name, such as a slip there
    /// and one back, imitate a spell of anything.
    fn beside(problem: &Problem, now: &State, one: &Judged) -> Option<Self> {
        let first = with(problem, now, one)?;
        let listed = tried(problem, &first);
        let name = &one.component.term.name;
        let mut others = listed.into_iter().filter(|two| two.component.term.name != *name);
        let second = others.find(|two| refusal(problem, &first, two).is_none())?;
        let gain = 2.0 * (second.fit.log_likelihood - now.fit.log_likelihood);
        let evidence = gain - one.price() - second.price();
        Some(Self { one: one.clone(), first, second, evidence })
    }

    /// Names of both.
    pub(super) fn names(&self) -> [&str; 2] {
        [&self.one.component.term.name, &self.second.component.term.name]
    }

    /// True where noise like that of the model, which may be slow, hardly ever does as much.
    fn is_beyond_noise(&self, problem: &Problem, now: &State) -> bool {
        let both = [self.one.component.clone(), self.second.component.clone()];
        let Ok(columns) = Columns::of(problem, &both) else { return false };
        let gain = 2.0 * (self.second.fit.log_likelihood - now.fit.log_likelihood);
        let pairs = (0.5 * self.one.tried * (self.one.tried - 1.0)).max(1.0);
        let looks = self.one.looks.max(1.0) * self.second.looks.max(1.0) * pairs;
        let model = (&now.columns, &now.fit);
        looks * chance_in_noise(problem, model, &columns.raw, gain, NAMED / looks) < NAMED
    }

    /// True where the first is accepted beside the second, too.
    fn is_mutual(&self, problem: &Problem, now: &State) -> bool {
        let Some(other) = with(problem, now, &self.second) else { return false };
        let listed = tried(problem, &other);
        let again = listed.iter().find(|one| one.component.term.name == self.names()[0]);
        again.is_some_and(|one| refusal(problem, &other, one).is_none())
    }
}

/// The two effects that together explain most, where slow noise may hide each while the other is missing;
/// `None` unless they beat every single one, every other two, and noise.
pub(super) fn pair(problem: &Problem, now: &State, single: &[Judged]) -> Option<Pair> {
    if SWALLOWED <= worth(problem, now) {
        return None;
    }
    let firsts = single.iter().take(FIRST_OF_PAIRS);
    let mut pairs: Vec<Pair> = firsts.filter_map(|one| Pair::beside(problem, now, one)).collect();
    pairs.sort_by(|a, b| a.evidence.total_cmp(&b.evidence));
    let best = pairs.pop()?;
    let rivals =
        pairs.iter().filter(|other| !other.names().iter().any(|a| best.names().contains(a)));
    let rival = rivals.map(|other| other.evidence).fold(f64::NEG_INFINITY, f64::max);
    let alone = single.first().map_or(0.0, |best| best.evidence).max(0.0);
    let wins = alone + SET_MARGIN < best.evidence && rival + MARGIN < best.evidence;
    (wins && best.is_beyond_noise(problem, now) && best.is_mutual(problem, now)).then_some(best)
}

/// Two effects in the place of one of many numbers, which may bend to what they draw together: one of a single
/// number, such as a slope, and one that is accepted beside it. `None` unless they are clearly ahead.
pub(super) fn instead(
    problem: &Problem,
    now: &State,
    best: &Judged,
    single: &[Judged],
) -> Option<Pair> {
    let numbers = |one: &Judged| one.component.width() + one.component.term.nonlinear().len();
    if numbers(best) < MANY_NUMBERS {
        return None;
    }
    let mut firsts: Vec<&Judged> = Vec::new();
    for one in single.iter().filter(|one| numbers(one) == 1) {
        let is_like = |other: &&Judged| (other.gain - one.gain).abs() < SAME_CURVE;
        if !firsts.iter().any(is_like) {
            firsts.push(one);
        }
    }
    let of = |one: &Judged| Pair::beside(problem, now, one);
    let pairs = firsts.into_iter().take(FIRST_OF_PAIRS).filter_map(of);
    let name = best.component.term.name.as_str();
    let others = pairs.filter(|pair| !pair.names().contains(&name));
    let two = others.max_by(|a, b| a.evidence.total_cmp(&b.evidence))?;
    (best.evidence + MARGIN < two.evidence && two.is_mutual(problem, now)).then_some(two)
}

/// A model with one effect more.
fn with(problem: &Problem, now: &State, one: &Judged) -> Option<State> {
    State::settled(problem, now.with(&one.component), &one.fit.noises)
}
