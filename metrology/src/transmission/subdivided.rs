//! Subdivided phase comparison.
//!
//! At every output pulse the clocks since the last input pulse, `Nt`, are set against the clocks
//! of the last whole input period, `N`: the phase of the input, which is compared with the phase
//! the ratio asks for. Only the fraction is measured; whole pulses are followed from sample to
//! sample, so there is no range, but the error must not change by half an input pulse between two.

use super::counting::{fraction_bound_pulses, quotient, tick_rad};
use super::method::{Limits, Sample, Setup};
use super::pulses::Pulses;
use crate::Error;

/// The output word of the hardware: `Nt` and `N` as a fraction of 2¹⁶, rounded down.
///
/// # Examples
///
/// ```
/// use helixlock_metrology::transmission::subdivided_word;
///
/// assert_eq!(subdivided_word(25, 100), 0x4000);
/// ```
#[must_use]
pub fn subdivided_word(since: u32, period: u32) -> u16 {
    let quotient = (u64::from(since) << 16) / u64::from(period.max(1));
    u16::try_from(quotient).unwrap_or(u16::MAX)
}

/// Two fractions off by more than a quarter may be taken for the next whole pulse.
const MOST_SPEED_PULSES: f64 = 0.25;

pub(super) fn measure(pulses: &Pulses, setup: &Setup) -> Result<(Vec<Sample>, Limits), Error> {
    let (input_s, gearing) = (pulses.input_s(), setup.gearing);
    // The first input period is the first one that can be measured against.
    let placed: Vec<(usize, usize)> =
        pulses.placed().into_iter().filter(|(_, last)| 0 < *last).collect();
    let Some(&(first_output, _)) = placed.first() else {
        return Err(Error::TooFewSamples { found: 0, expected: 2 });
    };
    let mut behind: Option<f64> = None;
    let mut samples = Vec::with_capacity(placed.len());
    let mut speed_pulses: f64 = 0.0;
    for (output, last) in placed {
        let last_tick = setup.ticks(input_s[last]);
        let since = setup.ticks(pulses.output_s()[output]) - last_tick;
        let period = last_tick - setup.ticks(input_s[last - 1]);
        let running = setup.ticks(input_s[last + 1]) - last_tick;
        let by_last_speed = quotient(since, period) - quotient(since, running);
        speed_pulses = speed_pulses.max(by_last_speed.abs());
        let phase = gearing.nominal(output - first_output).1 - quotient(since, period);
        let before = behind.unwrap_or(phase);
        let now = phase + (before - phase).round();
        behind = Some(now);
        samples.push(Sample {
            time_s: pulses.output_s()[output],
            output_turns: gearing.output_turns(output),
            error_rad: now * gearing.input_pulse_rad(),
        });
    }
    if MOST_SPEED_PULSES < speed_pulses {
        return Err(Error::MethodCannot {
            method: "subdivided",
            reason: format!(
                "takes the speed as that of the last period, which puts a fraction off by {speed_pulses:.2} of an input pulse here, expected {MOST_SPEED_PULSES} or less\nhint: `subdivided-counting` takes a speed that changes"
            ),
        });
    }
    let bound_pulses = fraction_bound_pulses(pulses, setup) + 2.0 * speed_pulses;
    let limits = Limits {
        resolution_rad: tick_rad(pulses, setup),
        range_rad: None,
        step_rad: Some(gearing.input_pulse_rad() / 2.0),
        samples_per_turn: super::gearing::float(gearing.output_lines),
        bound_rad: bound_pulses * gearing.input_pulse_rad(),
        in_words: "any ratio, no 360° limit; misreads a change of half an input pulse between two samples, and takes the speed as that of the last period",
    };
    Ok((samples, limits))
}

#[cfg(test)]
mod tests {
    use super::subdivided_word;

    #[test]
    fn the_word_saturates_when_the_input_slows_down() {
        assert_eq!(subdivided_word(150, 100), u16::MAX);
        assert_eq!(subdivided_word(99, 100), 64_880);
        assert_eq!(subdivided_word(5, 0), u16::MAX);
    }
}
