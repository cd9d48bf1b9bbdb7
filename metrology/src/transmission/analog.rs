//! Analog phase comparison: a flip-flop and a recorder with a time constant.
//!
//! The flip-flop is set by the divided input and cleared by the divided output; the mean of what
//! it gives is the phase. The recorder makes the mean, as a first-order low-pass, and is late.

use super::divided::{Divided, divide};
use super::gearing::float;
use super::method::{Limits, Sample, Setup};
use super::pulses::Pulses;
use super::unevenness::fastest_pulses;
use crate::Error;
use crate::number::number;

pub(super) fn measure(pulses: &Pulses, setup: &Setup) -> Result<(Vec<Sample>, Limits), Error> {
    let divided = divide(pulses, setup, "analog")?;
    let gearing = setup.gearing;
    let range_rad = divided.range_pulses * gearing.input_pulse_rad();
    let samples = recorded(&divided, setup, range_rad);
    let steepest_rad_per_s = steepest(&samples);
    let period_s = longest_period(&divided);
    let limits = Limits {
        resolution_rad: 0.0,
        range_rad: Some(range_rad),
        step_rad: None,
        samples_per_turn: float(gearing.output_lines) / number(divided.divider),
        bound_rad: steepest_rad_per_s * (2.0 * setup.recorder_s + period_s)
            + range_rad * (ripple(period_s / setup.recorder_s) + 2.0 * divided.unevenness(pulses))
            + 4.0 * fastest_pulses(pulses, pulses.tick_s()) * gearing.input_pulse_rad(),
        in_words: "equal frequencies only; starts again beyond its range; the recorder lags by its time constant and lets some of the comparison frequency through",
    };
    Ok((samples, limits))
}

/// The recorder's reading at each set pulse.
///
/// It starts settled on the first duty cycle, as a recorder that has been on for a while.
fn recorded(divided: &Divided, setup: &Setup, range_rad: f64) -> Vec<Sample> {
    let pairs = divided.pairs();
    let mut samples = Vec::with_capacity(pairs.len());
    let mut reading: Option<f64> = None;
    for &(clear, set) in &pairs {
        let (from_s, next_s) = (divided.set_s[set], divided.set_s[set + 1]);
        let (high_s, whole_s) = (divided.clear_s[clear] - from_s, next_s - from_s);
        // High until the clear pulse, then low until the next set pulse.
        let after_high = |value: f64| 1.0 + (value - 1.0) * libm::exp(-high_s / setup.recorder_s);
        let low = libm::exp(-(whole_s - high_s) / setup.recorder_s);
        let settled = (1.0 - libm::exp(-high_s / setup.recorder_s)) * low
            / (1.0 - libm::exp(-whole_s / setup.recorder_s));
        let value = after_high(reading.unwrap_or(settled)) * low;
        reading = Some(value);
        samples.push(Sample {
            time_s: next_s,
            output_turns: setup.gearing.output_turns(divided.clear_pulse[clear]),
            error_rad: -value * range_rad,
        });
    }
    samples
}

fn longest_period(divided: &Divided) -> f64 {
    divided.set_s.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max)
}

/// Steepest change of a reading, rad/s.
fn steepest(samples: &[Sample]) -> f64 {
    let slope = |pair: &[Sample]| {
        ((pair[1].error_rad - pair[0].error_rad) / (pair[1].time_s - pair[0].time_s)).abs()
    };
    samples.windows(2).map(slope).fold(0.0, f64::max)
}

/// Largest ripple of a first-order low-pass on a duty cycle, of full scale; `x` is the period in
/// time constants: `(1 − e^(−x/2))/(1 + e^(−x/2))`, at 50 %.
fn ripple(x: f64) -> f64 {
    let half = libm::exp(-x / 2.0);
    (1.0 - half) / (1.0 + half)
}
