//! Waves too swift for the samples, which show there what a slower one would.

use helixlock_plant::{CATALOGUE, Term};

use super::rivals::inflation;
use crate::model::{Component, Problem, State, pattern};
use crate::noise::Whitener;
use crate::numerics::count;
use crate::numerics::least_squares::dot;
use crate::policy::evidence::MARGIN;

/// Effects of which a low harmonic, too swift to be looked for, draws at these very samples what one of a model
/// does: a screw's second one, read every 4 mm of its lead of 10 mm, is a wave of 20 mm.
#[must_use]
pub(super) fn by_sampling(problem: &Problem, state: &State, index: usize) -> Vec<String> {
    let own = &state.components[index].term.name;
    let whitener = Whitener::new(&problem.layout, &state.fit.noises);
    let shape = pattern(problem, state, index, &whitener);
    let lost =
        |rival: &Component| dot(&shape, &shape) / inflation(problem, rival, &whitener, &shape);
    let mut alike: Vec<String> = low_harmonics(problem)
        .filter(|rival| rival.term.name != *own)
        .filter(|rival| problem.highest_order() < rival.waves_a_turn(problem))
        .filter(|rival| lost(rival) < MARGIN)
        .map(|rival| rival.term.name)
        .collect();
    alike.dedup();
    alike
}

/// Low harmonics of every effect that has harmonics high and low, of parts that the machine has.
fn low_harmonics(problem: &Problem) -> impl Iterator<Item = Component> {
    let cards = CATALOGUE.iter().filter(|card| problem.sees(card.entry));
    let cards = cards.filter(|card| problem.model.lacks(card.parts).is_none());
    cards.filter_map(|card| Some((card, card.nature.high_harmonic?))).flat_map(|(card, high)| {
        let low = (1..).map(count).take_while(move |harmonic| *harmonic < high);
        low.map(|harmonic| {
            let term = Term::candidate(card, problem.model.rotary).with_nonlinear(&[harmonic]);
            Component::new(term)
        })
    })
}
