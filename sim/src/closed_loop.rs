//! Plant and logic meet: the closed loop, a pass in it, and what both passes come to.

mod appraisal;
mod feedback;
mod findings;
mod grinder;
mod illustrate;
mod pass;
mod pins;
mod probe;
mod process;
mod recorder;
mod simulate;
mod swing;
#[cfg(test)]
mod tests;
mod under_way;
mod waveform_file;

pub use appraisal::{
    Hunting, LeadAppraisal, appraise_lead, fastest_um_per_s, measure_hunting, peak_to_peak,
};
pub use feedback::{ClosedLoop, Sample};
pub use findings::{Findings, PassFindings};
pub use grinder::Grinder;
pub use illustrate::{Illustrations, illustrate};
pub use pass::{Pass, PassPlan, Playback, Trace, run_pass};
pub(crate) use pass::{measuring, reset};
pub use pins::{PULSE_CLOCKS, PulsePin, clock_of, time_of};
#[cfg(test)]
pub(crate) use probe::Recording;
pub use probe::{Analogue, Change, Probe, Seen, Watch, Waveform, signals_of};
pub use process::{Place, Process};
pub(crate) use recorder::reading_um;
pub use recorder::{Comparison, Recorder, unwrap_um};
pub(crate) use simulate::ready;
pub use simulate::{Course, Options, Simulation, View, simulate, simulate_watched};
pub use swing::{Progress, Swing};
pub use under_way::UnderWay;
pub use waveform_file::{ANALOGUE, SHOWN_FIRST, TICK, WaveformFile, write_vcd};
