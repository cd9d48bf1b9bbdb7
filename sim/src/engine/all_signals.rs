//! All signals of a design, worked out when somebody asks for one that is kept nowhere.

use super::circuit::Circuit;

/// Works out every signal of a design that has settled.
pub trait AllSignals {
    /// From inputs in port order and registers in the netlist's, `values` in the order of signals.
    fn signals(&self, inputs: &[u64], registers: &[u64], values: &mut [u64]);
}

/// The values, and whether they are of this moment.
#[derive(Clone, Debug)]
pub(super) struct Evaluated {
    values: Vec<u64>,
    fresh: bool,
}

impl Evaluated {
    pub(super) fn new(circuit: &Circuit) -> Self {
        Self { values: vec![0; circuit.netlist().signals.len()], fresh: false }
    }

    pub(super) fn is_fresh(&self) -> bool {
        self.fresh
    }

    pub(super) fn forget(&mut self) {
        self.fresh = false;
    }

    pub(super) fn renew(&mut self, by: &impl AllSignals, inputs: &[u64], registers: &[u64]) {
        by.signals(inputs, registers, &mut self.values);
        self.fresh = true;
    }

    pub(super) fn values(&self) -> &[u64] {
        &self.values
    }
}
