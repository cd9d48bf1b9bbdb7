//! The gates of the original, all of them, joined to a machine.
//!
//! Lines and fringes are pulses at the pins, and the machine moves when the step oscillator ticks.
//! With the ticks left out the loop is open.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use helixlock_original::{Circuit, Delays, Edge, Error as OriginalError, Finding, Net, Simulator};

use super::cell::{Change, Pulse};
use super::closed_loop::Ticks;
use super::device::{HistoricComparison, Reading};
use crate::Error;
use crate::closed_loop::{Process, time_of};

/// How long a pulse of a photocell, or a tick, is high, ps: the print does not say.
const PULSE_PS: u64 = 2_000_000;
/// Shortest pause behind it, ps.
const PAUSE_PS: u64 = 2_000_000;
/// From a comparison's pulse to the meter's rise, s: a NAND and the latch, typical.
const METER_RISES_S: f64 = 18e-9;

/// What a run of the gates was.
#[derive(Clone, Debug)]
pub(crate) struct GateRun {
    /// Each comparison with the net steps at its end.
    pub(crate) comparisons: Vec<(HistoricComparison, i64)>,
    /// Net steps that the motor took.
    pub(crate) steps: i64,
    /// What the reset counter shows in the end.
    pub(crate) counted: i64,
    /// Changes of outputs.
    pub(crate) events: u64,
    /// What the data sheets do not allow, and what was swallowed.
    pub(crate) findings: Vec<Finding>,
    /// Edges of every wire since power-up, where they are recorded.
    pub(crate) edges: Vec<Edge>,
}

/// The circuit with its machine.
#[derive(Debug)]
pub(crate) struct GateLoop<'a, P> {
    process: P,
    circuit: &'a Circuit,
    gates: Simulator<'a>,
    pins: Pins,
    ticks: Option<Ticks>,
    /// Pulses that are high, and until when.
    falls: BinaryHeap<Reverse<(u64, Net)>>,
    reading: Reading,
    begun: bool,
    decided: bool,
    steps: i64,
    steps_at_ends: Vec<i64>,
    /// Every edge, when it is recorded.
    recorded: Option<Vec<Edge>>,
}

#[derive(Clone, Copy, Debug)]
struct Pins {
    grating: Net,
    laser: Net,
    tick: Net,
    forward: Net,
    /// Outputs whose edges are read.
    start: Net,
    middle: Net,
    laser_start: Net,
    meter: Net,
    q: Net,
    clocks: [Net; 2],
}

impl Pins {
    fn of(circuit: &Circuit) -> Result<Self, OriginalError> {
        let pin = |name| circuit.pin(name);
        Ok(Self {
            grating: pin("grating")?,
            laser: pin("laser")?,
            tick: pin("tick")?,
            forward: pin("forward")?,
            start: pin("start")?,
            middle: pin("middle")?,
            laser_start: pin("laser_start")?,
            meter: pin("meter")?,
            q: pin("q")?,
            clocks: [pin("cp1")?, pin("cp2")?],
        })
    }
}

impl<'a, P: Process> GateLoop<'a, P> {
    /// Joins them and lets go of the reset.
    ///
    /// # Errors
    ///
    /// When the gates do not come to rest.
    pub(crate) fn new(
        circuit: &'a Circuit,
        delays: &Delays,
        ticks: Option<Ticks>,
        process: P,
    ) -> Result<Self, Error> {
        let mut gates = Simulator::new(circuit, delays)?;
        let pins = Pins::of(circuit)?;
        let Pins { start, middle, laser_start, meter, q, clocks: [cp1, cp2], .. } = pins;
        gates.watch(&[start, middle, laser_start, meter, q, cp1, cp2]);
        gates.drive(1, circuit.pin("reset")?, false)?;
        Ok(Self {
            process,
            circuit,
            gates,
            pins,
            ticks,
            falls: BinaryHeap::new(),
            reading: Reading::default(),
            begun: false,
            decided: false,
            steps: 0,
            steps_at_ends: Vec::new(),
            recorded: None,
        })
    }

    /// The same, and every edge of every wire is kept.
    pub(crate) fn recorded(mut self) -> Self {
        let all: Vec<Net> = (0..self.circuit.nets.len()).map(Net).collect();
        self.gates.watch(&all);
        self.recorded = Some(Vec::new());
        self
    }

    /// Runs to an instant, s.
    ///
    /// # Errors
    ///
    /// An effect with a value that no machine could follow.
    pub(crate) fn run(mut self, end_s: f64) -> Result<GateRun, Error> {
        let mut now_s = 0.0;
        while now_s < end_s {
            let line_s = self.process.next_line_s().max(now_s);
            let fringe_s = self.process.next_fringe_s().max(now_s);
            let tick_s =
                self.ticks.map_or(f64::INFINITY, |ticks| time_of(ticks.next, ticks.clock_hz));
            now_s = line_s.min(fringe_s).min(tick_s).min(end_s);
            self.advance(picoseconds(now_s))?;
            if tick_s <= now_s {
                self.tick(now_s)?;
            } else if line_s <= now_s {
                self.pulse(self.pins.grating)?;
                self.process.pass_line();
            } else if fringe_s <= now_s {
                self.pulse(self.pins.laser)?;
                self.process.pass_fringe();
            }
        }
        match self.process.failure() {
            Some(failure) => Err(failure.into()),
            None => self.ended(),
        }
    }

    fn ended(mut self) -> Result<GateRun, Error> {
        self.advance(self.gates.now_ps() + 10 * PULSE_PS)?;
        let mut counted = 0;
        for stage in 0..helixlock_original::figures::reset_counter::STAGES {
            let level = self.gates.level(self.circuit.pin(&format!("count{stage}"))?);
            counted |= i64::from(level) << stage;
        }
        let comparisons = std::mem::take(&mut self.reading.comparisons);
        Ok(GateRun {
            comparisons: comparisons.into_iter().zip(self.steps_at_ends).collect(),
            steps: self.steps,
            counted,
            events: self.gates.events(),
            findings: self.gates.findings(),
            edges: self.recorded.unwrap_or_default(),
        })
    }

    /// Lets time pass; pulses that end meanwhile end.
    fn advance(&mut self, to_ps: u64) -> Result<(), Error> {
        while let Some(Reverse((fall_ps, pin))) = self.falls.peek().copied()
            && fall_ps <= to_ps
        {
            self.falls.pop();
            self.gates.drive(fall_ps, pin, false)?;
        }
        self.gates.run_until(to_ps.max(self.gates.now_ps()));
        let edges = self.gates.take_edges();
        for edge in &edges {
            self.read(*edge);
        }
        if let Some(recorded) = &mut self.recorded {
            recorded.extend(edges);
        }
        self.steps_at_ends.resize(self.reading.comparisons.len(), self.steps);
        Ok(())
    }

    fn read(&mut self, Edge { time_ps, net, level }: Edge) {
        let time_s = seconds(time_ps);
        let pins = self.pins;
        let pulse = [
            (pins.start, Pulse::Grating),
            (pins.middle, Pulse::Half),
            (pins.laser_start, Pulse::Laser),
        ];
        let pulse = pulse.into_iter().find(|(pin, _)| *pin == net).map(|(_, pulse)| pulse);
        self.begun |= level && pulse == Some(Pulse::Grating);
        if !self.begun {
            return;
        }
        self.decided |= pins.clocks.contains(&net) && !level;
        if net == pins.meter {
            self.reading.change(time_s, Change::Meter(level));
        } else if net == pins.q {
            self.reading.change(time_s, Change::Q(level));
        } else if let Some(pulse) = pulse.filter(|_| level) {
            self.reading.pulse(time_s, pulse, METER_RISES_S);
        }
    }

    /// A pulse now; one that comes while the one before is high waits for it, and a pause.
    fn pulse(&mut self, pin: Net) -> Result<(), Error> {
        let before = self.falls.iter().filter(|Reverse((_, one))| *one == pin);
        if let Some(fall_ps) = before.map(|Reverse((fall_ps, _))| *fall_ps).max() {
            self.advance(fall_ps + PAUSE_PS)?;
        }
        let now_ps = self.gates.now_ps();
        self.gates.drive(now_ps, pin, true)?;
        self.falls.push(Reverse((now_ps + PULSE_PS, pin)));
        Ok(())
    }

    /// The motor steps, once something is decided.
    fn tick(&mut self, time_s: f64) -> Result<(), Error> {
        if let Some(ticks) = &mut self.ticks {
            ticks.next += ticks.period;
        }
        if !self.decided {
            return Ok(());
        }
        let forward = self.gates.level(self.pins.forward);
        self.pulse(self.pins.tick)?;
        self.steps += if forward { 1 } else { -1 };
        self.process.step(time_s, forward);
        Ok(())
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "times count from zero, and 2⁵³ ps are two hours and a half of grinding"
)]
fn picoseconds(time_s: f64) -> u64 {
    libm::round(time_s * 1e12) as u64
}

#[expect(clippy::cast_precision_loss, reason = "as above")]
fn seconds(time_ps: u64) -> f64 {
    time_ps as f64 * 1e-12
}
