//! A design cut into pieces that are evaluated only when something they read has changed.
//!
//! Registers of one instance form a *group*: at a clock edge they take their next values together.
//! Groups see each other, and the outputs are seen, only through *nets*: settled copies of signals,
//! each of which tells its readers when it changes. [`Counter`]s stand apart: a *mode* says between
//! edges how the counter moves, and only a *load* costs an edge.
//!
//! ```text
//! inputs, registers ──► nets, in order ──► modes      between edges
//! inputs, own registers, nets ──► groups, loads       at an edge
//! ```
//!
//! A group reads foreign registers through nets, never directly: so groups can be updated in place,
//! in any order, each seeing what was there before the edge. Counters are the exception: their loads
//! are taken after all groups.

use std::collections::{BTreeMap, BTreeSet};

use crate::drivers::{Driver, Drivers};
use crate::settle::{Counter, counters};
use crate::{Netlist, SignalId};

/// Counters narrower than this are stepped: they leave their stretch too soon to be worth a mode.
const NARROWEST_COUNTER: u32 = 6;

/// A place a piece reads from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Source {
    /// Index in [`Netlist::inputs`].
    Input(usize),
    /// Index in [`Netlist::registers`], not a counter.
    Register(usize),
    /// Index in [`Partition::counters`].
    Counter(usize),
    /// Index in [`Partition::nets`].
    Net(usize),
    /// Undriven: zero.
    Nothing,
}

/// What it takes to evaluate a piece.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Task {
    /// Signals taken from elsewhere, by the names under which `body` reads them.
    pub reads: BTreeMap<SignalId, Source>,
    /// Indices in [`Netlist::assignments`], in evaluation order.
    pub body: Vec<usize>,
}

/// A settled signal with readers in other groups or outside.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Net {
    /// The signal; an output of a register when the net only copies it.
    pub signal: SignalId,
    /// Gives the signal.
    pub task: Task,
}

/// Registers that take their next values together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Group {
    /// Indices in [`Netlist::registers`].
    pub registers: Vec<usize>,
    /// Gives the inputs of the registers.
    pub task: Task,
}

/// A counter with what evaluates it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CounterPiece {
    /// The counter.
    pub counter: Counter,
    /// Gives what its `counting`, `step` and `thresholds` read.
    pub mode: Task,
    /// Gives its input.
    pub load: Task,
}

/// Who reads a source.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Readers {
    /// Nets; after them, from [`Partition::nets`]`.len()` up, modes of counters.
    pub nets: BTreeSet<usize>,
    /// Groups.
    pub groups: BTreeSet<usize>,
}

/// The pieces of a design.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Partition {
    /// In evaluation order: a net reads inputs, registers and nets before it.
    pub nets: Vec<Net>,
    /// In the order of their instances.
    pub groups: Vec<Group>,
    /// In the order of their registers.
    pub counters: Vec<CounterPiece>,
    /// By source.
    pub readers: BTreeMap<Source, Readers>,
}

impl Partition {
    /// Cuts a design along its instances.
    #[must_use]
    pub fn new(netlist: &Netlist) -> Self {
        let cut = Cut::new(netlist);
        let nets = cut.nets.iter().map(|signal| cut.net(*signal)).collect();
        let groups = cut.groups.iter().map(|registers| cut.group(registers)).collect();
        let counters = cut.counters.iter().map(|counter| cut.counter(counter)).collect();
        let mut partition = Self { nets, groups, counters, readers: BTreeMap::new() };
        partition.readers = partition.find_readers();
        partition
    }

    /// The net that shows a signal of the given origin, if one does.
    #[must_use]
    pub fn net_of(&self, origin: SignalId) -> Option<usize> {
        self.nets.iter().position(|net| net.signal == origin)
    }

    fn find_readers(&self) -> BTreeMap<Source, Readers> {
        let mut readers: BTreeMap<Source, Readers> = BTreeMap::new();
        for (index, net) in self.nets.iter().enumerate() {
            for source in net.task.reads.values() {
                readers.entry(*source).or_default().nets.insert(index);
            }
        }
        for (index, group) in self.groups.iter().enumerate() {
            for source in group.task.reads.values() {
                readers.entry(*source).or_default().groups.insert(index);
            }
        }
        for (index, piece) in self.counters.iter().enumerate() {
            let own = [Source::Counter(index)];
            for source in piece.mode.reads.values().chain(piece.load.reads.values()).chain(&own) {
                readers.entry(*source).or_default().nets.insert(self.nets.len() + index);
            }
        }
        readers
    }
}

/// From where a piece looks at signals.
#[derive(Clone, Copy)]
enum View<'a> {
    /// Between edges, from an instance: all registers are at rest and read directly.
    Settled(&'a str),
    /// At an edge, from the group of an instance: foreign registers may be new already.
    Edge(&'a str),
    /// At an edge, from a counter in an instance: all other registers may be new already.
    Load(&'a str),
}

/// The netlist with the decisions where to cut.
struct Cut<'a> {
    netlist: &'a Netlist,
    drivers: Drivers<'a>,
    counters: Vec<Counter>,
    /// Registers that are not counters, by instance.
    groups: Vec<Vec<usize>>,
    /// Signals that become nets, in evaluation order.
    nets: Vec<SignalId>,
    /// Signals that show a counter: never a net, for they change at every clock.
    shown: BTreeSet<SignalId>,
}

impl<'a> Cut<'a> {
    fn new(netlist: &'a Netlist) -> Self {
        let drivers = Drivers::new(netlist);
        let counters = counters(netlist, NARROWEST_COUNTER);
        let shown = counters.iter().flat_map(|counter| counter.shown.iter().copied()).collect();
        let groups = groups(netlist, &counters);
        let mut cut = Self { netlist, drivers, counters, groups, nets: Vec::new(), shown };
        cut.nets = cut.find_nets();
        cut
    }

    /// Signals that cross from group to group or to the outside, in evaluation order.
    fn find_nets(&self) -> Vec<SignalId> {
        let mut nets = BTreeSet::new();
        let mut open: Vec<SignalId> = self.output_nets();
        for registers in &self.groups {
            let view = View::Edge(self.instance_of_register(registers[0]));
            open.extend(self.crossings(self.inputs_of(registers), view));
        }
        for counter in &self.counters {
            let instance = self.instance_of_register(counter.register);
            let input = self.inputs_of(&[counter.register]);
            open.extend(self.crossings(input, View::Load(instance)));
            open.extend(self.crossings(mode_reads(counter), View::Settled(instance)));
        }
        while let Some(net) = open.pop() {
            if nets.insert((self.level(net), net))
                && let Some(value) = self.drivers.logic(net)
            {
                let mut reads = Vec::new();
                value.reads(&mut reads);
                open.extend(self.crossings(reads, View::Settled(self.instance(net))));
            }
        }
        nets.into_iter().map(|(_, net)| net).collect()
    }

    /// Outputs that change only when something happens.
    fn output_nets(&self) -> Vec<SignalId> {
        let origins = self.netlist.outputs.iter().map(|output| self.drivers.origin(*output));
        origins.filter(|origin| self.may_be_net(*origin)).collect()
    }

    fn may_be_net(&self, origin: SignalId) -> bool {
        !self.shown.contains(&origin)
            && matches!(self.drivers.of(origin), Driver::Assignment(_) | Driver::Register(_))
    }

    /// Origins within the cones of `roots` that the view sees only as nets.
    fn crossings(&self, roots: Vec<SignalId>, view: View) -> Vec<SignalId> {
        let crosses = |origin| self.crosses(origin, view);
        let ends = self.drivers.ends(roots, crosses);
        ends.into_iter().filter(|end| crosses(*end)).collect()
    }

    fn crosses(&self, origin: SignalId, view: View) -> bool {
        if !self.may_be_net(origin) {
            return false;
        }
        let (View::Settled(instance) | View::Edge(instance) | View::Load(instance)) = view;
        let foreign = self.instance(origin) != instance;
        match (self.drivers.of(origin), view) {
            (Driver::Register(_), View::Settled(_)) => false,
            (Driver::Register(_), View::Load(_)) => true,
            _ => foreign,
        }
    }

    fn net(&self, signal: SignalId) -> Net {
        let view = View::Settled(self.instance(signal));
        let mut task = Task::default();
        match self.drivers.of(signal) {
            Driver::Assignment(index) => {
                let mut reads = Vec::new();
                self.netlist.assignments[index].value.reads(&mut reads);
                task = self.task(reads, view);
                task.body.push(index);
            }
            _ => _ = task.reads.insert(signal, self.source(signal)),
        }
        Net { signal, task }
    }

    fn group(&self, registers: &[usize]) -> Group {
        let view = View::Edge(self.instance_of_register(registers[0]));
        let task = self.task(self.inputs_of(registers), view);
        Group { registers: registers.to_vec(), task }
    }

    fn counter(&self, counter: &Counter) -> CounterPiece {
        let instance = self.instance_of_register(counter.register);
        let mode = self.task(mode_reads(counter), View::Settled(instance));
        let load = self.task(self.inputs_of(&[counter.register]), View::Load(instance));
        CounterPiece { counter: counter.clone(), mode, load }
    }

    /// What gives `roots`, seen from a piece.
    fn task(&self, roots: Vec<SignalId>, view: View) -> Task {
        let mut task = Task::default();
        let mut seen = BTreeSet::new();
        let mut body = BTreeSet::new();
        let mut open = roots;
        while let Some(signal) = open.pop() {
            if !seen.insert(signal) {
                continue;
            }
            let origin = self.drivers.origin(signal);
            if self.crosses(origin, view) {
                task.reads.insert(signal, Source::Net(self.net_index(origin)));
            } else if let Driver::Assignment(index) = self.drivers.of(signal) {
                body.insert(index);
                self.netlist.assignments[index].value.reads(&mut open);
            } else {
                task.reads.insert(signal, self.source(signal));
            }
        }
        task.body = body.into_iter().collect();
        task
    }

    /// Where a signal that no logic drives is kept.
    fn source(&self, signal: SignalId) -> Source {
        match self.drivers.of(signal) {
            Driver::Input(index) => Source::Input(index),
            Driver::Register(register) => self
                .counters
                .iter()
                .position(|counter| counter.register == register)
                .map_or(Source::Register(register), Source::Counter),
            Driver::Assignment(_) | Driver::Nothing => Source::Nothing,
        }
    }

    fn net_index(&self, origin: SignalId) -> usize {
        let key = (self.level(origin), origin);
        let found = self.nets.binary_search_by_key(&key, |net| (self.level(*net), *net));
        found.expect("every crossing was made a net when the nets were found")
    }

    fn inputs_of(&self, registers: &[usize]) -> Vec<SignalId> {
        registers.iter().map(|register| self.netlist.registers[*register].input).collect()
    }

    /// Place in evaluation order; what no logic drives comes first.
    fn level(&self, signal: SignalId) -> usize {
        match self.drivers.of(signal) {
            Driver::Assignment(index) => index + 1,
            _ => 0,
        }
    }

    fn instance(&self, signal: SignalId) -> &'a str {
        instance(self.netlist, signal)
    }

    fn instance_of_register(&self, register: usize) -> &'a str {
        instance_of_register(self.netlist, register)
    }
}

fn mode_reads(counter: &Counter) -> Vec<SignalId> {
    let mut reads = Vec::new();
    counter.counting.reads(&mut reads);
    counter.step.reads(&mut reads);
    for threshold in &counter.thresholds {
        threshold.reads(&mut reads);
    }
    reads
}

fn groups(netlist: &Netlist, counters: &[Counter]) -> Vec<Vec<usize>> {
    let mut groups: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    for register in 0..netlist.registers.len() {
        if counters.iter().all(|counter| counter.register != register) {
            groups.entry(instance_of_register(netlist, register)).or_default().push(register);
        }
    }
    groups.into_values().collect()
}

/// The path of the instance a signal belongs to; empty for the top.
fn instance(netlist: &Netlist, signal: SignalId) -> &str {
    netlist.signal(signal).path.rsplit_once('.').map_or("", |(instance, _)| instance)
}

/// The instance a register is in.
fn instance_of_register(netlist: &Netlist, register: usize) -> &str {
    instance(netlist, netlist.registers[register].output)
}
