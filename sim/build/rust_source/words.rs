//! Expressions as Rust on `u64` words: three-address code, each value computed once.

use std::collections::BTreeMap;
use std::fmt;

use helixlock_netlist::drivers::Drivers;
use helixlock_netlist::{Expression, Netlist, Node, SignalId, mask};

/// Straight-line code in the making.
pub(super) struct Words<'a> {
    netlist: &'a Netlist,
    drivers: Drivers<'a>,
    /// Values that signals have.
    signals: BTreeMap<SignalId, Operand>,
    /// Words computed already, by what computes them.
    known: BTreeMap<String, usize>,
    /// By number: a word is computed from words before it.
    computed: Vec<Word>,
}

/// What a word is computed from; prints as Rust.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Operand {
    Constant(u64),
    /// Number of the word.
    Word(usize),
}

impl fmt::Display for Operand {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Constant(value) => write!(formatter, "{value:#x}_u64"),
            Self::Word(index) => write!(formatter, "w{index}"),
        }
    }
}

/// A value with a name, `w0`, `w1`, ….
pub(super) struct Word {
    /// Rust that computes it.
    text: String,
    /// Words it is computed from; none when it is read from somewhere.
    pub(super) operands: Vec<usize>,
    /// The gate it is, when it is one of one bit.
    pub(super) gate: Option<Gate>,
}

/// Gates of one bit, which conditions are made of.
#[derive(Clone, Copy, Debug)]
pub(super) enum Gate {
    Not(Operand),
    And(Operand, Operand),
    Or(Operand, Operand),
}

impl<'a> Words<'a> {
    pub(super) fn new(netlist: &'a Netlist) -> Self {
        Self {
            netlist,
            drivers: Drivers::new(netlist),
            signals: BTreeMap::new(),
            known: BTreeMap::new(),
            computed: Vec::new(),
        }
    }

    /// Says where the value of a signal is found; it is read there once.
    pub(super) fn place(&mut self, signal: SignalId, place: &str) {
        let word = self.word(place.to_owned(), &[], None);
        self.signals.insert(signal, word);
    }

    /// The value of a signal: placed, or computed from what is.
    pub(super) fn signal(&mut self, signal: SignalId) -> Operand {
        if let Some(word) = self.signals.get(&signal) {
            return *word;
        }
        let word = match self.drivers.logic(signal) {
            Some(expression) => self.value(expression),
            None => Operand::Constant(0),
        };
        self.signals.insert(signal, word);
        word
    }

    /// Computes the targets of assignments, given in evaluation order.
    pub(super) fn body(&mut self, assignments: &[usize]) {
        for index in assignments {
            let target = self.netlist.assignments[*index].target;
            self.signal(target);
        }
    }

    /// The value of an expression.
    pub(super) fn value(&mut self, expression: &Expression) -> Operand {
        match &expression.node {
            Node::Constant(value) => return Operand::Constant(*value),
            Node::Signal(id) => return self.signal(*id),
            Node::Extend(a) => return self.value(a),
            _ => {}
        }
        let operands = expression.operands();
        let words: Vec<Operand> = operands.iter().map(|operand| self.value(operand)).collect();
        let text = computed(expression, &words, operands[0].width);
        let gate = (expression.width == 1).then(|| gate(&expression.node, &words)).flatten();
        self.word(text, &words, gate)
    }

    /// Complement of one bit.
    pub(super) fn not(&mut self, a: Operand) -> Operand {
        match a {
            Operand::Constant(bit) => Operand::Constant(bit ^ 1),
            Operand::Word(_) => self.word(format!("{a} ^ 0x1"), &[a], Some(Gate::Not(a))),
        }
    }

    /// Both bits.
    pub(super) fn and(&mut self, a: Operand, b: Operand) -> Operand {
        match (a, b) {
            (Operand::Constant(0), _) | (_, Operand::Constant(0)) => Operand::Constant(0),
            (Operand::Constant(_), other) | (other, Operand::Constant(_)) => other,
            _ => self.word(format!("{a} & {b}"), &[a, b], Some(Gate::And(a, b))),
        }
    }

    /// Either bit.
    pub(super) fn or(&mut self, a: Operand, b: Operand) -> Operand {
        match (a, b) {
            (Operand::Constant(0), other) | (other, Operand::Constant(0)) => other,
            (Operand::Constant(_), _) | (_, Operand::Constant(_)) => Operand::Constant(1),
            _ => self.word(format!("{a} | {b}"), &[a, b], Some(Gate::Or(a, b))),
        }
    }

    /// All words so far.
    pub(super) fn all(&self) -> &[Word] {
        &self.computed
    }

    /// The statement that computes a word.
    pub(super) fn line(&self, index: usize) -> String {
        format!("let w{index} = {};", self.computed[index].text)
    }

    /// The statements that compute all words.
    pub(super) fn lines(&self) -> Vec<String> {
        (0..self.computed.len()).map(|index| self.line(index)).collect()
    }

    /// A word holding what is computed, new unless the same has been computed before.
    fn word(&mut self, text: String, operands: &[Operand], gate: Option<Gate>) -> Operand {
        let next = self.computed.len();
        let index = *self.known.entry(text.clone()).or_insert(next);
        if index == next {
            let operands = operands.iter().copied().filter_map(number).collect();
            self.computed.push(Word { text, operands, gate });
        }
        Operand::Word(index)
    }
}

/// Number of the word, unless it is a constant.
pub(super) fn number(operand: Operand) -> Option<usize> {
    match operand {
        Operand::Constant(_) => None,
        Operand::Word(index) => Some(index),
    }
}

fn gate(node: &Node, operands: &[Operand]) -> Option<Gate> {
    match (node, operands) {
        (Node::Not(_), [a]) => Some(Gate::Not(*a)),
        (Node::And(..), [a, b]) => Some(Gate::And(*a, *b)),
        (Node::Or(..), [a, b]) => Some(Gate::Or(*a, *b)),
        _ => None,
    }
}

/// Rust for one operator; `width` is that of its first operand.
fn computed(expression: &Expression, operands: &[Operand], width: u32) -> String {
    let kept = mask(expression.width);
    let zero = Operand::Constant(0);
    let [a, b, c] = [0, 1, 2].map(|index| operands.get(index).copied().unwrap_or(zero));
    match &expression.node {
        Node::Not(_) => format!("{a} ^ {kept:#x}"),
        Node::And(..) => format!("{a} & {b}"),
        Node::Or(..) => format!("{a} | {b}"),
        Node::Xor(..) => format!("{a} ^ {b}"),
        Node::Add(..) => format!("u64::wrapping_add({a}, {b}) & {kept:#x}"),
        Node::Subtract(..) => format!("u64::wrapping_sub({a}, {b}) & {kept:#x}"),
        Node::ShiftUp(..) => format!("shift_up({a}, {b}) & {kept:#x}"),
        Node::ShiftDown(..) => format!("shift_down({a}, {b})"),
        Node::Equal(..) => format!("u64::from({a} == {b})"),
        Node::Less(..) => format!("u64::from({a} < {b})"),
        Node::LessOrEqual(..) => format!("u64::from({a} <= {b})"),
        Node::All(_) => format!("u64::from({a} == {:#x})", mask(width)),
        Node::Any(_) => format!("u64::from({a} != 0)"),
        Node::Parity(_) => format!("u64::from(u64::count_ones({a}) & 1)"),
        Node::Slice { low: 0, .. } => format!("{a} & {kept:#x}"),
        Node::Slice { low, .. } => format!("({a} >> {low}) & {kept:#x}"),
        // One bit chooses by logic, more by a mask: neither can become a branch.
        Node::Select { .. } if expression.width == 1 => format!("{c} ^ (({b} ^ {c}) & {a})"),
        Node::Select { .. } => format!("choose({a}, {b}, {c})"),
        Node::Constant(_) | Node::Signal(_) | Node::Extend(_) => a.to_string(),
    }
}
