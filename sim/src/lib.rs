//! Cycle-accurate simulation of the device in closed loop with the machine.

#[cfg(test)]
mod adversary;
#[cfg(test)]
mod agreement;
mod appraisal;
mod certify;
mod circuit;
mod closed_loop;
mod compiled;
mod device;
mod device_pins;
mod engine;
mod error;
pub mod faults;
mod findings;
mod grinder;
mod historic_cell;
mod historic_device;
mod historic_loop;
mod illustrate;
mod interpreted_pieces;
mod interpreter;
#[allow(unsafe_code, reason = "vector instructions, after asking the processor for them")]
mod lanes;
mod leap;
mod moment;
mod parallel;
mod pass;
mod pins;
mod probe;
#[cfg(test)]
mod random_design;
mod recorder;
#[cfg(test)]
mod samples;
mod settings;
mod simulate;
mod state;
pub mod sweep;
mod swing;
mod tap;
mod vcd_file;
#[allow(unsafe_code, reason = "vector instructions have no other way in")]
#[allow(clippy::inline_always, reason = "in a function of its own it would lack the instructions")]
mod vector;
mod wheels;
#[allow(dead_code, reason = "a design may do without shifts")]
mod words;

pub use appraisal::{
    Hunting, LeadAppraisal, appraise_lead, fastest_um_per_s, measure_hunting, peak_to_peak,
};
pub use certify::{
    BothClosed, Certificate, FLIP_FLOP, FlipFlop, OpenLoop, certify, mtbf_log10_years,
};
pub use circuit::Circuit;
pub use closed_loop::{ClosedLoop, Place, Process, Sample};
pub use compiled::{Compiled, DenseKernel};
pub use device::{DeviceEngine, DeviceKernel, device, device_engine, device_lanes, stepped_device};
pub use device_pins::DevicePins;
pub use engine::{Engine, Stop};
pub use error::Error;
pub use findings::{Findings, PassFindings};
pub use grinder::Grinder;
pub use historic_cell::{Delays, TTL};
pub use illustrate::{Illustrations, illustrate};
pub use interpreted_pieces::InterpretedPieces;
pub use interpreter::Interpreter;
pub use lanes::{LANE_WORDS, LANES, Lane, LaneKernel, Lanes};
pub use leap::Leap;
pub use moment::{Coasting, Kernel, Moment};
pub use parallel::parallel;
pub use pass::{Pass, PassPlan, Playback, Trace, run_pass};
pub use pins::{PULSE_CLOCKS, PulsePin, clock_of, time_of};
pub use probe::{Analogue, Change, Probe, Waveform, signals_of};
pub use recorder::{Comparison, Recorder, unwrap_um};
pub use settings::{Dialled, SettingsError, settings_for};
pub use simulate::{Course, Options, Simulation, simulate};
pub use state::{FlipFlops, Snapshot, SnapshotError, differences};
pub use swing::{Progress, Swing};
pub use vcd_file::{ANALOGUE, SHOWN_FIRST, write_vcd};
pub use vector::Vector;
pub use wheels::set_wheels;
