//! Pieces of any design, evaluated from its netlist at run time.

use std::fmt;

use helixlock_netlist::Expression;
use helixlock_netlist::partition::{Source, Task};

use super::all_signals::AllSignals;
use super::circuit::Circuit;
use super::moment::{Coasting, Kernel, Moment};

/// The kernel of a design that was not compiled in; slow, for designs met at run time.
#[derive(Clone)]
pub struct InterpretedPieces<'a>(pub &'a Circuit);

impl fmt::Debug for InterpretedPieces<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.debug_tuple("InterpretedPieces").finish_non_exhaustive()
    }
}

impl InterpretedPieces<'_> {
    /// Values of the signals a task reads and computes; others are zero.
    fn values(&self, task: &Task, now: &Moment<Self>) -> Vec<u64> {
        let mut values = vec![0; self.0.netlist().signals.len()];
        for (signal, source) in &task.reads {
            values[signal.0 as usize] = self.read(*source, now);
        }
        for index in &task.body {
            let assignment = &self.0.netlist().assignments[*index];
            values[assignment.target.0 as usize] = assignment.value.evaluate(&values);
        }
        values
    }

    fn read(&self, source: Source, now: &Moment<Self>) -> u64 {
        match source {
            Source::Input(index) => now.slots[index],
            Source::Register(index) => now.slots[self.0.register_slot(index)],
            Source::Net(index) => now.slots[self.0.net_slot(index)],
            Source::Counter(index) => now.counter(index),
            Source::Nothing => 0,
        }
    }

    fn coasting(&self, register: usize) -> Coasting {
        let output = self.0.netlist().registers[register].output;
        Coasting::rest(self.0.register_slot(register), self.0.netlist().signal(output).width)
    }

    fn call(&self, source: Source, now: &mut Moment<Self>) {
        if let Some(readers) = self.0.partition().readers.get(&source) {
            readers.nets.iter().for_each(|index| now.nets[index / 64] |= 1 << (index % 64));
            readers.groups.iter().for_each(|index| now.groups[index / 64] |= 1 << (index % 64));
        }
    }

    fn mode(&self, index: usize, now: &mut Moment<Self>) {
        let piece = &self.0.partition().counters[index];
        let values = self.values(&piece.mode, now);
        let of = |expression: &Expression| expression.evaluate(&values);
        let counting = of(&piece.counter.counting) != 0;
        let step = if counting { of(&piece.counter.step) } else { 0 };
        let thresholds: Vec<u64> = piece.counter.thresholds.iter().map(of).collect();
        now.count(index, step, &thresholds);
        if !counting {
            let load = self.0.partition().groups.len() + index;
            now.groups[load / 64] |= 1 << (load % 64);
        }
    }

    fn load(&self, index: usize, now: &mut Moment<Self>) {
        let piece = &self.0.partition().counters[index];
        let input = self.0.netlist().registers[piece.counter.register].input;
        let value = self.values(&piece.load, now)[input.0 as usize];
        now.load(index, value);
    }
}

impl AllSignals for InterpretedPieces<'_> {
    fn signals(&self, inputs: &[u64], registers: &[u64], values: &mut [u64]) {
        let netlist = self.0.netlist();
        for (input, value) in netlist.inputs.iter().zip(inputs) {
            values[input.0 as usize] = *value;
        }
        for (register, value) in netlist.registers.iter().zip(registers) {
            values[register.output.0 as usize] = *value;
        }
        for assignment in &netlist.assignments {
            values[assignment.target.0 as usize] = assignment.value.evaluate(values);
        }
    }
}

impl Kernel for InterpretedPieces<'_> {
    type Slots = Vec<u64>;
    type Nets = Vec<u64>;
    type Groups = Vec<u64>;
    type Counters = Vec<Coasting>;

    fn blank(&self) -> Moment<Self> {
        let partition = self.0.partition();
        let counters = partition.counters.len();
        let words = |bits: usize| vec![0; bits.div_ceil(64)];
        Moment::new(
            vec![0; self.0.slots()],
            words(partition.nets.len() + counters),
            words(partition.groups.len() + counters),
            partition.counters.iter().map(|piece| self.coasting(piece.counter.register)).collect(),
        )
    }

    fn net(&self, index: usize, now: &mut Moment<Self>) {
        let partition = self.0.partition();
        let Some(net) = partition.nets.get(index) else {
            return self.mode(index - partition.nets.len(), now);
        };
        let value = self.values(&net.task, now)[net.signal.0 as usize];
        let slot = self.0.net_slot(index);
        if now.slots[slot] != value {
            now.slots[slot] = value;
            now.changed[index / 64] |= 1 << (index % 64);
            self.call(Source::Net(index), now);
        }
    }

    fn group(&self, index: usize, now: &mut Moment<Self>) {
        let partition = self.0.partition();
        let Some(group) = partition.groups.get(index) else {
            return self.load(index - partition.groups.len(), now);
        };
        let values = self.values(&group.task, now);
        for register in &group.registers {
            let input = self.0.netlist().registers[*register].input;
            let slot = self.0.register_slot(*register);
            if now.slots[slot] != values[input.0 as usize] {
                now.slots[slot] = values[input.0 as usize];
                self.call(Source::Register(*register), now);
            }
        }
    }

    fn input_changed(&self, index: usize, now: &mut Moment<Self>) {
        self.call(Source::Input(index), now);
    }

    fn counter_moved(&self, index: usize, now: &mut Moment<Self>) {
        self.call(Source::Counter(index), now);
    }
}
