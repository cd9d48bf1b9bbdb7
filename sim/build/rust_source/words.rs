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
    /// Number of bits it may have.
    pub(super) width: u32,
    /// The operator that computes it, on words, which it calls signals; none when it is read from
    /// somewhere.
    rule: Option<Expression>,
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
        let width = self.netlist.signal(signal).width;
        let word = self.word(place.to_owned(), width, None);
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
        let leaves = words.iter().zip(&operands).map(|(word, of)| leaf(*word, of.width));
        let node = with_operands(&expression.node, leaves.map(Box::new));
        self.word(text, expression.width, Some(Expression { width: expression.width, node }))
    }

    /// Complement of one bit.
    pub(super) fn not(&mut self, a: Operand) -> Operand {
        match a {
            Operand::Constant(bit) => Operand::Constant(bit ^ 1),
            Operand::Word(_) => self.gate(format!("{a} ^ 0x1"), Node::Not(leaf(a, 1).into())),
        }
    }

    /// Both bits.
    pub(super) fn and(&mut self, a: Operand, b: Operand) -> Operand {
        match (a, b) {
            (Operand::Constant(0), _) | (_, Operand::Constant(0)) => Operand::Constant(0),
            (Operand::Constant(_), other) | (other, Operand::Constant(_)) => other,
            _ => self.gate(format!("{a} & {b}"), Node::And(leaf(a, 1).into(), leaf(b, 1).into())),
        }
    }

    /// Either bit.
    pub(super) fn or(&mut self, a: Operand, b: Operand) -> Operand {
        match (a, b) {
            (Operand::Constant(0), other) | (other, Operand::Constant(0)) => other,
            (Operand::Constant(_), _) | (_, Operand::Constant(_)) => Operand::Constant(1),
            _ => self.gate(format!("{a} | {b}"), Node::Or(leaf(a, 1).into(), leaf(b, 1).into())),
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

    /// The operator that computes a word, on words, which it calls signals.
    pub(super) fn rule(&self, index: usize) -> &Expression {
        let rule = self.computed[index].rule.as_ref();
        rule.expect("only a word that is computed has a rule")
    }

    /// What a word is when all that it is computed from have the given values, one a word.
    pub(super) fn evaluate(&self, index: usize, values: &[u64]) -> u64 {
        self.rule(index).evaluate(values)
    }

    fn gate(&mut self, text: String, node: Node) -> Operand {
        self.word(text, 1, Some(Expression { width: 1, node }))
    }

    /// A word holding what is computed, new unless the same has been computed before.
    fn word(&mut self, text: String, width: u32, rule: Option<Expression>) -> Operand {
        let next = self.computed.len();
        let index = *self.known.entry(text.clone()).or_insert(next);
        if index == next {
            let mut operands = vec![];
            if let Some(rule) = &rule {
                rule.for_each_signal(&mut |word| operands.push(word.0 as usize));
            }
            let gate = rule.as_ref().and_then(gate);
            self.computed.push(Word { text, width, rule, operands, gate });
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

fn gate(rule: &Expression) -> Option<Gate> {
    match &rule.node {
        _ if rule.width != 1 => None,
        Node::Not(a) => Some(Gate::Not(operand(a))),
        Node::And(a, b) => Some(Gate::And(operand(a), operand(b))),
        Node::Or(a, b) => Some(Gate::Or(operand(a), operand(b))),
        _ => None,
    }
}

/// A word or a constant as the operand of a rule.
fn leaf(operand: Operand, width: u32) -> Expression {
    match operand {
        Operand::Constant(value) => Expression::constant(width, value),
        Operand::Word(index) => {
            let word = u32::try_from(index).expect("a design has few words");
            Expression::signal(width, SignalId(word))
        }
    }
}

/// What [`leaf`] made an operand of a rule of.
fn operand(leaf: &Expression) -> Operand {
    match leaf.node {
        Node::Signal(word) => Operand::Word(word.0 as usize),
        Node::Constant(value) => Operand::Constant(value),
        _ => unreachable!("the operands of a rule are words and constants"),
    }
}

/// An operator on other operands.
fn with_operands(node: &Node, mut operands: impl Iterator<Item = Box<Expression>>) -> Node {
    let mut next = || operands.next().expect("as many operands as before");
    match node {
        Node::Constant(_) | Node::Signal(_) => node.clone(),
        Node::Not(_) => Node::Not(next()),
        Node::And(..) => Node::And(next(), next()),
        Node::Or(..) => Node::Or(next(), next()),
        Node::Xor(..) => Node::Xor(next(), next()),
        Node::Add(..) => Node::Add(next(), next()),
        Node::Subtract(..) => Node::Subtract(next(), next()),
        Node::ShiftUp(..) => Node::ShiftUp(next(), next()),
        Node::ShiftDown(..) => Node::ShiftDown(next(), next()),
        Node::Equal(..) => Node::Equal(next(), next()),
        Node::Less(..) => Node::Less(next(), next()),
        Node::LessOrEqual(..) => Node::LessOrEqual(next(), next()),
        Node::All(_) => Node::All(next()),
        Node::Any(_) => Node::Any(next()),
        Node::Parity(_) => Node::Parity(next()),
        Node::Slice { low, .. } => Node::Slice { of: next(), low: *low },
        Node::Extend(_) => Node::Extend(next()),
        Node::Select { .. } => Node::Select { condition: next(), then: next(), otherwise: next() },
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
