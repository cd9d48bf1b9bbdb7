//! The engine that takes every clock, compiled ahead of time.

use helixlock_netlist::{Netlist, SignalId};

use super::all_signals::Evaluated;
use super::circuit::{Circuit, Place};
use super::dense::{DenseKernel, Machine};
use super::gather::{Gather, Gathering, Work};
use super::state::{FlipFlops, Snapshot};
use super::{Engine, Stop};

/// Steps a design with the code `K`.
#[derive(Clone, Debug)]
pub struct Compiled<'a, K: DenseKernel> {
    circuit: &'a Circuit,
    by: Gathering,
    machine: Machine<K>,
    watched: Vec<SignalId>,
    /// Indices of the watched signals among the outputs, if they all are.
    watched_outputs: Option<Vec<usize>>,
    outputs: Vec<u64>,
    evaluated: Evaluated,
}

impl<'a, K: DenseKernel> Compiled<'a, K> {
    /// The design at power-up, with all inputs low; `K` must be of the same design.
    #[must_use]
    pub fn new(circuit: &'a Circuit) -> Self {
        Self::by(circuit, Gathering::best())
    }

    /// The same, by the given way of gathering bits.
    pub(super) fn by(circuit: &'a Circuit, by: Gathering) -> Self {
        let netlist = circuit.netlist();
        Self {
            circuit,
            by,
            machine: Machine::new(netlist),
            watched: Vec::new(),
            watched_outputs: Some(Vec::new()),
            outputs: vec![0; netlist.outputs.len()],
            evaluated: Evaluated::new(circuit),
        }
    }

    fn watched_values(&mut self) -> Vec<u64> {
        match &self.watched_outputs {
            Some(indices) => {
                let (inputs, registers) = (self.machine.inputs.as_ref(), self.machine.joined());
                K::outputs(inputs, registers.as_ref(), &mut self.outputs);
                indices.iter().map(|index| self.outputs[*index]).collect()
            }
            None => self.watched.clone().into_iter().map(|signal| self.value(signal)).collect(),
        }
    }

    #[inline(never)]
    fn run_watching(&mut self, clock: u64) -> Stop {
        let before = self.watched_values();
        while self.machine.clock < clock {
            self.step();
            if self.watched_values() != before {
                return Stop::Changed;
            }
        }
        Stop::Reached
    }
}

/// Takes every clock up to this one.
struct Stepping<'a, K: DenseKernel>(&'a mut Machine<K>, u64);

impl<K: DenseKernel> Work for Stepping<'_, K> {
    type Answer = ();

    #[inline(always)]
    fn work<G: Gather>(self) {
        let Self(machine, clock) = self;
        machine.settle();
        if clock <= machine.clock {
            return;
        }
        let Machine { inputs, registers, kept, rest, .. } = machine;
        // On its own: as a part of the machine it would be written at every clock.
        let mut known = machine.known;
        for _ in machine.clock..clock {
            let edge = K::look::<G>(inputs, registers, kept, known);
            known = K::take(inputs, registers, kept, edge, rest);
        }
        machine.known = known;
        machine.clock = clock;
    }
}

impl<K: DenseKernel> Engine for Compiled<'_, K> {
    fn netlist(&self) -> &Netlist {
        self.circuit.netlist()
    }

    fn clock(&self) -> u64 {
        self.machine.clock
    }

    fn set_input(&mut self, input: SignalId, value: u64) {
        if !self.machine.set_input(input, value) {
            self.circuit.refuse(input, value);
        }
        self.evaluated.forget();
    }

    fn value(&mut self, signal: SignalId) -> u64 {
        match self.circuit.place(signal) {
            Place::Input(index) => self.machine.inputs.as_ref()[index],
            Place::Register(index) => self.machine.joined().as_ref()[index],
            Place::Net(_) | Place::Logic => {
                if !self.evaluated.is_fresh() {
                    let (inputs, registers) = (self.machine.inputs.as_ref(), self.machine.joined());
                    self.evaluated.renew(&K::default(), inputs, registers.as_ref());
                }
                self.evaluated.values()[signal.0 as usize]
            }
        }
    }

    fn step(&mut self) {
        self.evaluated.forget();
        let next = self.machine.clock + 1;
        self.by.have(Stepping(&mut self.machine, next));
    }

    fn watch(&mut self, signals: &[SignalId]) {
        self.watched = signals.to_vec();
        let outputs = &self.circuit.netlist().outputs;
        let index = |signal| outputs.iter().position(|output| output == signal);
        self.watched_outputs = signals.iter().map(index).collect();
    }

    fn run_until(&mut self, clock: u64) -> Stop {
        if !self.watched.is_empty() {
            return self.run_watching(clock);
        }
        self.evaluated.forget();
        self.by.have(Stepping(&mut self.machine, clock));
        Stop::Reached
    }

    fn flip_flops(&self) -> FlipFlops {
        self.machine.flip_flops(self.circuit.netlist())
    }

    fn snapshot(&self) -> Snapshot {
        self.machine.snapshot(self.circuit.netlist())
    }

    fn restore(&mut self, snapshot: &Snapshot) {
        self.machine.restore(self.circuit.netlist(), snapshot);
        self.evaluated.forget();
    }
}
