//! Loop open: both devices get the same instants of lines and fringes.

use std::cell::RefCell;
use std::rc::Rc;

use helixlock_plant::EffectError;
use helixlock_rtl::settings::Settings;

use crate::Error;
use crate::closed_loop::{ClosedLoop, Place, Probe, Process, clock_of, reset, signals_of, time_of};
use crate::device::{device_engine, set_wheels};
use crate::engine::Engine;
use crate::historic::{HistoricComparison, HistoricDevice, TTL};

use super::GATE_CLOCKS;
use super::seen::{SEEN, Seen, seen};

/// What two devices with the same lines and fringes made of them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OpenLoop {
    /// Comparisons compared.
    pub comparisons: usize,
    /// Largest difference of the meter's reading, as time between its edges, s.
    pub largest_s: f64,
    /// The same where the laser's edge is at the ends of the period, as close as a clock and the
    /// old flip-flop, which swallows the shortest pulses; not among the others.
    pub largest_at_ends_s: f64,
    /// Root mean square of the difference, s.
    pub rms_s: f64,
    /// Comparisons with another decision.
    pub other_decisions: usize,
    /// Largest distance of the laser's edge from the middle, or from the ends, among those, s.
    pub other_decision_s: f64,
    /// Comparisons whose laser edge is within a clock of the middle, or of the period's ends.
    pub coincidences: usize,
    /// Clock pulses of the old flip-flop that were too short for it.
    pub runts: u64,
}

/// Runs both devices on what `process` brings.
///
/// `progress` is told how many clocks are done.
pub(super) fn run_open(
    settings: &Settings,
    process: impl Process,
    clock_hz: f64,
    end_s: f64,
    progress: &mut dyn FnMut(u64),
) -> Result<OpenLoop, Error> {
    let historic = HistoricDevice::new(*settings, GATE_CLOCKS / clock_hz);
    let historic = Rc::new(RefCell::new(historic));
    let both = Both { process, historic: Rc::clone(&historic) };
    let synchronous = run_synchronous(settings, both, clock_hz, end_s, progress)?;
    let (old, runts) = historic.borrow().comparisons(TTL);
    let differences: Vec<_> = synchronous
        .iter()
        .zip(&old)
        .map(|(new, old)| Difference::of(*new, old, clock_hz, 1.0 / clock_hz + TTL.flip_flop_s))
        .collect();
    Ok(OpenLoop { runts, ..summary(&differences, 1.0 / clock_hz) })
}

/// Comparisons of the synchronous device.
pub(super) fn run_synchronous(
    settings: &Settings,
    process: impl Process,
    clock_hz: f64,
    end_s: f64,
    progress: &mut dyn FnMut(u64),
) -> Result<Vec<Seen>, Error> {
    let mut engine = device_engine();
    set_wheels(&mut engine, settings)?;
    let mut device = ClosedLoop::new(engine, process, clock_hz, 1.0)?;
    let end = clock_of(end_s, clock_hz);
    let signals = signals_of(device.engine().netlist(), &SEEN.map(str::to_owned))?;
    reset(&mut device)?;
    device.begin_recording(Probe { signals, window: 0..end });
    device.set_moving()?;
    let mut clock = 0;
    while clock < end {
        clock = (clock + end.div_ceil(100)).min(end);
        device.run_until(clock, |_| false)?;
        progress(clock);
    }
    let waveform = device.end_recording().unwrap_or_default();
    Ok(seen(&device.samples, &waveform))
}

/// Where the two devices differ in one comparison.
pub(super) struct Difference {
    /// Of the meter's readings, as a time, s: those of the duty cycle, for the meter shows the mean
    /// of its pulse. Just below 360° and just above 0° are the same phase.
    pub(super) width_s: f64,
    /// The laser's edge is at the ends of the period, where the old flip-flop swallows pulses.
    pub(super) at_ends: bool,
    /// Distance of the laser's edge from the nearest coincidence, s.
    from_coincidence_s: f64,
    /// The decisions are not the same.
    decision: bool,
}

impl Difference {
    /// `ends_s` is how near to the ends the old device swallows pulses.
    pub(super) fn of(new: Seen, old: &HistoricComparison, clock_hz: f64, ends_s: f64) -> Self {
        let period_s = time_of(new.clocks, clock_hz);
        let turns = time_of(new.high, clock_hz) / period_s - old.high_s / old.period_s;
        let from_middle_s = old.behind_middle_s.map_or(f64::INFINITY, f64::abs);
        Self {
            width_s: libm::remainder(turns, 1.0).abs() * period_s,
            at_ends: old.from_ends_s < ends_s,
            from_coincidence_s: from_middle_s.min(old.from_ends_s),
            decision: new.forward != old.forward,
        }
    }
}

pub(super) fn summary(differences: &[Difference], clock_s: f64) -> OpenLoop {
    let largest = |chosen: &dyn Fn(&Difference) -> Option<f64>| {
        differences.iter().filter_map(chosen).fold(0.0, f64::max)
    };
    let squares: f64 = differences.iter().map(|one| one.width_s * one.width_s).sum();
    OpenLoop {
        comparisons: differences.len(),
        largest_s: largest(&|one| (!one.at_ends).then_some(one.width_s)),
        largest_at_ends_s: largest(&|one| one.at_ends.then_some(one.width_s)),
        rms_s: (squares / number(differences.len())).sqrt(),
        other_decisions: differences.iter().filter(|one| one.decision).count(),
        other_decision_s: largest(&|one| one.decision.then_some(one.from_coincidence_s)),
        coincidences: differences.iter().filter(|one| one.from_coincidence_s < clock_s).count(),
        runts: 0,
    }
}

#[expect(clippy::cast_precision_loss, reason = "a pass has some ten thousand comparisons")]
fn number(count: usize) -> f64 {
    count.max(1) as f64
}

/// A process whose every instant the historic device sees too.
#[derive(Debug)]
struct Both<P> {
    process: P,
    historic: Rc<RefCell<HistoricDevice>>,
}

impl<P: Process> Process for Both<P> {
    fn next_line_s(&mut self) -> f64 {
        self.process.next_line_s()
    }

    fn next_fringe_s(&mut self) -> f64 {
        self.process.next_fringe_s()
    }

    fn pass_line(&mut self) {
        let time_s = self.process.next_line_s();
        self.historic.borrow_mut().line(time_s);
        self.process.pass_line();
    }

    fn pass_fringe(&mut self) {
        let time_s = self.process.next_fringe_s();
        self.historic.borrow_mut().fringe(time_s);
        self.process.pass_fringe();
    }

    fn step(&mut self, time_s: f64, forward: bool) {
        self.process.step(time_s, forward);
    }

    fn place(&mut self, time_s: f64) -> Place {
        self.process.place(time_s)
    }

    fn failure(&self) -> Option<EffectError> {
        self.process.failure()
    }
}
