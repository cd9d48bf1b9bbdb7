//! The engine that takes every clock, compiled ahead of time.

use helixlock_netlist::{Netlist, SignalId};

use super::all_signals::{AllSignals, Evaluated};
use super::circuit::{Circuit, Place};
use super::rest::Rest;
use super::state::{FlipFlops, Snapshot, pack, unpack};
use super::{Engine, Stop};

/// Straight-line code for a whole design.
pub trait DenseKernel: AllSignals + Default {
    /// One word an input.
    type Inputs: AsRef<[u64]> + AsMut<[u64]> + Clone + std::fmt::Debug;
    /// One word a register.
    type Registers: AsRef<[u64]> + AsMut<[u64]> + Clone + std::fmt::Debug;
    /// One word for each that is kept from clock to clock: it depends on inputs that `KEPT_FROM`
    /// names and registers that rarely change. Those of one bit that are looked up with are bits of
    /// `known` instead.
    type Kept: AsRef<[u64]> + Clone + std::fmt::Debug;
    /// All inputs low.
    const INPUTS: Self::Inputs;
    /// Power-up.
    const REGISTERS: Self::Registers;
    /// Nothing computed yet.
    const KEPT: Self::Kept;
    /// One an input: words kept are to be computed anew when it has changed.
    const KEPT_FROM: &'static [bool];
    /// One an input: the bit of `known` that is this input, if there is one.
    const TOGGLES: &'static [u64];
    /// Number of tables that are asked at every clock.
    const TABLES: usize;

    /// Takes one rising edge: what is `known` before it becomes what is known after it. `kept` and
    /// `known` must be of these inputs and registers, and are afterwards; registers that are bits
    /// of `known` are out of date among `registers`.
    fn step(
        inputs: &Self::Inputs,
        registers: &mut Self::Registers,
        kept: &mut Self::Kept,
        known: u64,
        rest: &mut Rest,
    ) -> u64;

    /// Computes what is kept, and the bits of `known` that are.
    fn keep(
        inputs: &Self::Inputs,
        registers: &Self::Registers,
        kept: &mut Self::Kept,
        known: u64,
    ) -> u64;

    /// `known` with the bits that are registers.
    fn pack(registers: &Self::Registers, known: u64) -> u64;

    /// Brings the registers that are bits of `known` up to date.
    fn unpack(known: u64, registers: &mut Self::Registers);

    /// Writes the outputs, in port order.
    fn outputs(inputs: &Self::Inputs, registers: &Self::Registers, values: &mut [u64]);
}

/// Steps a design with the code `K`.
#[derive(Clone, Debug)]
pub struct Compiled<'a, K: DenseKernel> {
    circuit: &'a Circuit,
    clock: u64,
    inputs: K::Inputs,
    registers: K::Registers,
    kept: K::Kept,
    /// One-bit registers and bits that are kept; `registers` has the former as they were.
    known: u64,
    /// Of these inputs.
    rest: Rest,
    /// `kept` and `known` are of other inputs or registers.
    stale: bool,
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
        let netlist = circuit.netlist();
        debug_assert_eq!(K::REGISTERS.as_ref().len(), netlist.registers.len());
        Self {
            circuit,
            clock: 0,
            inputs: K::INPUTS,
            registers: K::REGISTERS,
            kept: K::KEPT,
            known: K::pack(&K::REGISTERS, 0),
            rest: Rest::default(),
            stale: true,
            watched: Vec::new(),
            watched_outputs: Some(Vec::new()),
            outputs: vec![0; netlist.outputs.len()],
            evaluated: Evaluated::new(circuit),
        }
    }

    #[inline]
    fn edges(&mut self, clocks: u64) {
        if self.stale {
            self.known = K::keep(&self.inputs, &self.registers, &mut self.kept, self.known);
            self.stale = false;
        }
        let (inputs, registers) = (&self.inputs, &mut self.registers);
        let mut known = self.known;
        for _ in 0..clocks {
            known = K::step(inputs, registers, &mut self.kept, known, &mut self.rest);
        }
        self.known = known;
        self.clock += clocks;
        self.evaluated.forget();
    }

    fn watched_values(&mut self) -> Vec<u64> {
        match &self.watched_outputs {
            Some(indices) => {
                K::unpack(self.known, &mut self.registers);
                K::outputs(&self.inputs, &self.registers, &mut self.outputs);
                indices.iter().map(|index| self.outputs[*index]).collect()
            }
            None => self.watched.clone().into_iter().map(|signal| self.value(signal)).collect(),
        }
    }
}

impl<K: DenseKernel> Engine for Compiled<'_, K> {
    fn netlist(&self) -> &Netlist {
        self.circuit.netlist()
    }

    fn clock(&self) -> u64 {
        self.clock
    }

    fn set_input(&mut self, input: SignalId, value: u64) {
        let index = self.circuit.input_index(input, value);
        let before = std::mem::replace(&mut self.inputs.as_mut()[index], value);
        if before != value {
            self.stale |= K::KEPT_FROM[index];
            self.known ^= K::TOGGLES[index];
            self.rest = Rest::default();
        }
        self.evaluated.forget();
    }

    fn value(&mut self, signal: SignalId) -> u64 {
        match self.circuit.place(signal) {
            Place::Input(index) => self.inputs.as_ref()[index],
            Place::Register(index) => {
                K::unpack(self.known, &mut self.registers);
                self.registers.as_ref()[index]
            }
            Place::Net(_) | Place::Logic => {
                if !self.evaluated.is_fresh() {
                    K::unpack(self.known, &mut self.registers);
                    let (inputs, registers) = (self.inputs.as_ref(), self.registers.as_ref());
                    self.evaluated.renew(&K::default(), inputs, registers);
                }
                self.evaluated.values()[signal.0 as usize]
            }
        }
    }

    fn step(&mut self) {
        self.edges(1);
    }

    fn watch(&mut self, signals: &[SignalId]) {
        self.watched = signals.to_vec();
        let outputs = &self.circuit.netlist().outputs;
        let index = |signal| outputs.iter().position(|output| output == signal);
        self.watched_outputs = signals.iter().map(index).collect();
    }

    fn run_until(&mut self, clock: u64) -> Stop {
        if self.watched.is_empty() {
            self.edges(clock.saturating_sub(self.clock));
            return Stop::Reached;
        }
        let before = self.watched_values();
        while self.clock < clock {
            self.step();
            if self.watched_values() != before {
                return Stop::Changed;
            }
        }
        Stop::Reached
    }

    fn flip_flops(&self) -> FlipFlops {
        let mut registers = self.registers.clone();
        K::unpack(self.known, &mut registers);
        pack(self.circuit.netlist(), registers.as_ref().iter().copied())
    }

    fn snapshot(&self) -> Snapshot {
        let inputs = self.inputs.as_ref().to_vec();
        Snapshot { clock: self.clock, inputs, flip_flops: self.flip_flops() }
    }

    fn restore(&mut self, snapshot: &Snapshot) {
        self.inputs.as_mut().copy_from_slice(&snapshot.inputs);
        let registers = unpack(self.circuit.netlist(), &snapshot.flip_flops);
        self.registers.as_mut().copy_from_slice(&registers);
        self.known = K::pack(&self.registers, self.known);
        self.clock = snapshot.clock;
        self.rest = Rest::default();
        self.stale = true;
        self.evaluated.forget();
    }
}
