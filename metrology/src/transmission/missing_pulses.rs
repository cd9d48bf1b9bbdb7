//! Pulses that a train lost or has twice.

use super::unevenness::phase_at;
use crate::Error;
use crate::number::number;

/// Half way between one period and two: beyond it a pulse is missing, below it one is too many.
const HALF_WAY: f64 = 1.5;

/// Periods that differ by less than this part are even enough to judge the one at an end by.
const EVEN: f64 = 0.1;

/// Refuses a train with a lost or a doubled pulse: from there on δ would be wrong by a whole one.
///
/// A period has to stand out from those beside it, and the other train has to go on without this
/// one: a drive that pauses makes both trains pause.
pub(super) fn check(train_s: &[f64], other_s: &[f64], column: &'static str) -> Result<(), Error> {
    let found = |row: usize, what: &'static str| {
        Err(Error::PulseMissing { row, column, at_s: train_s[row], what })
    };
    let apart = |from: usize, to: usize| {
        excess(train_s, other_s, from, to).is_none_or(|pulses| 0.5 < pulses.abs())
    };
    let lost_after = |row: &usize| lost(&train_s[row - 1..row + 3]) && apart(*row, row + 1);
    if let Some(row) = (1..train_s.len().saturating_sub(2)).find(lost_after) {
        return found(row, "lost after it");
    }
    let twice = |row: &usize| doubled(&train_s[row - 2..row + 3]) && apart(row - 1, row + 1);
    if let Some(row) = (2..train_s.len().saturating_sub(2)).find(twice) {
        return found(row, "doubled");
    }
    let mirrored: Vec<f64> = train_s.iter().rev().take(4).map(|at| -at).collect();
    if lost_at_the_end(&train_s[..4]) {
        return found(0, "lost after it");
    }
    if lost_at_the_end(&mirrored) {
        return found(train_s.len() - 2, "lost after it");
    }
    Ok(())
}

/// Pulses by which the other train says that this one falls short between two of its pulses; `None`
/// where the trains do not reach far enough to tell.
///
/// What the other train does over some pulses about the place is set against what it does before
/// and after, far enough out that its own pulses tell; at an end, on the one side that there is.
fn excess(train_s: &[f64], other_s: &[f64], from: usize, to: usize) -> Option<f64> {
    let reach = train_s.len().div_ceil(other_s.len()) + 1;
    let phase = |row: usize| phase_at(other_s, *train_s.get(row)?);
    let between = |from: usize, to: usize| Some(phase(to)? - phase(from)?);
    let before = from.checked_sub(2 * reach).and_then(|first| between(first, from - reach));
    let sides: Vec<f64> = before.into_iter().chain(between(to + reach, to + 2 * reach)).collect();
    let phase_of_one = sides.iter().sum::<f64>() / number(sides.len() * reach);
    let is_reached = |row: &usize| phase(*row).is_some();
    let from = (from.saturating_sub(reach)..=from).find(is_reached)?;
    let to = (to..=to + reach).rev().find(is_reached)?;
    let pulses = between(from, to)? / phase_of_one - number(to - from);
    (!sides.is_empty()).then_some(pulses)
}

/// The middle one of three periods is twice as long as its neighbours.
fn lost(instants: &[f64]) -> bool {
    let period = |k: usize| instants[k + 1] - instants[k];
    HALF_WAY * period(0).max(period(2)) < period(1)
}

/// The middle two of four periods make one.
fn doubled(instants: &[f64]) -> bool {
    let period = |k: usize| instants[k + 1] - instants[k];
    period(1) + period(2) < HALF_WAY * period(0).min(period(3))
}

/// The first of three periods is twice as long, the others are even: no start from rest.
fn lost_at_the_end(instants: &[f64]) -> bool {
    let period = |k: usize| instants[k + 1] - instants[k];
    let even = (period(2) - period(1)).abs() < EVEN * period(1);
    even && HALF_WAY * period(1) < period(0)
}

#[cfg(test)]
mod tests {
    use crate::number::number;
    use crate::transmission::{Gearing, Pulses, Synthesis, synthesise};

    /// Trains of a worm pair that speeds up from rest and swings by 20 %.
    fn trains() -> (Vec<f64>, Vec<f64>) {
        let gearing = Gearing { input_lines: 200, output_lines: 720, ratio: (36, 1) };
        let run = Synthesis { input_hz: 6.0, output_turns: 0.5 };
        let delta = |turns: f64| 6e-5 * libm::sin(std::f64::consts::TAU * 36.0 * turns);
        let even = synthesise(&gearing, &run, delta).unwrap();
        let uneven = |t: &f64| (t + 0.04).sqrt() + 0.01 * libm::sin(20.0 * t);
        let moved = |train: &[f64]| train.iter().map(uneven).collect();
        (moved(even.input_s()), moved(even.output_s()))
    }

    fn refused(input_s: Vec<f64>, output_s: Vec<f64>) -> String {
        Pulses::new(input_s, output_s).map_or_else(|error| error.to_string(), |_| String::new())
    }

    #[test]
    fn any_lost_or_doubled_pulse_is_named() {
        let (input_s, output_s) = trains();
        assert_eq!(refused(input_s.clone(), output_s.clone()), "");
        for row in (5..355).step_by(7) {
            let mut fewer = output_s.clone();
            fewer.remove(row);
            let said = refused(input_s.clone(), fewer);
            assert!(said.starts_with(&format!("output pulse {}:", row - 1)), "{row}: {said}");
            let mut fewer = input_s.clone();
            fewer.remove(10 * row);
            let said = refused(fewer, output_s.clone());
            assert!(said.starts_with(&format!("input pulse {}:", 10 * row - 1)), "{row}: {said}");
            let mut more = input_s.clone();
            more.insert(row + 1, 0.4 * input_s[row] + 0.6 * input_s[row + 1]);
            let said = refused(more, output_s.clone());
            assert!(said.contains("was doubled"), "{row}: {said}");
        }
    }

    #[test]
    fn a_drive_that_pauses_loses_nothing() {
        let (input_s, output_s) = trains();
        let paused = |s: &[f64]| s.iter().map(|t| if 0.5 < *t { t + 1.0 } else { *t }).collect();
        assert_eq!(refused(paused(&input_s), paused(&output_s)), "");
        let start: Vec<f64> = (0..50).map(|k| number(k).sqrt()).collect();
        assert_eq!(refused(start.clone(), start), "");
    }
}
