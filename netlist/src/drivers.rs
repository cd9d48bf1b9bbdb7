//! Who drives a signal, and what a signal depends on.

use std::collections::BTreeSet;

use crate::{Expression, Netlist, Node, SignalId};

/// What drives a signal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Driver {
    /// The outside: index in [`Netlist::inputs`].
    Input(usize),
    /// A register: index in [`Netlist::registers`].
    Register(usize),
    /// Logic: index in [`Netlist::assignments`].
    Assignment(usize),
    /// Nothing; it reads zero.
    Nothing,
}

/// The driver of every signal, looked up at once.
#[derive(Clone, Debug)]
pub struct Drivers<'a> {
    netlist: &'a Netlist,
    drivers: Vec<Driver>,
}

impl<'a> Drivers<'a> {
    /// Reads a checked netlist, in which a signal has one driver.
    #[must_use]
    pub fn new(netlist: &'a Netlist) -> Self {
        let mut drivers = vec![Driver::Nothing; netlist.signals.len()];
        for (index, assignment) in netlist.assignments.iter().enumerate() {
            drivers[assignment.target.0 as usize] = Driver::Assignment(index);
        }
        for (index, input) in netlist.inputs.iter().enumerate() {
            drivers[input.0 as usize] = Driver::Input(index);
        }
        for (index, register) in netlist.registers.iter().enumerate() {
            drivers[register.output.0 as usize] = Driver::Register(index);
        }
        Self { netlist, drivers }
    }

    /// What drives it.
    #[must_use]
    pub fn of(&self, signal: SignalId) -> Driver {
        self.drivers[signal.0 as usize]
    }

    /// What it is computed as, when logic drives it.
    #[must_use]
    pub fn logic(&self, signal: SignalId) -> Option<&'a Expression> {
        match self.of(signal) {
            Driver::Assignment(index) => Some(&self.netlist.assignments[index].value),
            _ => None,
        }
    }

    /// The signal this one is a mere copy of, through any number of ports; itself otherwise.
    #[must_use]
    pub fn origin(&self, signal: SignalId) -> SignalId {
        match self.logic(signal) {
            Some(Expression { node: Node::Signal(source), .. }) => self.origin(*source),
            _ => signal,
        }
    }

    /// Origins that `roots` depend on within a clock, not looking behind those where `stop` holds.
    ///
    /// Inputs and registers are always ends; a root is an end too when `stop` says so.
    #[must_use]
    pub fn ends(
        &self,
        roots: impl IntoIterator<Item = SignalId>,
        stop: impl Fn(SignalId) -> bool,
    ) -> BTreeSet<SignalId> {
        let mut ends = BTreeSet::new();
        let mut seen = BTreeSet::new();
        let mut open: Vec<SignalId> = roots.into_iter().collect();
        while let Some(signal) = open.pop() {
            let signal = self.origin(signal);
            if !seen.insert(signal) {
                continue;
            }
            match self.logic(signal) {
                Some(expression) if !stop(signal) => expression.reads(&mut open),
                _ => _ = ends.insert(signal),
            }
        }
        ends
    }
}

impl Expression {
    /// Appends every signal it reads, once for each time it does.
    pub fn reads(&self, into: &mut Vec<SignalId>) {
        if let Node::Signal(id) = self.node {
            into.push(id);
        }
        for operand in self.operands() {
            operand.reads(into);
        }
    }
}
