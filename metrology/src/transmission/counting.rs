//! Direct counting and subdivided counting.

use super::method::{Limits, Sample, Setup};
use super::pulses::Pulses;
use super::unevenness::{fastest_pulses, interpolation_pulses};
use crate::Error;
use crate::number::number;

/// Whole input pulses at each output pulse: the fraction of a pulse is lost.
pub(super) fn direct(pulses: &Pulses, setup: &Setup) -> Result<(Vec<Sample>, Limits), Error> {
    let samples = at_output_pulses(pulses, setup, |_, _| 0.0)?;
    let pulse_rad = setup.gearing.input_pulse_rad();
    let limits = Limits {
        resolution_rad: pulse_rad,
        range_rad: None,
        step_rad: None,
        samples_per_turn: super::gearing::float(setup.gearing.output_lines),
        // Either sample loses less than one pulse, and a tick may put an output pulse before or behind one.
        bound_rad: pulse_rad * (1.0 + 4.0 * fastest_pulses(pulses, pulses.tick_s())),
        in_words: "any ratio, any size; loses the fraction of an input pulse",
    };
    Ok((samples, limits))
}

/// Whole input pulses and the fraction `TΔ/T2`: clocks since the last input pulse over clocks of
/// the running input period.
pub(super) fn subdivided(pulses: &Pulses, setup: &Setup) -> Result<(Vec<Sample>, Limits), Error> {
    let input_s = pulses.input_s();
    let fraction = |output: usize, last: usize| {
        let last_tick = setup.ticks(input_s[last]);
        let since = setup.ticks(pulses.output_s()[output]) - last_tick;
        let period = setup.ticks(input_s[last + 1]) - last_tick;
        quotient(since, period)
    };
    let samples = at_output_pulses(pulses, setup, fraction)?;
    let limits = Limits {
        resolution_rad: tick_rad(pulses, setup),
        range_rad: None,
        step_rad: None,
        samples_per_turn: super::gearing::float(setup.gearing.output_lines),
        bound_rad: fraction_bound_pulses(pulses, setup) * setup.gearing.input_pulse_rad(),
        in_words: "any ratio, any size; takes the speed as even within one input pulse",
    };
    Ok((samples, limits))
}

/// δ at every output pulse that lies between two input pulses.
fn at_output_pulses(
    pulses: &Pulses,
    setup: &Setup,
    fraction: impl Fn(usize, usize) -> f64,
) -> Result<Vec<Sample>, Error> {
    let placed = pulses.placed();
    let Some(&(first_output, first_input)) = placed.first() else {
        return Err(Error::TooFewSamples { found: 0, expected: 2 });
    };
    let gearing = setup.gearing;
    let sample = |&(output, last): &(usize, usize)| {
        let (whole, rest) = gearing.nominal(output - first_output);
        let behind = (whole - number(last - first_input)) + (rest - fraction(output, last));
        Sample {
            time_s: pulses.output_s()[output],
            output_turns: gearing.output_turns(output),
            error_rad: behind * gearing.input_pulse_rad(),
        }
    };
    Ok(placed.iter().map(sample).collect())
}

/// Bound on a difference of two fractions of an input pulse: three instants are clocked for each,
/// each has the tick of the capture beside that clock, and each takes the speed as even between two
/// pulses.
pub(super) fn fraction_bound_pulses(pulses: &Pulses, setup: &Setup) -> f64 {
    let ticks_s = 1.0 / setup.clock_hz + pulses.tick_s();
    4.0 * fastest_pulses(pulses, ticks_s) + 2.0 * interpolation_pulses(pulses)
}

/// Turn of the output that one clock stands for at the mean speed, or a tick of the capture where that is
/// longer, rad.
pub(super) fn tick_rad(pulses: &Pulses, setup: &Setup) -> f64 {
    let input_s = pulses.input_s();
    let span_s = input_s[input_s.len() - 1] - input_s[0];
    let tick_s = pulses.tick_s().max(1.0 / setup.clock_hz);
    let pulses_per_tick = number(input_s.len() - 1) * tick_s / span_s;
    pulses_per_tick * setup.gearing.input_pulse_rad()
}

/// A quotient of clock counts; a period shorter than one clock gives zero.
#[expect(clippy::cast_precision_loss, reason = "clocks between two pulses are far below 2⁵³")]
pub(super) fn quotient(over: i64, under: i64) -> f64 {
    if under <= 0 { 0.0 } else { over as f64 / under as f64 }
}
