//! Words taken apart into bits and every operator into and, or, exclusive or; constants fold and equal
//! gates are made once.

use std::collections::BTreeMap;

use helixlock_netlist::{Expression, Node};

use super::plan::{Leaf, Plan};
use super::words::Operand;

/// One bit in all lanes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Bit {
    Constant(bool),
    Gate(usize),
}

const ZERO: Bit = Bit::Constant(false);
const ONE: Bit = Bit::Constant(true);

/// What gives a bit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Gate {
    /// Place of the bit among those of all inputs.
    Input(usize),
    /// Place of the bit among those of all registers.
    State(usize),
    Not(usize),
    And(usize, usize),
    Or(usize, usize),
    Xor(usize, usize),
    /// Condition, then, otherwise.
    Choose(usize, usize, usize),
}

impl Gate {
    /// The gates that it reads.
    pub(super) fn operands(self) -> Vec<usize> {
        match self {
            Self::Input(_) | Self::State(_) => vec![],
            Self::Not(a) => vec![a],
            Self::And(a, b) | Self::Or(a, b) | Self::Xor(a, b) => vec![a, b],
            Self::Choose(a, b, c) => vec![a, b, c],
        }
    }

    /// True for a bit that is read as it is.
    pub(super) fn is_read(self) -> bool {
        matches!(self, Self::Input(_) | Self::State(_))
    }
}

/// The gates of a plan's words.
pub(super) struct Gates<'a> {
    plan: &'a Plan<'a>,
    /// Place of the lowest bit of each input.
    inputs: Vec<usize>,
    /// Place of the lowest bit of each register.
    registers: Vec<usize>,
    words: BTreeMap<usize, Vec<Bit>>,
    known: BTreeMap<Gate, usize>,
    /// By number: a gate stands behind those it reads.
    made: Vec<Gate>,
}

impl<'a> Gates<'a> {
    /// No gate yet; bits of inputs and registers stand at those places and above.
    pub(super) fn new(plan: &'a Plan, inputs: Vec<usize>, registers: Vec<usize>) -> Self {
        let (words, known, made) = (BTreeMap::new(), BTreeMap::new(), vec![]);
        Self { plan, inputs, registers, words, known, made }
    }

    /// All gates so far.
    pub(super) fn all(&self) -> &[Gate] {
        &self.made
    }

    /// The bits of a value, lowest first.
    pub(super) fn operand(&mut self, operand: Operand, width: u32) -> Vec<Bit> {
        let width = width as usize;
        match operand {
            Operand::Constant(value) => constant(value, width),
            Operand::Word(word) => extended(self.word(word), width),
        }
    }

    fn word(&mut self, word: usize) -> Vec<Bit> {
        if let Some(bits) = self.words.get(&word) {
            return bits.clone();
        }
        let plan = self.plan;
        let places = |low: usize| low..low + plan.words.all()[word].width as usize;
        let bits = match plan.leaf(word) {
            Some(Leaf::Input(input)) => {
                places(self.inputs[input]).map(|place| self.gate(Gate::Input(place))).collect()
            }
            Some(Leaf::Register(register)) => places(self.registers[register])
                .map(|place| self.gate(Gate::State(place)))
                .collect(),
            None => self.value(plan.words.rule(word)),
        };
        self.words.insert(word, bits.clone());
        bits
    }

    fn value(&mut self, expression: &Expression) -> Vec<Bit> {
        let width = expression.width as usize;
        match &expression.node {
            Node::Constant(value) => constant(*value, width),
            Node::Signal(word) => extended(self.word(word.0 as usize), width),
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
        // The high bits first: they move least, and what follows from them alone may be kept.
        for (a, b) in a.into_iter().zip(b).rev() {
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
            (Bit::Gate(a), _, Bit::Gate(b)) if self.opposite(a, b) => self.or(otherwise, then),
            (Bit::Gate(a), Bit::Gate(b), _) if self.opposite(a, b) => self.and(then, otherwise),
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
