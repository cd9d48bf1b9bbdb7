//! The asynchronous device with a machine of its own, its loop closed.
//!
//! Lines and fringes come when the machine brings them, and the machine moves when the step
//! oscillator ticks: nothing else has a clock here. The oscillator is free-running in the print;
//! it gets the phase of the synchronous device's, so that both motors step at the same instants.

use helixlock_plant::EffectError;
use helixlock_rtl::settings::{Range, Settings};

use super::cell::TTL;
use super::device::{HistoricComparison, HistoricDevice, WatchedCell};
use crate::closed_loop::{Process, time_of};

/// The counter's end stop.
const MOST_STEPS: i64 = 4095;

/// The device of the print, joined to a machine.
#[derive(Debug)]
pub(crate) struct HistoricLoop<P> {
    process: P,
    device: HistoricDevice,
    cell: WatchedCell,
    ticks: Ticks,
    /// A period of one line has no middle, and nothing is ever decided.
    has_middle: bool,
    steps: i64,
    /// Net steps at the end of each comparison.
    steps_at_ends: Vec<i64>,
}

/// A step oscillator, by the clock of the device whose phase it has.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ticks {
    /// Clock of the next tick.
    pub(crate) next: u64,
    /// Clocks from tick to tick.
    pub(crate) period: u64,
    /// That clock, Hz.
    pub(crate) clock_hz: f64,
}

impl<P: Process> HistoricLoop<P> {
    /// Joins them; a line this soon after the gate opens does not pass.
    pub(crate) fn new(settings: Settings, gate_s: f64, ticks: Ticks, process: P) -> Self {
        Self {
            process,
            device: HistoricDevice::new(settings, gate_s),
            cell: WatchedCell::new(TTL),
            ticks,
            has_middle: settings.a > 1 || settings.range == Range::X2,
            steps: 0,
            steps_at_ends: Vec::new(),
        }
    }

    /// Runs to an instant, s; gives each comparison with the net steps at its end.
    ///
    /// # Errors
    ///
    /// An effect with a value that no machine could follow.
    pub(crate) fn run(mut self, end_s: f64) -> Result<Vec<(HistoricComparison, i64)>, EffectError> {
        let mut now_s = 0.0;
        while now_s < end_s {
            let line_s = self.process.next_line_s().max(now_s);
            let fringe_s = self.process.next_fringe_s().max(now_s);
            let tick_s = time_of(self.ticks.next, self.ticks.clock_hz);
            now_s = line_s.min(fringe_s).min(tick_s);
            if tick_s <= now_s {
                self.tick(now_s);
            } else if line_s <= now_s {
                self.device.line(now_s);
                self.process.pass_line();
            } else {
                self.device.fringe(now_s);
                self.process.pass_fringe();
            }
            self.compare();
        }
        if let Some(failure) = self.process.failure() {
            return Err(failure);
        }
        let comparisons = self.cell.comparisons().iter().copied();
        Ok(comparisons.zip(self.steps_at_ends).collect())
    }

    /// The cell takes the pulses that have just been counted.
    fn compare(&mut self) {
        for (time_s, pulse) in self.device.take_pulses() {
            self.cell.pulse(time_s, pulse);
        }
        self.steps_at_ends.resize(self.cell.comparisons().len(), self.steps);
    }

    /// The motor steps, once something is decided, up to the counter's end stop.
    fn tick(&mut self, time_s: f64) {
        self.ticks.next += self.ticks.period;
        self.cell.advance(time_s);
        let Some(forward) = self.cell.decision().filter(|_| self.has_middle) else { return };
        let steps = self.steps + if forward { 1 } else { -1 };
        if steps.abs() <= MOST_STEPS {
            self.steps = steps;
            self.process.step(time_s, forward);
        }
    }
}
