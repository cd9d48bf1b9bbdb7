//! Waves of listed orders where a sine of an order beside them explains more.
//!
//! A wave that goes 0.4 times less into the travel than the screw's second harmonic is three quarters of that harmonic,
//! and what is left of it is a line beside. So a sine of a free order stands in the place of each wave of a shaft, with
//! those that no more than a wave over the record tells from it; among all orders it was looked for. It is the cause
//! where it explains more than a line beside all waves would.

use super::court::{Winner, in_place_of_any};
use super::rivals::Rivals;
use crate::formulas::sine_between;
use crate::model::{Problem, State};
use crate::policy::evidence::OFF_AN_ORDER;

/// The sine of an order that no part has, where that explains more than waves of shafts.
#[must_use]
pub(crate) fn unlisted_order(problem: &Problem, state: &State, found: &[Rivals]) -> Option<Winner> {
    let off = OFF_AN_ORDER / problem.turned().max(f64::MIN_POSITIVE);
    let all = state.components.iter().enumerate();
    let orders: Vec<(usize, f64)> = all
        .filter(|(_, one)| one.term.is_wave() && one.term.frequency_hz().is_none())
        .map(|(index, one)| (index, one.waves_a_turn(problem)))
        .collect();
    let near = |order: f64| {
        let is_near = |(_, other): &&(usize, f64)| (other - order).abs() < off;
        orders.iter().filter(is_near).map(|(index, _)| *index).collect::<Vec<usize>>()
    };
    let better = |&(_, order): &(usize, f64)| {
        let shape = sine_between(problem, [order - off, order + off])?;
        in_place_of_any(problem, state, found, vec![near(order)], &[shape])
    };
    let won = orders.iter().filter_map(better).max_by(|a, b| a.ahead.total_cmp(&b.ahead))?;
    // Where another line stands beside them all, they are not to blame for it.
    let any = sine_between(problem, [0.0, f64::INFINITY])?;
    let beside = in_place_of_any(problem, state, found, vec![Vec::new()], &[any]);
    beside.is_none_or(|beside| beside.ahead < won.ahead).then_some(won)
}
