//! Pulse trains with a known transmission error.

use std::f64::consts::TAU;

use super::gearing::{Gearing, float};
use super::pulses::Pulses;
use crate::Error;
use crate::number::number;

/// A run of a modelled transmission with a uniformly turning input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Synthesis {
    /// Turns of the input a second.
    pub input_hz: f64,
    /// Turns of the output the run lasts.
    pub output_turns: f64,
}

/// Pulses of a run whose δ is known: `error_rad` gives it at a turn of the output.
///
/// The input is uniform, so its angle is the time; output pulse `j` stands at `θ2 = 2πj/λ2` and
/// comes when `θ1 = i·(θ2 − δ)`: closed, nothing is solved.
///
/// # Errors
///
/// When δ is so steep that an output pulse would come before the one ahead of it, or the run
/// holds fewer than four pulses.
pub fn synthesise(
    gearing: &Gearing,
    run: &Synthesis,
    error_rad: impl Fn(f64) -> f64,
) -> Result<Pulses, Error> {
    gearing.check()?;
    let ratio = float(gearing.ratio.0) / float(gearing.ratio.1);
    let input_turns = run.output_turns * ratio;
    let input_count = input_turns * float(gearing.input_lines);
    let input = (0..).map(number).take_while(|index| *index <= input_count);
    let input_s = input.map(|index| index / float(gearing.input_lines) / run.input_hz).collect();
    let output_count = run.output_turns * float(gearing.output_lines);
    let output = (0..).map(number).take_while(|index| *index <= output_count);
    let at = |index: f64| {
        let turns = index / float(gearing.output_lines);
        (turns - error_rad(turns) / TAU) * ratio / run.input_hz
    };
    Pulses::new(input_s, output.map(at).collect())
}
