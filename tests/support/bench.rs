//! One block of the logic on a bench: set inputs, clock it, read any signal.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use bitvec::field::BitField;
use helixlock_netlist::{Library, Netlist, SignalId, elaborate};
use helixlock_rtl::{APART, BLOCKS};
use helixlock_sim::{Engine, Interpreter};

/// A block with its clock, as the reference engine runs it.
pub(crate) struct Bench {
    engine: Interpreter<'static>,
    names: BTreeMap<&'static str, SignalId>,
}

impl Bench {
    /// The block of that name in [`BLOCKS`] or [`APART`], all inputs low, just powered up.
    pub(crate) fn new(block: &str) -> Self {
        let netlist = netlist(block);
        let names = (0..).zip(&netlist.signals).map(|(id, signal)| (&*signal.path, SignalId(id)));
        Self { engine: Interpreter::new(netlist), names: names.collect() }
    }

    /// Drives inputs from now on.
    pub(crate) fn set(&mut self, values: &[(&str, u64)]) {
        for (name, value) in values {
            self.engine.set_input(self.id(name), *value);
        }
    }

    /// The value of a signal, by its path.
    pub(crate) fn get(&mut self, name: &str) -> u64 {
        self.engine.value(self.id(name))
    }

    /// True when the one-bit signal is high.
    pub(crate) fn high(&mut self, name: &str) -> bool {
        self.get(name) == 1
    }

    /// One rising edge.
    pub(crate) fn clock(&mut self) {
        self.engine.step();
    }

    /// That many rising edges, inputs held.
    pub(crate) fn clocks(&mut self, clocks: u32) {
        (0..clocks).for_each(|_| self.engine.step());
    }

    /// One rising edge with these inputs high, which are low again after it.
    pub(crate) fn pulse(&mut self, inputs: &[&str]) {
        for level in [1, 0] {
            for input in inputs {
                self.set(&[(input, level)]);
            }
            if level == 1 {
                self.clock();
            }
        }
    }

    /// Puts the flip-flops at these paths into states of a test's choosing.
    pub(crate) fn force(&mut self, states: &[(&str, u64)]) {
        let mut snapshot = self.engine.snapshot();
        let netlist = self.engine.netlist();
        for (path, value) in states {
            let mut low = 0;
            for register in &netlist.registers {
                let high = low + netlist.signal(register.output).width as usize;
                if register.output == self.id(path) {
                    snapshot.flip_flops[low..high].store_le(*value);
                }
                low = high;
            }
        }
        self.engine.restore(&snapshot);
    }

    /// Puts all flip-flops into a state made of this pattern.
    pub(crate) fn force_all(&mut self, pattern: u8) {
        let mut snapshot = self.engine.snapshot();
        for (rotation, mut bit) in (0..7).cycle().zip(snapshot.flip_flops.iter_mut()) {
            *bit = pattern.rotate_left(rotation) & 1 == 1;
        }
        self.engine.restore(&snapshot);
    }

    /// True when every flip-flop is as in the other.
    pub(crate) fn same_flip_flops(&self, other: &Self) -> bool {
        self.engine.flip_flops() == other.engine.flip_flops()
    }

    /// True when the block has an input of that name.
    pub(crate) fn is_input(&self, name: &str) -> bool {
        self.engine.netlist().inputs.contains(&self.id(name))
    }

    fn id(&self, name: &str) -> SignalId {
        *self.names.get(name).unwrap_or_else(|| panic!("no signal `{name}` in the block"))
    }
}

/// The flat netlist of a block, made once.
pub(crate) fn netlist(block: &str) -> &'static Netlist {
    static NETLISTS: Mutex<BTreeMap<String, &'static Netlist>> = Mutex::new(BTreeMap::new());
    let mut netlists = NETLISTS.lock().unwrap_or_else(PoisonError::into_inner);
    netlists.entry(block.to_owned()).or_insert_with(|| {
        let card = BLOCKS
            .iter()
            .chain(APART)
            .find(|card| card.name == block)
            .expect("a block of the list");
        let design = elaborate(card.name, &*(card.build)(), &Library::new()).expect("elaborates");
        Box::leak(Box::new(Netlist::new(&design).expect("flattens")))
    })
}
