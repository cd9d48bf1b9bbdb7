//! Pieces of any design, evaluated from its netlist at run time.

use std::fmt;
use std::sync::Arc;

use helixlock_netlist::partition::{CounterPiece, Group, Net, Source, Task};
use helixlock_netlist::settle::Counter;
use helixlock_netlist::{Netlist, SignalId};

use super::all_signals::AllSignals;
use super::circuit::Circuit;
use super::moment::{Coasting, Kernel, Moment};
use super::program::{Compiler, Place, Program};

/// The kernel of a design that was not compiled in; slower, for designs met at run time.
#[derive(Clone)]
pub struct InterpretedPieces<'a> {
    circuit: &'a Circuit,
    programs: Arc<Programs>,
}

impl fmt::Debug for InterpretedPieces<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.debug_tuple("InterpretedPieces").finish_non_exhaustive()
    }
}

/// What a design's pieces are evaluated by, in the order of its
/// [`helixlock_netlist::partition::Partition`].
#[derive(Clone, Debug)]
struct Programs {
    nets: Vec<Piece>,
    groups: Vec<Piece>,
    /// Of each counter: whether it counts, its step, its thresholds.
    modes: Vec<Piece>,
    loads: Vec<Piece>,
    /// By slot, then by counter: who is called upon.
    calls: Vec<Calls>,
    /// Gives every signal; it reads inputs and registers, in order.
    all: Piece,
}

/// A task, and where what it gives stands.
#[derive(Clone, Debug)]
struct Piece {
    reads: Vec<Source>,
    program: Program,
    gives: Vec<Place>,
}

/// Nets and groups, by number.
#[derive(Clone, Debug, Default)]
struct Calls {
    nets: Vec<usize>,
    groups: Vec<usize>,
}

impl Programs {
    fn new(circuit: &Circuit) -> Self {
        let (netlist, partition) = (circuit.netlist(), circuit.partition());
        let input = |register: &usize| netlist.registers[*register].input;
        let given = |signals: Vec<SignalId>| {
            move |compiler: &mut Compiler| {
                signals.iter().map(|signal| compiler.signal(*signal)).collect()
            }
        };
        let net = |net: &Net| Piece::new(netlist, &net.task, given(vec![net.signal]));
        let group = |group: &Group| {
            Piece::new(netlist, &group.task, given(group.registers.iter().map(input).collect()))
        };
        let mode = |piece: &CounterPiece| {
            let Counter { counting, step, thresholds, .. } = &piece.counter;
            Piece::new(netlist, &piece.mode, |compiler| {
                let values = [counting, step].into_iter().chain(thresholds);
                values.map(|value| compiler.value(value)).collect()
            })
        };
        let load = |piece: &CounterPiece| {
            Piece::new(netlist, &piece.load, given(vec![input(&piece.counter.register)]))
        };
        Self {
            nets: partition.nets.iter().map(net).collect(),
            groups: partition.groups.iter().map(group).collect(),
            modes: partition.counters.iter().map(mode).collect(),
            loads: partition.counters.iter().map(load).collect(),
            calls: calls(circuit),
            all: Piece::new(netlist, &whole(netlist), given(signals(netlist).collect())),
        }
    }
}

impl Piece {
    fn new(netlist: &Netlist, task: &Task, give: impl FnOnce(&mut Compiler) -> Vec<Place>) -> Self {
        let mut compiler = Compiler::new(task.reads.keys().copied());
        for index in &task.body {
            compiler.assign(&netlist.assignments[*index]);
        }
        let gives = give(&mut compiler);
        Self { reads: task.reads.values().copied().collect(), program: compiler.finish(), gives }
    }

    fn given(&self, values: &[u64]) -> impl Iterator<Item = u64> {
        self.gives.iter().map(|place| values[*place as usize])
    }
}

/// The task that gives every signal.
fn whole(netlist: &Netlist) -> Task {
    let inputs = netlist.inputs.iter().copied().zip((0..).map(Source::Input));
    let outputs = netlist.registers.iter().map(|register| register.output);
    let registers = outputs.zip((0..).map(Source::Register));
    Task {
        reads: inputs.chain(registers).collect(),
        body: (0..netlist.assignments.len()).collect(),
    }
}

fn signals(netlist: &Netlist) -> impl Iterator<Item = SignalId> {
    (0..).map(SignalId).take(netlist.signals.len())
}

fn calls(circuit: &Circuit) -> Vec<Calls> {
    let partition = circuit.partition();
    let mut calls = vec![Calls::default(); circuit.slots() + partition.counters.len()];
    for (source, readers) in &partition.readers {
        if let Some(place) = place(circuit, *source) {
            calls[place].nets.extend(&readers.nets);
            calls[place].groups.extend(&readers.groups);
        }
    }
    calls
}

/// Slot of a source, or beyond the slots the number of a counter.
fn place(circuit: &Circuit, source: Source) -> Option<usize> {
    match source {
        Source::Input(index) => Some(index),
        Source::Register(index) => Some(circuit.register_slot(index)),
        Source::Net(index) => Some(circuit.net_slot(index)),
        Source::Counter(index) => Some(circuit.slots() + index),
        Source::Nothing => None,
    }
}

impl<'a> InterpretedPieces<'a> {
    /// Compiles the pieces of a design.
    #[must_use]
    pub fn new(circuit: &'a Circuit) -> Self {
        Self { circuit, programs: Arc::new(Programs::new(circuit)) }
    }

    /// All values of a piece at this moment.
    fn values(&self, piece: &Piece, now: &Moment<Self>) -> Vec<u64> {
        piece.program.run(piece.reads.iter().map(|source| self.read(*source, now)))
    }

    fn read(&self, source: Source, now: &Moment<Self>) -> u64 {
        match (source, place(self.circuit, source)) {
            (Source::Counter(index), _) => now.counter(index),
            (_, Some(slot)) => now.slots[slot],
            (_, None) => 0,
        }
    }

    fn coasting(&self, register: usize) -> Coasting {
        let output = self.circuit.netlist().registers[register].output;
        Coasting::rest(
            self.circuit.register_slot(register),
            self.circuit.netlist().signal(output).width,
        )
    }

    fn call(&self, place: usize, now: &mut Moment<Self>) {
        let Calls { nets, groups } = &self.programs.calls[place];
        for index in nets {
            now.nets[index / 64] |= 1 << (index % 64);
        }
        for index in groups {
            now.groups[index / 64] |= 1 << (index % 64);
        }
    }

    fn mode(&self, index: usize, now: &mut Moment<Self>) {
        let piece = &self.programs.modes[index];
        let values = self.values(piece, now);
        let given: Vec<u64> = piece.given(&values).collect();
        let [counting, step, thresholds @ ..] = given.as_slice() else { return };
        let counting = *counting != 0;
        now.count(index, if counting { *step } else { 0 }, thresholds);
        if !counting {
            let load = self.circuit.partition().groups.len() + index;
            now.groups[load / 64] |= 1 << (load % 64);
        }
    }

    fn load(&self, index: usize, now: &mut Moment<Self>) {
        let piece = &self.programs.loads[index];
        let values = self.values(piece, now);
        piece.given(&values).for_each(|value| now.load(index, value));
    }
}

impl AllSignals for InterpretedPieces<'_> {
    fn signals(&self, inputs: &[u64], registers: &[u64], values: &mut [u64]) {
        let all = &self.programs.all;
        let source = |source: &Source| match *source {
            Source::Input(index) => inputs[index],
            Source::Register(index) => registers[index],
            _ => 0,
        };
        let computed = all.program.run(all.reads.iter().map(source));
        for (value, given) in values.iter_mut().zip(all.given(&computed)) {
            *value = given;
        }
    }
}

impl Kernel for InterpretedPieces<'_> {
    type Slots = Vec<u64>;
    type Nets = Vec<u64>;
    type Groups = Vec<u64>;
    type Counters = Vec<Coasting>;

    fn blank(&self) -> Moment<Self> {
        let partition = self.circuit.partition();
        let counters = partition.counters.len();
        let words = |bits: usize| vec![0; bits.div_ceil(64)];
        Moment::new(
            vec![0; self.circuit.slots()],
            words(partition.nets.len() + counters),
            words(partition.groups.len() + counters),
            partition.counters.iter().map(|piece| self.coasting(piece.counter.register)).collect(),
        )
    }

    fn net(&self, index: usize, now: &mut Moment<Self>) {
        let nets = &self.programs.nets;
        let Some(piece) = nets.get(index) else { return self.mode(index - nets.len(), now) };
        let values = self.values(piece, now);
        let slot = self.circuit.net_slot(index);
        for value in piece.given(&values) {
            if now.slots[slot] != value {
                now.slots[slot] = value;
                now.changed[index / 64] |= 1 << (index % 64);
                self.call(slot, now);
            }
        }
    }

    fn group(&self, index: usize, now: &mut Moment<Self>) {
        let groups = &self.programs.groups;
        let Some(piece) = groups.get(index) else { return self.load(index - groups.len(), now) };
        let values = self.values(piece, now);
        let registers = &self.circuit.partition().groups[index].registers;
        for (register, value) in registers.iter().zip(piece.given(&values)) {
            let slot = self.circuit.register_slot(*register);
            if now.slots[slot] != value {
                now.slots[slot] = value;
                self.call(slot, now);
            }
        }
    }

    fn input_changed(&self, index: usize, now: &mut Moment<Self>) {
        self.call(index, now);
    }

    fn counter_moved(&self, index: usize, now: &mut Moment<Self>) {
        self.call(self.circuit.slots() + index, now);
    }
}
