//! One grinding pass, from power-up to the last line, and what it leaves behind.

use helixlock_plant::LowPass;

use super::feedback::ClosedLoop;
use super::pins::{clock_of, time_of};
use super::probe::{Probe, Watch};
use super::process::Process;
use super::recorder::unwrap_um;
use crate::Error;
use crate::device::DevicePins;
use crate::engine::Engine;

/// Clocks for which the master reset is held, longer than any synchroniser.
const RESET_CLOCKS: u64 = 16;

/// Clocks between two words to whoever shows the progress: a tenth of a second at 12 MHz.
const PROGRESS_CLOCKS: u64 = 1_200_000;

/// Clocks of one piece of a waveform: if each of some 300 signals changed at each of them, 60 MB.
const PIECE_CLOCKS: u64 = 8_192;

/// What to do in a pass.
#[derive(Clone, Copy, Debug)]
pub struct PassPlan {
    /// FPGA clock, Hz.
    pub clock_hz: f64,
    /// When the pass ends, s.
    pub end_s: f64,
    /// Table travel of one turn of phase, µm: `range · B · λ/2`.
    pub full_scale_um: f64,
    /// Cut-off of the recorder's low-pass, Hz.
    pub cutoff_hz: Option<f64>,
    /// Loop closed: the switch stands on "correct" once the initial phase is selected.
    pub correct: bool,
    /// After the pass, steps are played back until the counter is zero; gives up after this, s.
    pub playback_s: Option<f64>,
}

/// Columns of equal length, one row a comparison.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trace {
    /// End of the meter's pulse, s since the start of the pass.
    pub time_s: Vec<f64>,
    /// Nominal position on the workpiece then, mm.
    pub position_mm: Vec<f64>,
    /// Recorder, raw, jumps of the range drawn on, µm: positive when the laser lags.
    pub error_um: Vec<f64>,
    /// Recorder behind its low-pass, µm.
    pub filtered_error_um: Vec<f64>,
    /// Net steps, forward positive.
    pub steps: Vec<i64>,
    /// Workpiece, µm: positive when the thread is longer than nominal.
    pub lead_error_um: Vec<f64>,
}

/// What a pass leaves behind.
#[derive(Clone, Debug, Default)]
pub struct Pass {
    /// One row a comparison.
    pub trace: Trace,
    /// Clocks simulated, playback included.
    pub clocks: u64,
    /// Steps taken in the pass, either way.
    pub steps_taken: u64,
    /// Net steps at the end of the pass, forward positive.
    pub steps_net: i64,
    /// Times the recorder jumped by its whole range.
    pub jumps: usize,
    /// The counter has saturated.
    pub fault: bool,
    /// What playing back took, if it was asked for.
    pub playback: Option<Playback>,
}

/// How the motor went home.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Playback {
    /// Steps it took.
    pub steps: u64,
    /// How long, s.
    pub duration_s: f64,
    /// Net steps left; 0 when the counter has reached zero.
    pub left: i64,
}

/// Runs a pass on an engine at power-up whose settings are on its inputs.
///
/// `watch` is told what it looks at, `progress` how many clocks are done.
///
/// # Errors
///
/// [`Error::PulsesTooFast`], [`Error::NoSignal`] when the engine does not run the device, or what
/// `watch` answers.
pub fn run_pass<E: Engine>(
    engine: E,
    process: impl Process,
    plan: PassPlan,
    watch: Option<Watch<'_>>,
    progress: &mut dyn FnMut(u64),
) -> Result<Pass, Error> {
    let mut device = ClosedLoop::new(engine, process, plan.clock_hz, plan.full_scale_um)?;
    let end = clock_of(plan.end_s, plan.clock_hz);
    let mut course = Course { watch, progress };
    reset(&mut device)?;
    device.set_moving()?;
    course.run(&mut device, end, Some(measuring))?;
    let pins = device.pins();
    device.engine().set_input(pins.correct, u64::from(plan.correct));
    course.run(&mut device, end, None)?;
    // A window that ends with the pass must not see the playback.
    device.end_recording();
    device.hold();
    let (steps_taken, steps_net) = (device.steps_taken, device.steps);
    let playback = plan.playback_s.map(|limit_s| play_back(&mut device, limit_s)).transpose()?;
    let (trace, jumps) = read_out(&device, &plan);
    let fault = device.fault_seen;
    let clocks = device.engine().clock();
    Ok(Pass { trace, clocks, steps_taken, steps_net, jumps, fault, playback })
}

/// Clears the device and lets the initial phase selection wait for its first laser pulse.
pub(crate) fn reset<E: Engine, P: Process>(device: &mut ClosedLoop<E, P>) -> Result<(), Error> {
    let pins = device.pins();
    device.engine().set_input(pins.master_reset, 1);
    device.run_until(RESET_CLOCKS, |_| false)?;
    device.engine().set_input(pins.master_reset, 0);
    device.engine().set_input(pins.start, 1);
    Ok(())
}

type Condition<E> = fn(&mut E, DevicePins) -> bool;

pub(crate) fn measuring<E: Engine>(engine: &mut E, pins: DevicePins) -> bool {
    engine.value(pins.measuring) == 1
}

/// A run in pieces: between them progress is told, and what has been seen.
struct Course<'a, 'b> {
    watch: Option<Watch<'a>>,
    progress: &'b mut dyn FnMut(u64),
}

impl Course<'_, '_> {
    fn run<E: Engine, P: Process>(
        &mut self,
        device: &mut ClosedLoop<E, P>,
        end: u64,
        enough: Option<Condition<E>>,
    ) -> Result<(), Error> {
        let pins = device.pins();
        let is_enough = |engine: &mut E| enough.is_some_and(|enough| enough(engine, pins));
        loop {
            let now = device.engine().clock();
            if now >= end || is_enough(device.engine()) {
                return Ok(());
            }
            self.open_or_close_window(device, now);
            device.run_until(self.next_mark(now).min(end), is_enough)?;
            self.tell(device)?;
        }
    }

    fn tell<E: Engine, P: Process>(&mut self, device: &mut ClosedLoop<E, P>) -> Result<(), Error> {
        (self.progress)(device.engine().clock());
        if let (Some(watch), Some(piece)) = (&mut self.watch, device.recorded()) {
            (watch.seen)(piece).map_err(Error::NotTaken)?;
            piece.clear();
        }
        Ok(())
    }

    fn open_or_close_window<E: Engine, P: Process>(&self, device: &mut ClosedLoop<E, P>, now: u64) {
        let Some(Watch { probe, .. }) = &self.watch else { return };
        let (within, recording) = (probe.window.contains(&now), device.recorded().is_some());
        if within && !recording {
            device.begin_recording((*probe).clone());
        } else if !within && recording {
            device.end_recording();
        }
    }

    fn next_mark(&self, now: u64) -> u64 {
        let Some(Watch { probe: Probe { window, .. }, .. }) = &self.watch else {
            return now + PROGRESS_CLOCKS;
        };
        let piece = if window.contains(&now) { PIECE_CLOCKS } else { PROGRESS_CLOCKS };
        [window.start, window.end].into_iter().filter(|&end| now < end).fold(now + piece, u64::min)
    }
}

/// Turns the reset switch and waits for zero, with the machine at rest.
fn play_back<E: Engine, P: Process>(
    device: &mut ClosedLoop<E, P>,
    limit_s: f64,
) -> Result<Playback, Error> {
    let pins = device.pins();
    let (begin, taken) = (device.engine().clock(), device.steps_taken);
    device.engine().set_input(pins.correct, 0);
    device.engine().set_input(pins.playback, 1);
    let clock_hz = device.clock_hz();
    let limit = begin + clock_of(limit_s, clock_hz);
    // The switch is synchronised first; a counter at zero stays there.
    device.run_until(begin + RESET_CLOCKS, |_| false)?;
    let home = |engine: &mut E| engine.value(pins.zero) == 1;
    if !home(device.engine()) {
        device.run_until(limit, home)?;
    }
    let duration_s = time_of(device.engine().clock() - begin, clock_hz);
    Ok(Playback { steps: device.steps_taken - taken, duration_s, left: device.steps })
}

/// Makes columns of the comparisons.
fn read_out<E: Engine, P: Process>(device: &ClosedLoop<E, P>, plan: &PassPlan) -> (Trace, usize) {
    let samples = &device.samples;
    let mut trace = Trace {
        time_s: samples.iter().map(|sample| sample.time_s).collect(),
        position_mm: samples.iter().map(|sample| sample.place.position_mm).collect(),
        error_um: samples.iter().map(|s| s.comparison.error_um(plan.full_scale_um)).collect(),
        filtered_error_um: Vec::new(),
        steps: samples.iter().map(|sample| sample.steps).collect(),
        lead_error_um: samples.iter().map(|sample| sample.place.lead_error_um).collect(),
    };
    let jumps = unwrap_um(&mut trace.error_um, plan.full_scale_um);
    trace.filtered_error_um = match plan.cutoff_hz {
        Some(cutoff_hz) => LowPass::with_cutoff(cutoff_hz).pass(&trace.time_s, &trace.error_um),
        None => trace.error_um.clone(),
    };
    (trace, jumps)
}
