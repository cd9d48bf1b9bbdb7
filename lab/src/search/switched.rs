//! Waves in time of which a switch would be the cause.
//!
//! A thermostat or a valve that is open as long as it is shut has waves at odd multiples of its frequency, and each
//! by itself is a vibration. So a square wave is heard in the place of each wave in time, with those at multiples of
//! its frequency.

use super::court::{Winner, in_place_of_any};
use super::rivals::Rivals;
use crate::formulas::switching;
use crate::model::{Problem, State};
use crate::numerics::spread;
use crate::policy::evidence::MULTIPLES;

/// What switches, where that explains more than waves in time.
#[must_use]
pub(crate) fn switched(problem: &Problem, state: &State, found: &[Rivals]) -> Option<Winner> {
    let groups = harmonics(problem, state);
    if groups.is_empty() {
        return None;
    }
    in_place_of_any(problem, state, found, groups, &[switching(problem)?])
}

/// Each wave in time of a model with those whose frequencies are multiples of its own, as nearly as the record
/// resolves.
fn harmonics(problem: &Problem, state: &State) -> Vec<Vec<usize>> {
    let all = state.components.iter().enumerate();
    let waves: Vec<(usize, f64)> =
        all.filter_map(|(index, one)| Some((index, one.term.frequency_hz()?))).collect();
    let cell = spread(&problem.record.time_s).recip();
    let of = |first: f64| {
        let is_multiple = |hertz: f64| {
            let times = (hertz / first).round();
            (1.0..=MULTIPLES).contains(&times) && (hertz - times * first).abs() < cell
        };
        waves.iter().filter(|(_, hertz)| is_multiple(*hertz)).map(|(index, _)| *index).collect()
    };
    waves.iter().map(|(_, first)| of(*first)).collect()
}
