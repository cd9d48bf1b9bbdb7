//! The kernel of many copies: one bit a lane, so that a word operation serves 64 copies at once.
//!
//! Every signal is taken apart into bits and every operator into and, or, exclusive or; constants
//! fold and equal gates are made once. The code is straight-line and generic in the vector it
//! computes with, so that it is compiled for every kind the processor may have.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use helixlock_netlist::drivers::{Driver, Drivers};
use helixlock_netlist::{Expression, Netlist, Node, SignalId};

use super::dense::indented;

/// `impl LaneKernel for name`.
pub(super) fn source(netlist: &Netlist, name: &str) -> String {
    let mut gates = Gates::new(netlist);
    let next: Vec<Bit> =
        netlist.registers.iter().flat_map(|register| gates.signal(register.input)).collect();
    let mut lines = gates.lines;
    for (index, bit) in next.iter().enumerate() {
        lines.push(format!("{}.store(&mut next[{index}]);", bit.text()));
    }
    let width = |signal: &SignalId| netlist.signal(*signal).width as usize;
    let inputs: usize = netlist.inputs.iter().map(width).sum();
    let body = indented(&lines);
    let mut source = String::new();
    // Writing into a string does not fail.
    let _ = write!(
        source,
        "impl LaneKernel for {name} {{
    type Inputs = [Lane; {inputs}];
    type State = [Lane; {state}];
    const INPUTS: Self::Inputs = [[0; LANE_WORDS]; {inputs}];
    const STATE: Self::State = [[0; LANE_WORDS]; {state}];

    #[inline(always)]
    fn step<V: Vector>(inputs: &Self::Inputs, now: &Self::State, next: &mut Self::State) {{
{body}    }}
}}

",
        state = next.len(),
    );
    source
}

/// One bit in all lanes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Bit {
    Constant(bool),
    Gate(usize),
}

const ZERO: Bit = Bit::Constant(false);
const ONE: Bit = Bit::Constant(true);

impl Bit {
    fn text(self) -> String {
        match self {
            Self::Constant(value) => format!("V::of({value})"),
            Self::Gate(index) => format!("g{index}"),
        }
    }
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Gate {
    Input(usize),
    State(usize),
    Not(usize),
    And(usize, usize),
    Or(usize, usize),
    Xor(usize, usize),
    /// Condition, then, otherwise.
    Choose(usize, usize, usize),
}

struct Gates<'a> {
    drivers: Drivers<'a>,
    netlist: &'a Netlist,
    /// Place of the lowest bit of each input and register.
    low: BTreeMap<SignalId, usize>,
    signals: BTreeMap<SignalId, Vec<Bit>>,
    known: BTreeMap<Gate, usize>,
    made: Vec<Gate>,
    lines: Vec<String>,
}

impl<'a> Gates<'a> {
    fn new(netlist: &'a Netlist) -> Self {
        let mut low = BTreeMap::new();
        let outputs = netlist.registers.iter().map(|register| register.output);
        for signals in [netlist.inputs.clone(), outputs.collect()] {
            let mut next = 0;
            for signal in signals {
                low.insert(signal, next);
                next += netlist.signal(signal).width as usize;
            }
        }
        Self {
            drivers: Drivers::new(netlist),
            netlist,
            low,
            signals: BTreeMap::new(),
            known: BTreeMap::new(),
            made: Vec::new(),
            lines: Vec::new(),
        }
    }

    /// Lowest bit first.
    fn signal(&mut self, signal: SignalId) -> Vec<Bit> {
        if let Some(bits) = self.signals.get(&signal) {
            return bits.clone();
        }
        let width = self.netlist.signal(signal).width as usize;
        let bits = match self.drivers.of(signal) {
            Driver::Input(_) => self.places(signal, width, Gate::Input),
            Driver::Register(_) => self.places(signal, width, Gate::State),
            Driver::Assignment(index) => self.value(&self.netlist.assignments[index].value),
            Driver::Nothing => vec![ZERO; width],
        };
        self.signals.insert(signal, bits.clone());
        bits
    }

    fn places(&mut self, signal: SignalId, width: usize, gate: fn(usize) -> Gate) -> Vec<Bit> {
        let low = self.low[&signal];
        (low..low + width).map(|place| self.gate(gate(place))).collect()
    }

    fn value(&mut self, expression: &Expression) -> Vec<Bit> {
        let width = expression.width as usize;
        match &expression.node {
            Node::Constant(value) => constant(*value, width),
            Node::Signal(id) => self.signal(*id),
            Node::Extend(a) => extended(self.value(a), width),
            Node::Slice { of, low } => self.value(of)[*low as usize..][..width].to_vec(),
            Node::Not(a) => self.value(a).into_iter().map(|bit| self.not(bit)).collect(),
            Node::And(a, b) => self.bitwise(a, b, Self::and),
            Node::Or(a, b) => self.bitwise(a, b, Self::or),
            Node::Xor(a, b) => self.bitwise(a, b, Self::xor),
            Node::Add(a, b) => self.sum(a, b, false).0,
            Node::Subtract(a, b) => self.sum(a, b, true).0,
            Node::ShiftUp(a, b) => self.shifted(a, b, true),
            Node::ShiftDown(a, b) => self.shifted(a, b, false),
            Node::Equal(a, b) => vec![self.equal(a, b)],
            // Left is below right when right does not fit into it: no carry out of left − right.
            Node::Less(a, b) => {
                let carry = self.sum(a, b, true).1;
                vec![self.not(carry)]
            }
            Node::LessOrEqual(a, b) => vec![self.sum(b, a, true).1],
            Node::All(a) => self.folded(a, ONE, Self::and),
            Node::Any(a) => self.folded(a, ZERO, Self::or),
            Node::Parity(a) => self.folded(a, ZERO, Self::xor),
            Node::Select { condition, then, otherwise } => {
                let condition = self.value(condition)[0];
                let (then, otherwise) = (self.value(then), self.value(otherwise));
                let pairs = then.into_iter().zip(otherwise);
                pairs.map(|(then, otherwise)| self.choose(condition, then, otherwise)).collect()
            }
        }
    }

    fn bitwise(
        &mut self,
        a: &Expression,
        b: &Expression,
        gate: fn(&mut Self, Bit, Bit) -> Bit,
    ) -> Vec<Bit> {
        let (a, b) = (self.value(a), self.value(b));
        a.into_iter().zip(b).map(|(a, b)| gate(self, a, b)).collect()
    }

    fn folded(
        &mut self,
        a: &Expression,
        start: Bit,
        gate: fn(&mut Self, Bit, Bit) -> Bit,
    ) -> Vec<Bit> {
        let bits = self.value(a);
        vec![bits.into_iter().fold(start, |all, bit| gate(self, all, bit))]
    }

    fn equal(&mut self, a: &Expression, b: &Expression) -> Bit {
        let (a, b) = (self.value(a), self.value(b));
        let mut equal = ONE;
        for (a, b) in a.into_iter().zip(b) {
            let differs = self.xor(a, b);
            let alike = self.not(differs);
            equal = self.and(equal, alike);
        }
        equal
    }

    /// Sum, or difference as `a + !b + 1`, with the carry out of it.
    fn sum(&mut self, a: &Expression, b: &Expression, subtract: bool) -> (Vec<Bit>, Bit) {
        let (a, b) = (self.value(a), self.value(b));
        let mut carry = Bit::Constant(subtract);
        let mut sum = Vec::new();
        for (a, b) in a.into_iter().zip(b) {
            let b = if subtract { self.not(b) } else { b };
            let half = self.xor(a, b);
            sum.push(self.xor(half, carry));
            // Where the operands differ the carry goes on, where not they make it.
            carry = self.choose(half, carry, a);
        }
        (sum, carry)
    }

    /// A barrel shifter, one stage a bit of the distance.
    fn shifted(&mut self, a: &Expression, b: &Expression, up: bool) -> Vec<Bit> {
        let mut value = self.value(a);
        for (stage, bit) in self.value(b).into_iter().enumerate() {
            let width = value.len();
            let by = if stage < 32 { (1 << stage).min(width) } else { width };
            let zeros = vec![ZERO; by];
            let moved = if up {
                [&zeros[..], &value[..width - by]].concat()
            } else {
                [&value[by..], &zeros[..]].concat()
            };
            let pairs = moved.into_iter().zip(value);
            value = pairs.map(|(moved, kept)| self.choose(bit, moved, kept)).collect();
        }
        value
    }

    fn not(&mut self, bit: Bit) -> Bit {
        match bit {
            Bit::Constant(value) => Bit::Constant(!value),
            Bit::Gate(index) => match self.made[index] {
                Gate::Not(of) => Bit::Gate(of),
                _ => self.gate(Gate::Not(index)),
            },
        }
    }

    fn and(&mut self, a: Bit, b: Bit) -> Bit {
        match (a.min(b), a.max(b)) {
            (ZERO, _) => ZERO,
            (ONE, other) => other,
            (a, b) if a == b => a,
            (Bit::Gate(a), Bit::Gate(b)) if self.opposite(a, b) => ZERO,
            (Bit::Gate(a), Bit::Gate(b)) => self.gate(Gate::And(a, b)),
            (a, _) => a,
        }
    }

    fn or(&mut self, a: Bit, b: Bit) -> Bit {
        match (a.min(b), a.max(b)) {
            (ZERO, other) => other,
            (ONE, _) => ONE,
            (a, b) if a == b => a,
            (Bit::Gate(a), Bit::Gate(b)) if self.opposite(a, b) => ONE,
            (Bit::Gate(a), Bit::Gate(b)) => self.gate(Gate::Or(a, b)),
            (a, _) => a,
        }
    }

    fn xor(&mut self, a: Bit, b: Bit) -> Bit {
        match (a.min(b), a.max(b)) {
            (ZERO, other) => other,
            (ONE, other) => self.not(other),
            (a, b) if a == b => ZERO,
            (Bit::Gate(a), Bit::Gate(b)) if self.opposite(a, b) => ONE,
            (Bit::Gate(a), Bit::Gate(b)) => self.gate(Gate::Xor(a, b)),
            (a, _) => a,
        }
    }

    fn choose(&mut self, condition: Bit, then: Bit, otherwise: Bit) -> Bit {
        match (condition, then, otherwise) {
            (ONE, then, _) => then,
            (ZERO, _, otherwise) => otherwise,
            (_, then, otherwise) if then == otherwise => then,
            (condition, then, otherwise) if then == condition => self.or(condition, otherwise),
            (condition, then, otherwise) if otherwise == condition => self.and(condition, then),
            (condition, ONE, otherwise) => self.or(condition, otherwise),
            (condition, then, ZERO) => self.and(condition, then),
            (condition, ZERO, otherwise) => {
                let clear = self.not(condition);
                self.and(clear, otherwise)
            }
            (condition, then, ONE) => {
                let clear = self.not(condition);
                self.or(clear, then)
            }
            (Bit::Gate(condition), Bit::Gate(then), Bit::Gate(otherwise)) => {
                self.gate(Gate::Choose(condition, then, otherwise))
            }
        }
    }

    fn opposite(&self, a: usize, b: usize) -> bool {
        self.made[a] == Gate::Not(b) || self.made[b] == Gate::Not(a)
    }

    /// A gate, new unless there is one like it.
    fn gate(&mut self, gate: Gate) -> Bit {
        if let Some(index) = self.known.get(&gate) {
            return Bit::Gate(*index);
        }
        let index = self.made.len();
        let logic = match gate {
            Gate::Input(place) => format!("V::load(&inputs[{place}])"),
            Gate::State(place) => format!("V::load(&now[{place}])"),
            Gate::Not(a) => format!("g{a}.not()"),
            Gate::And(a, b) => format!("g{a}.and(g{b})"),
            Gate::Or(a, b) => format!("g{a}.or(g{b})"),
            Gate::Xor(a, b) => format!("g{a}.xor(g{b})"),
            Gate::Choose(a, b, c) => format!("g{a}.choose(g{b}, g{c})"),
        };
        self.lines.push(format!("let g{index} = {logic};"));
        self.made.push(gate);
        self.known.insert(gate, index);
        Bit::Gate(index)
    }
}

fn constant(value: u64, width: usize) -> Vec<Bit> {
    (0..width).map(|place| Bit::Constant(value >> place & 1 == 1)).collect()
}

fn extended(mut bits: Vec<Bit>, width: usize) -> Vec<Bit> {
    bits.resize(width, ZERO);
    bits
}
