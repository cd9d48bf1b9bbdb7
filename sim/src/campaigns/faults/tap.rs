//! An engine that remembers what its inputs were told.

use helixlock_netlist::{Netlist, SignalId};

use crate::engine::{Engine, FlipFlops, Snapshot, Stop};

/// An input was set before the edge after `clock`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct InputChange {
    pub(crate) clock: u64,
    pub(crate) input: SignalId,
    pub(crate) value: u64,
}

/// Passes everything on and keeps the inputs.
#[derive(Debug)]
pub(crate) struct Tapped<E> {
    engine: E,
    pub(crate) changes: Vec<InputChange>,
}

impl<E> Tapped<E> {
    pub(crate) fn new(engine: E) -> Self {
        Self { engine, changes: Vec::new() }
    }
}

impl<E: Engine> Engine for Tapped<E> {
    fn netlist(&self) -> &Netlist {
        self.engine.netlist()
    }

    fn clock(&self) -> u64 {
        self.engine.clock()
    }

    fn set_input(&mut self, input: SignalId, value: u64) {
        self.changes.push(InputChange { clock: self.clock(), input, value });
        self.engine.set_input(input, value);
    }

    fn value(&mut self, signal: SignalId) -> u64 {
        self.engine.value(signal)
    }

    fn step(&mut self) {
        self.engine.step();
    }

    fn watch(&mut self, signals: &[SignalId]) {
        self.engine.watch(signals);
    }

    fn run_until(&mut self, clock: u64) -> Stop {
        self.engine.run_until(clock)
    }

    fn flip_flops(&self) -> FlipFlops {
        self.engine.flip_flops()
    }

    fn snapshot(&self) -> Snapshot {
        self.engine.snapshot()
    }

    fn restore(&mut self, snapshot: &Snapshot) {
        self.engine.restore(snapshot);
    }
}
