//! What can go wrong between a machine file and its run.

use helixlock_plant::{EffectError, Lead, Part};
use helixlock_rtl::settings::SettingsError as WheelError;
use thiserror::Error;

/// A machine that cannot be simulated, or a window that is not there.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// The device cannot serve the machine.
    #[error(transparent)]
    Settings(#[from] SettingsError),
    /// An effect lacks something.
    #[error(transparent)]
    Effect(#[from] EffectError),
    /// A wheel cannot show its number.
    #[error(transparent)]
    Wheels(#[from] WheelError),
    /// A figure of the original cannot be run.
    #[error(transparent)]
    Original(#[from] helixlock_original::Error),
    /// Lines or fringes come faster than the FPGA clock can sample them.
    #[error(
        "{input}: pulses at {time_s:.6} s come too fast for a clock of {clock_hz} Hz, \
         expected at least four clocks from one to the next"
    )]
    PulsesTooFast {
        /// Input pin.
        input: &'static str,
        /// When, s.
        time_s: f64,
        /// FPGA clock, Hz.
        clock_hz: f64,
    },
    /// The gates of the original have the x2 range only.
    #[error("the gates of the original have a standard square wave at range 2 only, found range 1")]
    NoGates,
    /// The pass is over before the meter has compared anything.
    #[error(
        "the pass ends after {length_mm} mm, before the first comparison, expected a longer one"
    )]
    NoComparison {
        /// Length of the pass.
        length_mm: f64,
    },
    /// The design lacks a signal that the closed loop needs.
    #[error("the design has no signal `{path}`")]
    NoSignal {
        /// Path of the signal.
        path: String,
    },
    /// No scope or signal of that name.
    #[error("scope `{scope}` is not in the design, expected one of: {}", .known.join(", "))]
    NoScope {
        /// What was asked for.
        scope: String,
        /// Scopes there are.
        known: Vec<String>,
    },
    /// More changes than memory should hold.
    #[error(
        "waveform: {changes} changes up to {time_s:.6} s, expected a shorter window or fewer scopes"
    )]
    WaveformFull {
        /// How many.
        changes: usize,
        /// How far they reach, s.
        time_s: f64,
    },
    /// Who was told the waveform could not take it.
    #[error("the waveform was not taken")]
    NotTaken(#[source] std::io::Error),
    /// The window shows nothing of the run.
    #[error("window from {from_s} s to {to_s} s: expected a part of 0 s to {end_s} s")]
    Window {
        /// Asked for, s.
        from_s: f64,
        /// Asked for, s.
        to_s: f64,
        /// End of the run, s.
        end_s: f64,
    },
}

/// A machine file that no setting of the device serves.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum SettingsError {
    /// Steps come faster, or slower, than the step clock can be set.
    #[error(
        "drive.frequency: {found_hz} Hz, expected {low_hz:.3} Hz to {high_hz} Hz with an FPGA clock \
         of {clock_hz} Hz"
    )]
    StepFrequency {
        /// In the file.
        found_hz: f64,
        /// Slowest that can be set.
        low_hz: f64,
        /// Fastest that can be set.
        high_hz: f64,
        /// FPGA clock.
        clock_hz: f64,
    },
    /// More compensation than one pulse in 1000.
    #[error(
        "dividers.compensation: {found_um_per_m} µm/m, expected at most ±1000 µm/m, one pulse in \
         1000"
    )]
    Compensation {
        /// In the file.
        found_um_per_m: f64,
    },
    /// A rotary chain has no table, so there is nothing to correct.
    #[error("output.rotary: the device corrects the table of a grinder, expected a workpiece")]
    Rotary,
    /// The machine has no correction device, or only a part of it.
    #[error("the device needs {part}; a machine without it is compared with data, not simulated")]
    Part {
        /// What the machine file does not describe.
        part: Part,
    },
    /// The dividers stand for another lead, so that the corrector runs to its end.
    #[error(
        "dividers `a = {a}`, `b = {b}` do not fit the lead of {lead}: they leave {left_um_per_m:.0} \
         µm/m, expected at most ±{most_um_per_m} µm/m\n\nhint: `helixlock dividers --lead \"{lead}\"` finds those that do"
    )]
    Dividers {
        /// Grating divider.
        a: u16,
        /// Laser divider.
        b: u16,
        /// Lead of the workpiece.
        lead: Lead,
        /// What they leave, µm/m.
        left_um_per_m: f64,
        /// What the compensator can take out, µm/m.
        most_um_per_m: f64,
    },
}
