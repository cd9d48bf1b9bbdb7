//! The only place where plant and logic meet.
//!
//! No time grid: the plant says when the next line and the next fringe come, the logic runs there
//! clock by clock, and a step of the motor moves the table at the very clock edge that made it, so
//! that the fringes after it come earlier or later.

use helixlock_netlist::SignalId;

use super::pins::{PulsePin, time_of};
use super::probe::{Analogue, Probe, Recording, Waveform};
use super::process::{Place, Process};
use super::recorder::{Comparison, Recorder};
use crate::Error;
use crate::device::DevicePins;
use crate::engine::{Engine, Stop};

/// One comparison and where the machine was when the meter's pulse ended.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// What the meter did.
    pub comparison: Comparison,
    /// When its pulse ended, s: the instant its width speaks of.
    pub time_s: f64,
    /// Where the machine was then.
    pub place: Place,
    /// Net steps then, forward positive.
    pub steps: i64,
}

/// The device and the machine, joined.
#[derive(Debug)]
pub struct ClosedLoop<E, P> {
    engine: E,
    process: P,
    pins: DevicePins,
    clock_hz: f64,
    grating: PulsePin,
    laser: PulsePin,
    meter: Meter,
    recording: Option<Recording>,
    moving: bool,
    watched: Vec<SignalId>,
    /// Comparisons so far.
    pub samples: Vec<Sample>,
    /// Net steps since the start, forward positive.
    pub steps: i64,
    /// All steps taken, either way.
    pub steps_taken: u64,
    /// The counter has saturated at least once.
    pub fault_seen: bool,
}

/// What the outputs were when last looked at.
#[derive(Clone, Copy, Debug, Default)]
struct Meter {
    recorder: Recorder,
    full_scale_um: f64,
    t1: bool,
    dividing: bool,
    stepping: bool,
    ended: Option<(f64, Place, i64)>,
    reading_um: f64,
}

impl<E: Engine, P: Process> ClosedLoop<E, P> {
    /// Joins them; `full_scale_um` is the table travel of one turn of phase.
    ///
    /// # Errors
    ///
    /// [`Error::NoSignal`] when the engine does not run the device.
    pub fn new(engine: E, process: P, clock_hz: f64, full_scale_um: f64) -> Result<Self, Error> {
        let pins = DevicePins::find(engine.netlist())?;
        let watched = vec![pins.t1, pins.grating_divided, pins.step, pins.measuring, pins.zero];
        let mut this = Self {
            engine,
            process,
            pins,
            clock_hz,
            grating: PulsePin::new("grating"),
            laser: PulsePin::new("laser"),
            meter: Meter { full_scale_um, ..Meter::default() },
            recording: None,
            moving: false,
            watched,
            samples: Vec::new(),
            steps: 0,
            steps_taken: 0,
            fault_seen: false,
        };
        this.engine.watch(&this.watched);
        Ok(this)
    }

    /// The engine, to set switches and read signals.
    pub fn engine(&mut self) -> &mut E {
        &mut self.engine
    }

    /// The device's ports.
    #[must_use]
    pub fn pins(&self) -> DevicePins {
        self.pins
    }

    /// Looks at signals from now on, until [`ClosedLoop::end_recording`].
    pub fn begin_recording(&mut self, probe: Probe) {
        let mut watched = self.watched.clone();
        watched.extend(&probe.signals);
        self.engine.watch(&watched);
        self.recording = Some(Recording::new(self.engine.netlist(), probe));
    }

    /// What has been seen since [`ClosedLoop::begin_recording`].
    pub fn end_recording(&mut self) -> Option<Waveform> {
        self.engine.watch(&self.watched);
        self.recording.take().map(|recording| recording.waveform)
    }

    /// What has been seen so far, between [`ClosedLoop::begin_recording`] and
    /// [`ClosedLoop::end_recording`].
    pub(crate) fn recorded(&mut self) -> Option<&mut Waveform> {
        self.recording.as_mut().map(|recording| &mut recording.waveform)
    }

    /// Where the machine is now.
    pub fn place(&mut self) -> Place {
        self.process.place(time_of(self.engine.clock(), self.clock_hz))
    }

    /// FPGA clock, Hz.
    #[must_use]
    pub fn clock_hz(&self) -> f64 {
        self.clock_hz
    }

    /// Lets the machine begin to move: lines and fringes come from now on.
    ///
    /// # Errors
    ///
    /// As [`ClosedLoop::run_until`].
    pub fn set_moving(&mut self) -> Result<(), Error> {
        self.moving = true;
        self.plan_line()?;
        self.plan_fringe()
    }

    /// Holds the machine: no more lines and fringes.
    pub fn hold(&mut self) {
        self.moving = false;
        self.grating.cancel();
        self.laser.cancel();
    }

    /// Runs to a clock number, or until `enough` says so after a watched output has changed.
    ///
    /// # Errors
    ///
    /// [`Error::PulsesTooFast`], [`Error::WaveformFull`], or [`Error::Effect`] when an effect has a
    /// value that no machine could follow.
    pub fn run_until(
        &mut self,
        clock: u64,
        mut enough: impl FnMut(&mut E) -> bool,
    ) -> Result<(), Error> {
        while self.engine.clock() < clock {
            self.sample()?;
            let mut next = self.next_input_change().map_or(clock, |change| change.min(clock));
            if self.meter.stepping {
                next = next.min(self.engine.clock() + 1);
            }
            let stop = self.engine.run_until(next);
            if stop == Stop::Changed || self.meter.stepping {
                self.observe()?;
            }
            self.drive_inputs()?;
            if stop == Stop::Changed && enough(&mut self.engine) {
                break;
            }
        }
        self.process.failure().map_or(Ok(()), |failure| Err(failure.into()))
    }

    fn next_input_change(&self) -> Option<u64> {
        // No list of two: it would be written to be read at once, which costs more than the rest.
        match (self.grating.next_change(), self.laser.next_change()) {
            (Some(line), Some(fringe)) => Some(line.min(fringe)),
            (line, fringe) => line.or(fringe),
        }
    }

    /// Puts the pulses due now on the pins, and plans the next ones.
    fn drive_inputs(&mut self) -> Result<(), Error> {
        let clock = self.engine.clock();
        if self.grating.next_change() == Some(clock) {
            let risen = self.grating.change(clock);
            self.engine.set_input(self.pins.grating, u64::from(self.grating.is_high()));
            if risen {
                self.process.pass_line();
                self.plan_line()?;
            }
        }
        if self.laser.next_change() == Some(clock) {
            let risen = self.laser.change(clock);
            self.engine.set_input(self.pins.laser, u64::from(self.laser.is_high()));
            if risen {
                self.process.pass_fringe();
                self.plan_fringe()?;
            }
        }
        Ok(())
    }

    fn plan_line(&mut self) -> Result<(), Error> {
        let time_s = self.process.next_line_s();
        plan(&mut self.grating, time_s, self.engine.clock(), self.clock_hz)
    }

    fn plan_fringe(&mut self) -> Result<(), Error> {
        let time_s = self.process.next_fringe_s();
        plan(&mut self.laser, time_s, self.engine.clock(), self.clock_hz)
    }

    /// Takes note of what the last edge did to the outputs, and lets the motor act.
    fn observe(&mut self) -> Result<(), Error> {
        let clock = self.engine.clock();
        let [t1, dividing, stepping] = [self.pins.t1, self.pins.grating_divided, self.pins.step]
            .map(|pin| self.engine.value(pin) == 1);
        if dividing && !self.meter.dividing {
            self.end_comparison(clock);
        }
        self.meter.dividing = dividing;
        if t1 != self.meter.t1 {
            self.meter.t1 = t1;
            self.meter.recorder.meter(clock, t1);
            if !t1 {
                self.meter.ended = Some(self.now());
            }
        }
        self.meter.stepping = stepping;
        if stepping {
            self.step()?;
        }
        Ok(())
    }

    /// The table follows the motor at once, and so do the fringes.
    fn step(&mut self) -> Result<(), Error> {
        let forward = self.engine.value(self.pins.forward) == 1;
        let time_s = time_of(self.engine.clock(), self.clock_hz);
        self.process.step(time_s, forward);
        self.steps += if forward { 1 } else { -1 };
        self.steps_taken += 1;
        self.fault_seen |= self.engine.value(self.pins.fault) == 1;
        if self.moving { self.plan_fringe() } else { Ok(()) }
    }

    fn now(&mut self) -> (f64, Place, i64) {
        let time_s = time_of(self.engine.clock(), self.clock_hz);
        (time_s, self.process.place(time_s), self.steps)
    }

    fn end_comparison(&mut self, clock: u64) {
        let ended = self.meter.ended.take();
        if let Some(comparison) = self.meter.recorder.compare(clock) {
            let (time_s, place, steps) = ended.unwrap_or_else(|| self.now());
            self.meter.reading_um = comparison.error_um(self.meter.full_scale_um);
            self.samples.push(Sample { comparison, time_s, place, steps });
        }
    }

    fn sample(&mut self) -> Result<(), Error> {
        let Some(recording) = &mut self.recording else { return Ok(()) };
        let clock = self.engine.clock();
        let time_s = time_of(clock, self.clock_hz);
        let place = self.process.place(time_s);
        let analogue = Analogue {
            clock,
            position_mm: place.position_mm,
            lead_error_um: place.lead_error_um,
            correction_um: place.correction_um,
            error_um: self.meter.reading_um,
        };
        if recording.sample(&mut self.engine, analogue) {
            return Ok(());
        }
        Err(Error::WaveformFull { changes: recording.waveform.changes.len(), time_s })
    }
}

/// Plans a pulse; an instant that never comes plans none.
fn plan(pin: &mut PulsePin, time_s: f64, now: u64, clock_hz: f64) -> Result<(), Error> {
    if time_s.is_finite() {
        return pin.plan(time_s, now, clock_hz);
    }
    pin.cancel();
    Ok(())
}
