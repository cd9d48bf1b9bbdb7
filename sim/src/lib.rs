//! Cycle-accurate simulation of the device in closed loop with the machine.

mod campaigns;
mod closed_loop;
mod device;
mod engine;
mod error;
mod historic;

pub use campaigns::{
    BothClosed, Certificate, DelaySet, Drawn, FLIP_FLOP, FlipFlop, GateWaves, OpenLoop, WholeGates,
    blocks, certify, certify_gates, faults, gate_waves, mtbf_log10_years, parallel, sweep,
};
pub use closed_loop::{
    ANALOGUE, Analogue, Change, ClosedLoop, Comparison, Course, Findings, Grinder, Hunting,
    Illustrations, LeadAppraisal, Options, PULSE_CLOCKS, Pass, PassFindings, PassPlan, Place,
    Playback, Probe, Process, Progress, PulsePin, Recorder, SHOWN_FIRST, Sample, Seen, Simulation,
    Swing, TICK, Trace, UnderWay, View, Watch, Waveform, WaveformFile, appraise_lead, clock_of,
    fastest_um_per_s, illustrate, measure_hunting, peak_to_peak, run_pass, signals_of, simulate,
    simulate_watched, time_of, unwrap_um, write_vcd,
};
pub use device::{
    DeviceEngine, DeviceKernel, DevicePins, Dialled, device, device_engine, device_lanes, library,
    set_wheels, settings_for, stepped_device,
};
pub use engine::{
    AllSignals, Circuit, Coast, Coasting, Compiled, DenseKernel, Edge, Engine, FlipFlops, Gather,
    InterpretedPieces, Interpreter, Kernel, Known, LANE_WORDS, LANES, Lane, LaneKernel, Lanes,
    Leap, Leaping, Moment, Rest, Snapshot, SnapshotError, Stop, Vector, differences,
};
pub use error::{Error, SettingsError};
pub use historic::{Delays, TTL};
