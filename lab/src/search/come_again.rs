//! Waves of which one shape that comes again would be the cause.
//!
//! A thermostat or a valve that is open as long as it is shut has waves at odd multiples of its frequency, a cam with
//! faces at those of its number, and each by itself has a name. So what is no sine is heard in the place of each wave,
//! with those at multiples of its frequency.

use super::court::{Winner, in_place_of_any};
use super::rivals::Rivals;
use crate::formulas::{Shape, several_a_turn, switching};
use crate::model::{Component, Problem, State};
use crate::numerics::spread;
use crate::policy::evidence::MULTIPLES;

/// What switches in time, or comes several times a turn, where that explains more than waves.
#[must_use]
pub(crate) fn come_again(problem: &Problem, state: &State, found: &[Rivals]) -> Option<Winner> {
    let hear = |groups, shapes: &[Shape]| in_place_of_any(problem, state, found, groups, shapes);
    let in_time = harmonics(state, spread(&problem.record.time_s), |one| one.term.frequency_hz());
    let groups: Vec<Vec<usize>> = in_time.into_iter().map(|(_, group)| group).collect();
    let switch = switching(problem).filter(|_| !groups.is_empty());
    let switches = switch.and_then(|shape| hear(groups, &[shape]));
    // Of waves once a turn every shape is heard already.
    let order = |one: &Component| {
        one.term.harmonic().filter(|waves| 1 < *waves).map(|_| one.waves_a_turn(problem))
    };
    let in_turns = || harmonics(state, problem.turned(), order).into_iter();
    let comes =
        |(order, group): (f64, Vec<usize>)| hear(vec![group], &several_a_turn(problem, order));
    switches.or_else(|| in_turns().filter_map(comes).max_by(|a, b| a.ahead.total_cmp(&b.ahead)))
}

/// Frequencies of waves of a model that have one, each with its wave and those whose frequencies are multiples of its
/// own, as nearly as a record of some length resolves.
fn harmonics(
    state: &State,
    length: f64,
    frequency: impl Fn(&Component) -> Option<f64>,
) -> Vec<(f64, Vec<usize>)> {
    let all = state.components.iter().enumerate();
    let waves: Vec<(usize, f64)> =
        all.filter_map(|(index, one)| Some((index, frequency(one)?))).collect();
    let of = |first: f64| {
        let is_multiple = |other: f64| {
            let times = (other / first).round();
            (1.0..=MULTIPLES).contains(&times) && (other - times * first).abs() < length.recip()
        };
        waves.iter().filter(|(_, other)| is_multiple(*other)).map(|(index, _)| *index).collect()
    };
    waves.iter().map(|(_, first)| (*first, of(*first))).collect()
}
