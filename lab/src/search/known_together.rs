//! Effects of known size that show only together.

use helixlock_plant::Term;

use super::judging::tried_of;
use crate::hypotheses::of_known_size;
use crate::model::{
    Columns, Component, Judged, Problem, Stage, State, noises_of, plain_noises, with_noise,
};
use crate::numerics::count;
use crate::policy::chance::NAMED;
use crate::policy::evidence::SET_MARGIN;
use crate::policy::extent::KNOWN_IN_SETS;

/// Effects of known size that a model lacks, as many as sets are made of.
fn missing(problem: &Problem, now: &State) -> Vec<Term> {
    let coloured = Stage::new(problem, &now.columns, &now.fit.noises);
    let known = of_known_size(&coloured, &now.components).into_iter().map(|one| one.term);
    let is_new = |term: &Term| now.components.iter().all(|other| other.term.name != term.name);
    known.filter(is_new).take(KNOWN_IN_SETS).collect()
}

/// Each of them on what the model leaves, however little it explains there: how large it is, is known.
pub(super) fn of_known_size_alone(problem: &Problem, now: &State) -> Vec<Judged> {
    let terms = missing(problem, now);
    terms.iter().filter_map(|term| tried_of(problem, now, (term, &now.fit.noises))).collect()
}

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
    let known: Vec<Component> = missing(problem, now).into_iter().map(Component::new).collect();
    let price = problem.price_of_a_number();
    let single = tried.first().map_or(0.0, |best| best.evidence);
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
                &plain_noises(problem, &now.fit.left),
            );
            let state = State::of(problem, all, &noises_of(problem, &rough.left))?;
            let gain = 2.0 * (state.fit.log_likelihood - now.fit.log_likelihood);
            Some((gain - price * count(members.len()), gain, members))
        })
        .max_by(|a, b| a.0.total_cmp(&b.0))?;
    let least = (single.max(0.0) + SET_MARGIN).max(-2.0 * libm::log(NAMED));
    (least < gain - looks).then_some(members)
}
