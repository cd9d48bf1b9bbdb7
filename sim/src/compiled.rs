//! The engine that takes every clock, compiled ahead of time.

use helixlock_netlist::{Netlist, SignalId};

use crate::circuit::{Circuit, Place};
use crate::state::{pack, unpack};
use crate::{Engine, FlipFlops, Snapshot, Stop};

/// Straight-line code for a whole design.
pub trait DenseKernel {
    /// One word an input.
    type Inputs: AsRef<[u64]> + AsMut<[u64]> + Clone + std::fmt::Debug;
    /// One word a register.
    type Registers: AsRef<[u64]> + AsMut<[u64]> + Clone + std::fmt::Debug;
    /// All inputs low.
    const INPUTS: Self::Inputs;
    /// Power-up.
    const REGISTERS: Self::Registers;

    /// Takes one rising edge, from `registers` to `next`.
    fn step(inputs: &Self::Inputs, registers: &Self::Registers, next: &mut Self::Registers);

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
    /// Written by the next edge, then exchanged with `registers`.
    next: K::Registers,
    watched: Vec<SignalId>,
    /// Indices of the watched signals among the outputs, if they all are.
    watched_outputs: Option<Vec<usize>>,
    outputs: Vec<u64>,
    evaluated: Option<Vec<u64>>,
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
            next: K::REGISTERS,
            watched: Vec::new(),
            watched_outputs: Some(Vec::new()),
            outputs: vec![0; netlist.outputs.len()],
            evaluated: None,
        }
    }

    fn watched_values(&mut self) -> Vec<u64> {
        match &self.watched_outputs {
            Some(indices) => {
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
        self.inputs.as_mut()[index] = value;
        self.evaluated = None;
    }

    fn value(&mut self, signal: SignalId) -> u64 {
        match self.circuit.place(signal) {
            Place::Input(index) => self.inputs.as_ref()[index],
            Place::Register(index) => self.registers.as_ref()[index],
            Place::Net(_) | Place::Logic => {
                let evaluated = self.evaluated.take().unwrap_or_else(|| {
                    self.circuit.evaluate(self.inputs.as_ref(), self.registers.as_ref())
                });
                self.evaluated.insert(evaluated)[signal.0 as usize]
            }
        }
    }

    fn step(&mut self) {
        K::step(&self.inputs, &self.registers, &mut self.next);
        std::mem::swap(&mut self.registers, &mut self.next);
        self.clock += 1;
        self.evaluated = None;
    }

    fn watch(&mut self, signals: &[SignalId]) {
        self.watched = signals.to_vec();
        let outputs = &self.circuit.netlist().outputs;
        let index = |signal| outputs.iter().position(|output| output == signal);
        self.watched_outputs = signals.iter().map(index).collect();
    }

    fn run_until(&mut self, clock: u64) -> Stop {
        if self.watched.is_empty() {
            let clocks = clock.saturating_sub(self.clock);
            // To and fro, so that nothing is copied.
            for _ in 0..clocks / 2 {
                K::step(&self.inputs, &self.registers, &mut self.next);
                K::step(&self.inputs, &self.next, &mut self.registers);
            }
            self.clock += clocks / 2 * 2;
            if clocks % 2 == 1 {
                self.step();
            }
            self.evaluated = None;
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
        pack(self.circuit.netlist(), self.registers.as_ref().iter().copied())
    }

    fn snapshot(&self) -> Snapshot {
        let inputs = self.inputs.as_ref().to_vec();
        Snapshot { clock: self.clock, inputs, flip_flops: self.flip_flops() }
    }

    fn restore(&mut self, snapshot: &Snapshot) {
        self.inputs.as_mut().copy_from_slice(&snapshot.inputs);
        let registers = unpack(self.circuit.netlist(), &snapshot.flip_flops);
        self.registers.as_mut().copy_from_slice(&registers);
        self.clock = snapshot.clock;
        self.evaluated = None;
    }
}
