//! Event-driven simulation in whole picoseconds.
//!
//! At an instant, everything that is due changes first; then every part with a changed input looks
//! at its inputs, once. So the answer does not depend on an order within the instant. Outputs are
//! inertial: one that is on its way to a level and is told otherwise before it gets there stays
//! where it is. Each part has a delay of at least a picosecond.

mod findings;
mod flip_flop;
mod power_up;

use std::cmp::Reverse;
use std::collections::{BinaryHeap, VecDeque};

use bitvec::vec::BitVec;

use crate::circuit::{Circuit, Function, Net};
use crate::delays::Delays;
use crate::error::Error;

use self::findings::Findings;
use self::flip_flop::{FlipFlop, Pins};

pub use self::findings::{Check, Finding};

/// A wire changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Edge {
    /// When.
    pub time_ps: u64,
    /// Which.
    pub net: Net,
    /// To what.
    pub level: bool,
}

/// A circuit with its delays, under power.
#[derive(Clone, Debug)]
pub struct Simulator<'a> {
    circuit: &'a Circuit,
    now_ps: u64,
    levels: Vec<bool>,
    cells: Vec<Cell>,
    /// Inputs of all cells, one behind the other.
    inputs: Vec<u32>,
    /// Cells that a net leads to: where they begin in the list behind, net by net.
    readers: (Vec<u32>, Vec<u32>),
    outputs: Vec<Output>,
    flip_flops: Vec<FlipFlop>,
    queue: BinaryHeap<Reverse<(u64, u32, u32)>>,
    stimuli: VecDeque<(u64, Net, bool)>,
    awake: Vec<u32>,
    is_awake: Vec<bool>,
    watched: Vec<bool>,
    edges: Vec<Edge>,
    findings: Findings,
    events: u64,
}

#[derive(Clone, Copy, Debug)]
struct Cell {
    function: Function,
    /// Where its inputs begin.
    inputs: u32,
    count: u32,
    output: u32,
    /// Its number among the flip-flops.
    flip_flop: u32,
}

#[derive(Clone, Copy, Debug)]
struct Output {
    net: u32,
    cell: u32,
    delays_ps: [u64; 2],
    /// Level at which it is, or to which it is on its way.
    aim: bool,
    aimed_ps: u64,
    /// Of the event that is on its way; older ones are void.
    ticket: u32,
}

impl<'a> Simulator<'a> {
    /// Switches on, all flip-flops low.
    ///
    /// # Errors
    ///
    /// When gates do not come to rest.
    pub fn new(circuit: &'a Circuit, delays: &Delays) -> Result<Self, Error> {
        let flip_flops = circuit.elements.iter().filter(|one| one.outputs.len() == 2).count();
        Self::woken(circuit, delays, &BitVec::repeat(false, flip_flops))
    }

    /// Switches on with the flip-flops in these states, in the order of the elements.
    ///
    /// # Errors
    ///
    /// When gates do not come to rest.
    pub fn woken(circuit: &'a Circuit, delays: &Delays, states: &BitVec) -> Result<Self, Error> {
        let mut simulator = Self::empty(circuit);
        let mut edges = delays.0.iter();
        for element in &circuit.elements {
            let output = small(simulator.outputs.len());
            let cell = small(simulator.cells.len());
            for net in &element.outputs {
                let delays_ps = *edges.next().unwrap_or(&[1, 1]);
                let (net, aim) = (small(net.0), false);
                simulator.outputs.push(Output {
                    net,
                    cell,
                    delays_ps,
                    aim,
                    aimed_ps: 0,
                    ticket: 0,
                });
            }
            let (inputs, count) = (small(simulator.inputs.len()), small(element.inputs.len()));
            let flip_flop = small(simulator.flip_flops.len());
            if element.outputs.len() == 2 {
                let wakes_up = states.get(simulator.flip_flops.len()).is_some_and(|bit| *bit);
                simulator.flip_flops.push(FlipFlop::new(wakes_up));
            }
            simulator.inputs.extend(element.inputs.iter().map(|net| small(net.0)));
            simulator.cells.push(Cell {
                function: element.function,
                inputs,
                count,
                output,
                flip_flop,
            });
        }
        simulator.is_awake = vec![false; simulator.cells.len()];
        simulator.settle()?;
        Ok(simulator)
    }

    fn empty(circuit: &'a Circuit) -> Self {
        let mut levels = vec![false; circuit.nets.len()];
        levels[Circuit::HIGH.0] = true;
        for (net, level) in &circuit.inputs {
            levels[net.0] = *level;
        }
        Self {
            circuit,
            now_ps: 0,
            levels,
            cells: vec![],
            inputs: vec![],
            readers: readers(circuit),
            outputs: vec![],
            flip_flops: vec![],
            queue: BinaryHeap::new(),
            stimuli: VecDeque::new(),
            awake: vec![],
            is_awake: vec![],
            watched: vec![true; circuit.nets.len()],
            edges: vec![],
            findings: Findings::default(),
            events: 0,
        }
    }

    /// Keeps the edges of these wires only; without this, of all.
    pub fn watch(&mut self, nets: &[Net]) {
        self.watched.fill(false);
        for net in nets {
            self.watched[net.0] = true;
        }
    }

    /// Drives a pin from an instant on.
    ///
    /// # Errors
    ///
    /// When that is before the present, or before a change that is already asked for.
    pub fn drive(&mut self, time_ps: u64, pin: Net, level: bool) -> Result<(), Error> {
        let last_ps = self.stimuli.back().map_or(self.now_ps, |last| last.0);
        if time_ps < last_ps {
            return Err(Error::Late { time_ps, now_ps: last_ps });
        }
        self.stimuli.push_back((time_ps, pin, level));
        Ok(())
    }

    /// Lets time pass, up to this instant and with all that happens at it.
    pub fn run_until(&mut self, end_ps: u64) {
        while let Some(time_ps) = self.next_ps().filter(|next| *next <= end_ps) {
            self.step(time_ps);
        }
        self.now_ps = self.now_ps.max(end_ps);
    }

    /// Level of a wire.
    #[must_use]
    pub fn level(&self, net: Net) -> bool {
        self.levels[net.0]
    }

    /// Levels of all wires, in the order of [`Circuit::nets`].
    #[must_use]
    pub fn levels(&self) -> &[bool] {
        &self.levels
    }

    /// The present, ps.
    #[must_use]
    pub fn now_ps(&self) -> u64 {
        self.now_ps
    }

    /// Edges since they were last taken, in the order of time, then of wires.
    pub fn take_edges(&mut self) -> Vec<Edge> {
        let mut edges = std::mem::take(&mut self.edges);
        edges.sort_unstable();
        edges
    }

    /// What the data sheets do not allow, and what was swallowed.
    #[must_use]
    pub fn findings(&self) -> Vec<Finding> {
        self.findings.list(self.circuit)
    }

    /// Changes of outputs so far.
    #[must_use]
    pub fn events(&self) -> u64 {
        self.events
    }

    fn next_ps(&self) -> Option<u64> {
        let due = self.queue.peek().map(|Reverse((time_ps, ..))| *time_ps);
        let driven = self.stimuli.front().map(|(time_ps, ..)| *time_ps);
        due.into_iter().chain(driven).min()
    }

    /// All that happens at an instant.
    fn step(&mut self, time_ps: u64) {
        self.now_ps = time_ps;
        while let Some(&Reverse((due_ps, output, ticket))) = self.queue.peek()
            && due_ps == time_ps
        {
            self.queue.pop();
            let Output { net, aim, ticket: last, .. } = self.outputs[output as usize];
            if ticket == last {
                self.change(Net(net as usize), aim);
                self.events += 1;
            }
        }
        while self.stimuli.front().is_some_and(|next| next.0 == time_ps) {
            if let Some((_, net, level)) = self.stimuli.pop_front() {
                self.change(net, level);
            }
        }
        while let Some(cell) = self.awake.pop() {
            self.is_awake[cell as usize] = false;
            self.look(cell);
        }
    }

    fn change(&mut self, net: Net, level: bool) {
        if std::mem::replace(&mut self.levels[net.0], level) == level {
            return;
        }
        if self.watched[net.0] {
            self.edges.push(Edge { time_ps: self.now_ps, net, level });
        }
        let (starts, cells) = &self.readers;
        for cell in &cells[starts[net.0] as usize..starts[net.0 + 1] as usize] {
            if !std::mem::replace(&mut self.is_awake[*cell as usize], true) {
                self.awake.push(*cell);
            }
        }
    }

    /// A part looks at its inputs.
    fn look(&mut self, number: u32) {
        let cell = self.cells[number as usize];
        if let Function::FlipFlop { j } = cell.function {
            let pins = self.pins(cell, j);
            let flip_flop = &mut self.flip_flops[cell.flip_flop as usize];
            flip_flop.look(self.now_ps, pins, |check, width_ps| {
                self.findings.note(number, check, width_ps, self.now_ps);
            });
            let level = flip_flop.level();
            self.aim(cell.output, level);
            self.aim(cell.output + 1, !level);
        } else {
            let level = self.value(cell);
            self.aim(cell.output, level);
        }
    }

    fn levels_of(&self, cell: Cell) -> impl Iterator<Item = bool> {
        let inputs = &self.inputs[cell.inputs as usize..(cell.inputs + cell.count) as usize];
        inputs.iter().map(|net| self.levels[*net as usize])
    }

    fn value(&self, cell: Cell) -> bool {
        let mut levels = self.levels_of(cell);
        match cell.function {
            Function::And => levels.all(|level| level),
            Function::Nand => levels.any(|level| !level),
            Function::Nor => !levels.any(|level| level),
            Function::Or | Function::Delay => levels.any(|level| level),
            Function::AndOrInvert => {
                let mut pair = || levels.by_ref().take(2).fold(true, |all, level| all & level);
                let (first, second) = (pair(), pair());
                !(first | second)
            }
            Function::FlipFlop { .. } => self.flip_flops[cell.flip_flop as usize].level(),
        }
    }

    fn pins(&self, cell: Cell, j: usize) -> Pins {
        let mut levels = self.levels_of(cell);
        let mut next = || levels.next().unwrap_or(true);
        let (clock, preset, clear) = (next(), next(), next());
        let all = |levels: &mut dyn Iterator<Item = bool>| levels.fold(true, |all, one| all & one);
        let j = all(&mut levels.by_ref().take(j));
        Pins { clock, preset, clear, j, k: all(&mut levels) }
    }

    /// An output is told where to go.
    fn aim(&mut self, number: u32, level: bool) {
        let output = &mut self.outputs[number as usize];
        if output.aim == level {
            return;
        }
        output.aim = level;
        output.ticket = output.ticket.wrapping_add(1);
        if self.levels[output.net as usize] == level {
            let width_ps = self.now_ps - output.aimed_ps;
            self.findings.note(output.cell, Check::Swallowed, width_ps, self.now_ps);
        } else {
            output.aimed_ps = self.now_ps;
            let due_ps = self.now_ps + output.delays_ps[usize::from(!level)].max(1);
            self.queue.push(Reverse((due_ps, number, output.ticket)));
        }
    }
}

/// For each net the cells that read it.
fn readers(circuit: &Circuit) -> (Vec<u32>, Vec<u32>) {
    let mut lists = vec![Vec::new(); circuit.nets.len()];
    for (number, element) in circuit.elements.iter().enumerate() {
        for net in &element.inputs {
            lists[net.0].push(small(number));
        }
    }
    let mut starts = vec![0];
    let mut cells = Vec::new();
    for mut list in lists {
        list.dedup();
        cells.append(&mut list);
        starts.push(small(cells.len()));
    }
    (starts, cells)
}

/// Numbers of parts and wires fit in four bytes.
fn small(number: usize) -> u32 {
    u32::try_from(number).expect("a device has fewer than four thousand million parts")
}
