//! The engine that leaps through a design met at run time: evaluates only what is called upon, and
//! when nobody is, jumps to the clock at which something happens.
//!
//! ```text
//! clock         0 1 2 3 4 5 6 ················ 4711 4712 4713 4714
//! laser         ▁▔▔▔▔▔▔▔▔▔▔▔▔
//! synchroniser  ▁▁▔▔▔▔▔▔▔▔▔▔▔
//! divider       · · · ×                                              evaluated at ×
//! step clock    9 8 7 6 5 4 3 ················    2    1    0        known without stepping
//!                           └─── one jump ───┘
//! ```
//!
//! The result is that of stepping every clock, flip-flop by flip-flop; why is told at
//! [`helixlock_netlist::settle`] and [`helixlock_netlist::partition`]. A design in which nothing
//! rests is stepped clock by clock.

use helixlock_netlist::{Netlist, SignalId};

use super::all_signals::Evaluated;
use super::circuit::{Circuit, Place};
use super::moment::{Kernel, Moment};
use super::state::{FlipFlops, Snapshot, pack, unpack};
use super::{Engine, Stop};

/// Leaps through a design whose pieces `K` evaluates.
#[derive(Clone, Debug)]
pub struct Leap<'a, K: Kernel> {
    circuit: &'a Circuit,
    kernel: K,
    now: Moment<K>,
    /// One bit a watched net.
    watched_nets: Vec<u64>,
    /// Watched signals that are no nets, with the values they had.
    watched_others: Vec<(SignalId, u64)>,
    /// Counters that a watched signal shows as they are: it changes whenever they move.
    watched_counters: Vec<usize>,
    /// All signals at this moment, when somebody asked for one that is kept nowhere.
    evaluated: Evaluated,
}

impl<'a, K: Kernel> Leap<'a, K> {
    /// The design at power-up, with all inputs low; `kernel` must be of the same design.
    #[must_use]
    pub fn new(circuit: &'a Circuit, kernel: K) -> Self {
        let now = kernel.blank();
        debug_assert_eq!(now.slots.as_ref().len(), circuit.slots(), "the kernel is of this design");
        let nets = now.nets.as_ref().len();
        let mut leap = Self {
            circuit,
            kernel,
            now,
            watched_nets: vec![0; nets],
            watched_others: Vec::new(),
            watched_counters: Vec::new(),
            evaluated: Evaluated::new(circuit),
        };
        for (index, register) in circuit.netlist().registers.iter().enumerate() {
            leap.now.slots.as_mut()[circuit.register_slot(index)] = register.initial;
        }
        leap.start(0);
        leap
    }

    fn start(&mut self, clock: u64) {
        let partition = self.circuit.partition();
        self.now.start(clock, partition.nets.len(), partition.groups.len());
        self.evaluated.forget();
    }

    fn settle(&mut self) {
        self.now.settle(&self.kernel);
    }

    fn register(&self, index: usize) -> u64 {
        match self.circuit.counter_of(index) {
            Some(counter) => self.now.counter(counter),
            None => self.now.slots.as_ref()[self.circuit.register_slot(index)],
        }
    }

    fn registers(&self) -> Vec<u64> {
        (0..self.circuit.netlist().registers.len()).map(|index| self.register(index)).collect()
    }

    fn inputs(&self) -> &[u64] {
        &self.now.slots.as_ref()[..self.circuit.netlist().inputs.len()]
    }

    /// Takes one edge or one leap, `clock` at the farthest, and settles.
    #[inline]
    fn advance(&mut self, clock: u64) {
        if self.now.rests() {
            let moving = self.watched_counters.iter().any(|index| self.now.moves(*index));
            let until = if moving { self.now.clock + 1 } else { clock };
            self.now.pass(&self.kernel, self.now.next_event(until));
        } else {
            self.now.edge(&self.kernel);
        }
        self.now.settle(&self.kernel);
    }

    fn evaluate(&mut self) -> &[u64] {
        if !self.evaluated.is_fresh() {
            let registers = self.registers();
            let inputs = &self.now.slots.as_ref()[..self.circuit.netlist().inputs.len()];
            self.evaluated.renew(&self.kernel, inputs, &registers);
        }
        self.evaluated.values()
    }

    fn watched_net_changed(&self) -> bool {
        let changed = self.now.changed.as_ref().iter();
        changed.zip(&self.watched_nets).any(|(changed, watched)| changed & watched != 0)
    }

    /// The value of a signal of a design that has settled.
    fn shown(&mut self, signal: SignalId) -> u64 {
        match self.circuit.place(signal) {
            Place::Input(index) => self.now.slots.as_ref()[index],
            Place::Register(index) => self.register(index),
            Place::Net(index) => self.now.slots.as_ref()[self.circuit.net_slot(index)],
            Place::Logic => self.evaluate()[signal.0 as usize],
        }
    }

    /// Notes the values of watched signals that are no nets; true when one of them is another.
    fn note_watched_others(&mut self) -> bool {
        let mut watched = std::mem::take(&mut self.watched_others);
        let mut another = false;
        // One by one: two lists that were just written are compared as bytes, and wait for that.
        for (signal, known) in &mut watched {
            let value = self.shown(*signal);
            another |= value != *known;
            *known = value;
        }
        self.watched_others = watched;
        another
    }
}

impl<K: Kernel> Engine for Leap<'_, K> {
    fn netlist(&self) -> &Netlist {
        self.circuit.netlist()
    }

    fn clock(&self) -> u64 {
        self.now.clock
    }

    fn set_input(&mut self, input: SignalId, value: u64) {
        let index = self.circuit.input_index(input, value);
        let slot = &mut self.now.slots.as_mut()[index];
        if *slot != value {
            *slot = value;
            self.kernel.input_changed(index, &mut self.now);
            self.evaluated.forget();
        }
    }

    fn value(&mut self, signal: SignalId) -> u64 {
        self.settle();
        self.shown(signal)
    }

    fn values(&mut self, signals: &[SignalId], values: &mut Vec<u64>) {
        self.settle();
        values.clear();
        if signals.iter().any(|signal| self.circuit.place(*signal) == Place::Logic) {
            let all = self.evaluate();
            values.extend(signals.iter().map(|signal| all[signal.0 as usize]));
        } else {
            values.extend(signals.iter().map(|signal| self.value(*signal)));
        }
    }

    fn step(&mut self) {
        self.settle();
        self.evaluated.forget();
        self.advance(self.now.clock + 1);
    }

    fn watch(&mut self, signals: &[SignalId]) {
        self.watched_nets.fill(0);
        self.watched_others.clear();
        self.watched_counters = self.circuit.counters_shown_by(signals);
        for signal in signals {
            match (self.circuit.net_of(*signal), self.circuit.place(*signal)) {
                (Some(index), _) => self.watched_nets[index / 64] |= 1 << (index % 64),
                (None, Place::Input(_)) => {}
                (None, _) => self.watched_others.push((*signal, 0)),
            }
        }
    }

    fn run_until(&mut self, clock: u64) -> Stop {
        self.settle();
        self.evaluated.forget();
        self.note_watched_others();
        self.now.changed.as_mut().fill(0);
        while self.now.clock < clock {
            self.advance(clock);
            self.evaluated.forget();
            // Others first: their values are noted even when a net has changed.
            let others = !self.watched_others.is_empty() && self.note_watched_others();
            if others || self.watched_net_changed() {
                return Stop::Changed;
            }
        }
        Stop::Reached
    }

    fn flip_flops(&self) -> FlipFlops {
        pack(self.circuit.netlist(), self.registers())
    }

    fn snapshot(&self) -> Snapshot {
        Snapshot {
            clock: self.now.clock,
            inputs: self.inputs().to_vec(),
            flip_flops: self.flip_flops(),
        }
    }

    fn restore(&mut self, snapshot: &Snapshot) {
        let netlist = self.circuit.netlist();
        assert_eq!(snapshot.inputs.len(), netlist.inputs.len(), "inputs of this design");
        let registers = unpack(netlist, &snapshot.flip_flops);
        let slots = self.now.slots.as_mut();
        slots[..snapshot.inputs.len()].copy_from_slice(&snapshot.inputs);
        slots[snapshot.inputs.len()..][..registers.len()].copy_from_slice(&registers);
        self.start(snapshot.clock);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::agreement::compare;
    use crate::engine::interpreted_pieces::InterpretedPieces;
    use crate::engine::random_design::{Dice, random_design};

    #[test]
    fn leaping_is_stepping_every_clock() {
        let mut counters = 0;
        for seed in 0..400 {
            let mut dice = Dice(seed);
            let circuit = Circuit::new(random_design(&mut dice));
            counters += circuit.partition().counters.len();
            let mut leap = Leap::new(&circuit, InterpretedPieces::new(&circuit));
            compare(circuit.netlist(), &mut leap, &mut dice);
        }
        assert!(100 < counters, "only {counters} counters were met");
    }
}
