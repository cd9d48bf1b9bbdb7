//! What an input that turns unevenly costs, from its own pulses.
//!
//! Between two pulses the speed is not known. It is taken to change there no quicker than it does
//! from one period to the next; a vibration faster than half the pulses would not be seen.

use super::pulses::Pulses;
use crate::number::number;

/// Largest part of an input pulse by which a straight line between two of them may be off.
///
/// A speed that changes by the part `c` over a period bends the phase by `c/8` of a pulse in the
/// middle of it; twice that is taken for what bends it beyond a parabola.
pub(super) fn interpolation_pulses(pulses: &Pulses) -> f64 {
    let periods_s: Vec<f64> = pulses.input_s().windows(2).map(|pair| pair[1] - pair[0]).collect();
    let change = |pair: &[f64]| (pair[1] - pair[0]).abs() / pair[0].min(pair[1]);
    periods_s.windows(2).map(change).fold(0.0, f64::max) / 4.0
}

/// Input pulses that a time stands for where the input is fastest.
pub(super) fn fastest_pulses(pulses: &Pulses, time_s: f64) -> f64 {
    let periods_s = pulses.input_s().windows(2).map(|pair| pair[1] - pair[0]);
    time_s / periods_s.fold(f64::INFINITY, f64::min)
}

/// Where an instant lies among the pulses of a train, in pulses from its first; `None` outside.
pub(super) fn phase_at(train_s: &[f64], at_s: f64) -> Option<f64> {
    let after = train_s.partition_point(|&pulse_s| pulse_s <= at_s);
    let (before_s, after_s) = (*train_s.get(after.checked_sub(1)?)?, *train_s.get(after)?);
    Some(number(after - 1) + (at_s - before_s) / (after_s - before_s))
}
