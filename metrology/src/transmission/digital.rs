//! Digital phase comparison: `δ = 2π·Δt/T` of the compared period, both counted in clocks.

use super::counting::{fraction_bound_pulses, quotient, tick_rad};
use super::divided::divide;
use super::gearing::float;
use super::method::{Limits, Sample, Setup};
use super::pulses::Pulses;
use crate::Error;
use crate::number::number;

/// The output word of the hardware: clocks from the set pulse to the clear pulse.
///
/// Pulses at clocks `set` and `clear`; when they fall on one clock the word is zero.
#[must_use]
pub fn digital_word(set: u64, clear: u64) -> u32 {
    u32::try_from(clear.saturating_sub(set)).unwrap_or(u32::MAX)
}

pub(super) fn measure(pulses: &Pulses, setup: &Setup) -> Result<(Vec<Sample>, Limits), Error> {
    let divided = divide(pulses, setup, "digital")?;
    let gearing = setup.gearing;
    let range_rad = divided.range_pulses * gearing.input_pulse_rad();
    let sample = |&(clear, set): &(usize, usize)| {
        let set_tick = setup.ticks(divided.set_s[set]);
        let late = setup.ticks(divided.clear_s[clear]) - set_tick;
        let period = setup.ticks(divided.set_s[set + 1]) - set_tick;
        Sample {
            time_s: divided.clear_s[clear],
            output_turns: gearing.output_turns(divided.clear_pulse[clear]),
            // A later output pulse is an output that lags.
            error_rad: -quotient(late, period) * range_rad,
        }
    };
    let samples: Vec<Sample> = divided.pairs().iter().map(sample).collect();
    let bound_pulses = fraction_bound_pulses(pulses, setup)
        + 2.0 * divided.unevenness(pulses) * divided.range_pulses;
    let limits = Limits {
        resolution_rad: tick_rad(pulses, setup),
        range_rad: Some(range_rad),
        step_rad: None,
        samples_per_turn: float(gearing.output_lines) / number(divided.divider),
        bound_rad: bound_pulses * gearing.input_pulse_rad(),
        in_words: "equal frequencies only: whole dividers for both trains; starts again beyond its range; a change of speed within a comparison period counts as error",
    };
    Ok((samples, limits))
}
