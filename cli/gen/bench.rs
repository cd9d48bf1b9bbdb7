//! A bench on which our engine answers to inputs, and both are written down.

use helixlock_gen::Vector;
use helixlock_netlist::{Netlist, SignalId, mask};
use helixlock_sim::{Circuit, Engine, InterpretedPieces, Leap, Stop};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Switches: what a board may take with its level inverted.
const PANEL: [&str; 8] = [
    "start",
    "correct",
    "playback",
    "calibrate",
    "manual_step",
    "manual_forward",
    "range_x2",
    "enable",
];

/// The engine, its inputs as last set, and what it answered so far.
pub(super) struct Bench<'a> {
    netlist: &'a Netlist,
    engine: Leap<'a, InterpretedPieces<'a>>,
    inputs: Vec<u64>,
    active_low: bool,
    pub(super) vectors: Vec<Vector>,
}

impl<'a> Bench<'a> {
    /// All switches off; `active_low` when low means on.
    pub(super) fn new(circuit: &'a Circuit, active_low: bool) -> Self {
        let netlist = circuit.netlist();
        let mut engine = Leap::new(circuit, InterpretedPieces::new(circuit));
        engine.watch(&netlist.outputs);
        let inputs = vec![0; netlist.inputs.len()];
        let mut bench = Self { netlist, engine, inputs, active_low, vectors: vec![] };
        for switch in PANEL {
            bench.set(switch, 0);
        }
        bench
    }

    /// Sets an input by name, a switch on or off; a design without it is driven without it.
    pub(super) fn set(&mut self, name: &str, value: u64) {
        let Some(signal) = self.netlist.find(name) else { return };
        let on = mask(self.netlist.signal(signal).width);
        let inverted = self.active_low && PANEL.contains(&name);
        self.set_signal(signal, if inverted { value ^ on } else { value });
    }

    fn set_signal(&mut self, signal: SignalId, value: u64) {
        if let Some(index) = self.netlist.inputs.iter().position(|&input| input == signal) {
            self.inputs[index] = value;
            self.engine.set_input(signal, value);
        }
    }

    pub(super) fn is_high(&mut self, name: &str) -> bool {
        self.netlist.find(name).is_some_and(|signal| self.engine.value(signal) == 1)
    }

    /// Takes that many clocks and records what the outputs are after each.
    pub(super) fn clocks(&mut self, clocks: u32) {
        let end = self.engine.clock() + u64::from(clocks);
        while self.engine.clock() < end {
            let (before, quiet) = (self.engine.clock(), self.outputs());
            let stop = self.engine.run_until(end);
            let passed = self.engine.clock() - before;
            match stop {
                Stop::Reached => self.record(passed, quiet),
                Stop::Changed => {
                    self.record(passed - 1, quiet);
                    let changed = self.outputs();
                    self.record(1, changed);
                }
            }
        }
    }

    /// These inputs high for two clocks, then low for two.
    pub(super) fn pulse(&mut self, names: &[&str]) {
        for level in [1, 0] {
            for name in names {
                self.set(name, level);
            }
            self.clocks(2);
        }
    }

    /// Pins of one or two bits at random for that many clocks, from quiet to busy; but not the serial
    /// port of a logic analyser, whose memory the engine does not have.
    pub(super) fn noise(&mut self, clocks: u32) {
        let mut dice = ChaCha8Rng::seed_from_u64(1977);
        let analyser = self.netlist.find("analyser.memory_data");
        let silent = analyser.and_then(|_| self.netlist.find("rx"));
        for clock in 0..clocks {
            let often = if clock % 4000 < 2000 { 0.5 } else { 0.03 };
            for input in self.netlist.inputs.clone() {
                let width = self.netlist.signal(input).width;
                if Some(input) != silent && width <= 2 && dice.random_bool(often) {
                    self.set_signal(input, dice.random::<u64>() & mask(width));
                }
            }
            self.clocks(1);
        }
    }

    fn outputs(&mut self) -> Vec<u64> {
        self.netlist.outputs.iter().map(|&id| self.engine.value(id)).collect()
    }

    /// Adds clocks, to the last vector if nothing changed.
    fn record(&mut self, clocks: u64, outputs: Vec<u64>) {
        match self.vectors.last_mut() {
            _ if clocks == 0 => {}
            Some(last) if last.inputs == self.inputs && last.outputs == outputs => {
                last.clocks += clocks;
            }
            _ => self.vectors.push(Vector { clocks, inputs: self.inputs.clone(), outputs }),
        }
    }
}

/// Lines and fringes whose divided rates are nearly the same: the phase drifts by one line in 500.
pub(super) struct Trains {
    line_step: u64,
    line_wrap: u64,
    line_phase: u64,
    fringe_clocks: u32,
    clock: u32,
}

impl Trains {
    /// A fringe every so many clocks, and lines for these dividers.
    pub(super) fn new(a: u32, b: u32, fringe_clocks: u32) -> Self {
        Self {
            line_step: u64::from(a) * 501,
            line_wrap: u64::from(b) * 500 * u64::from(fringe_clocks),
            line_phase: 0,
            fringe_clocks,
            clock: 0,
        }
    }

    /// Drives both pins for that many clocks.
    pub(super) fn drive(&mut self, bench: &mut Bench<'_>, clocks: u32) {
        for _ in 0..clocks {
            self.line_phase = (self.line_phase + self.line_step) % self.line_wrap;
            let in_fringe = self.clock % self.fringe_clocks;
            bench.set("laser", u64::from(2 * in_fringe < self.fringe_clocks));
            bench.set("grating", u64::from(2 * self.line_phase < self.line_wrap));
            bench.clocks(1);
            self.clock += 1;
        }
    }
}
