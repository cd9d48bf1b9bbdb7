//! Stimulus for the generated test bench, and what our engine answers to it.
//!
//! First a pass as a grinder would drive it, only faster: fringes every 24 clocks, lines in the
//! ratio of the dividers, then the panel's switches one after the other. Then noise on all pins.

use helixlock_gen::Vector;
use helixlock_netlist::{Netlist, SignalId, mask};
use helixlock_rtl::settings::Settings;
use helixlock_sim::{Circuit, Engine, InterpretedPieces, Leap, Stop};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Clocks from fringe to fringe.
const FRINGE_CLOCKS: u32 = 24;

/// Most clocks of the pass, so that large dividers do not make a long test.
const PASS_CLOCKS: u32 = 100_000;

/// About as many clocks for the steps of the panel: Icarus takes some seconds for a million.
const PANEL_CLOCKS: u32 = 1_200_000;

/// Steps the counter can be away from zero.
const MOST_STEPS: u32 = 4095;

/// Clocks of noise.
const NOISE_CLOCKS: u32 = 20_000;

/// The vectors for a board shell with these settings.
pub(crate) fn vectors(netlist: Netlist, settings: &Settings) -> Vec<Vector> {
    let circuit = Circuit::new(netlist);
    let mut bench = Bench::new(&circuit);
    pass(&mut bench, settings);
    panel(&mut bench, settings);
    noise(&mut bench);
    bench.vectors
}

/// A pass of eight comparison periods: measured first, then corrected, the phase drifting.
fn pass(bench: &mut Bench<'_>, settings: &Settings) {
    let period = settings.range.factor() * settings.b * FRINGE_CLOCKS;
    let clocks = (8 * period).min(PASS_CLOCKS);
    // Lines per fringe are A/B; one more in 500 makes the phase drift.
    let line_step = u64::from(settings.a) * 501;
    let line_wrap = u64::from(settings.b) * 500 * u64::from(FRINGE_CLOCKS);
    let mut line_phase = 0;
    bench.clocks(20);
    bench.set("range_x2", u64::from(settings.range.factor() == 2));
    bench.set("start", 1);
    for clock in 0..clocks {
        line_phase = (line_phase + line_step) % line_wrap;
        bench.set("laser", u64::from(clock % FRINGE_CLOCKS < FRINGE_CLOCKS / 2));
        bench.set("grating", u64::from(2 * line_phase < line_wrap));
        bench.set("correct", u64::from(clock > clocks / 4));
        bench.set(
            "calibrate",
            if clock > 7 * (clocks / 8) { 1 + u64::from(clock / 900 % 3) } else { 0 },
        );
        bench.clocks(1);
    }
}

/// Manual steps both ways, and the playback to zero; each waits for the step clock.
fn panel(bench: &mut Bench<'_>, settings: &Settings) {
    let steps = (PANEL_CLOCKS / settings.step_period).clamp(1, 60);
    bench.set("correct", 0);
    for step in 0..steps {
        bench.set("manual_forward", u64::from(3 * step < 2 * steps));
        bench.set("manual_step", 1);
        bench.clocks(6);
        bench.set("manual_step", 0);
        bench.clocks(settings.step_period.max(6));
    }
    bench.set("playback", 1);
    for _ in 0..MOST_STEPS {
        bench.clocks(settings.step_period);
        if bench.is_high("zero") {
            break;
        }
    }
    bench.clocks(settings.step_period + 100);
    bench.set("playback", 0);
}

/// Every pin at random, from quiet to busy.
fn noise(bench: &mut Bench<'_>) {
    let mut dice = ChaCha8Rng::seed_from_u64(1977);
    for clock in 0..NOISE_CLOCKS {
        let often = if clock % 4000 < 2000 { 0.5 } else { 0.03 };
        for input in bench.netlist.inputs.clone() {
            if dice.random_bool(often) {
                let value = dice.random::<u64>() & mask(bench.netlist.signal(input).width);
                bench.set_signal(input, value);
            }
        }
        bench.clocks(1);
    }
}

/// The engine, its inputs as last set, and what it answered so far.
struct Bench<'a> {
    netlist: &'a Netlist,
    engine: Leap<'a, InterpretedPieces<'a>>,
    inputs: Vec<u64>,
    vectors: Vec<Vector>,
}

impl<'a> Bench<'a> {
    fn new(circuit: &'a Circuit) -> Self {
        let netlist = circuit.netlist();
        let mut engine = Leap::new(circuit, InterpretedPieces(circuit));
        engine.watch(&netlist.outputs);
        Self { netlist, engine, inputs: vec![0; netlist.inputs.len()], vectors: vec![] }
    }

    /// Sets an input by name; a shell without it is driven without it.
    fn set(&mut self, name: &str, value: u64) {
        if let Some(signal) = self.netlist.find(name) {
            self.set_signal(signal, value);
        }
    }

    fn set_signal(&mut self, signal: SignalId, value: u64) {
        if let Some(index) = self.netlist.inputs.iter().position(|&input| input == signal) {
            self.inputs[index] = value;
            self.engine.set_input(signal, value);
        }
    }

    fn is_high(&mut self, name: &str) -> bool {
        self.netlist.find(name).is_some_and(|signal| self.engine.value(signal) == 1)
    }

    /// Takes that many clocks and records what the outputs are after each.
    fn clocks(&mut self, clocks: u32) {
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
