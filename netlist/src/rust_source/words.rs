//! Expressions as Rust on `u64` words: three-address code, each value computed once.

use std::collections::BTreeMap;

use crate::drivers::Drivers;
use crate::{Expression, Netlist, Node, SignalId, mask};

/// Straight-line code in the making.
pub(super) struct Words<'a> {
    netlist: &'a Netlist,
    drivers: Drivers<'a>,
    /// Words that hold signals.
    signals: BTreeMap<SignalId, String>,
    /// Names of values computed already, by what computes them.
    known: BTreeMap<String, String>,
    /// Statements so far.
    pub(super) lines: Vec<String>,
}

impl<'a> Words<'a> {
    pub(super) fn new(netlist: &'a Netlist) -> Self {
        Self {
            netlist,
            drivers: Drivers::new(netlist),
            signals: BTreeMap::new(),
            known: BTreeMap::new(),
            lines: Vec::new(),
        }
    }

    /// Says where the value of a signal is found; it is read there once.
    pub(super) fn place(&mut self, signal: SignalId, place: &str) {
        let word = self.word(place.to_owned());
        self.signals.insert(signal, word);
    }

    /// The word with the value of a signal: placed, or computed from what is.
    pub(super) fn signal(&mut self, signal: SignalId) -> String {
        if let Some(word) = self.signals.get(&signal) {
            return word.clone();
        }
        let word = match self.drivers.logic(signal) {
            Some(expression) => self.value(expression),
            None => "0_u64".to_owned(),
        };
        self.signals.insert(signal, word.clone());
        word
    }

    /// Computes the targets of assignments, given in evaluation order.
    pub(super) fn body(&mut self, assignments: &[usize]) {
        for index in assignments {
            let target = self.netlist.assignments[*index].target;
            self.signal(target);
        }
    }

    /// The word with the value of an expression.
    pub(super) fn value(&mut self, expression: &Expression) -> String {
        match &expression.node {
            Node::Constant(value) => return format!("{value:#x}_u64"),
            Node::Signal(id) => return self.signal(*id),
            Node::Extend(a) => return self.value(a),
            _ => {}
        }
        let operands = expression.operands();
        let words: Vec<String> = operands.iter().map(|operand| self.value(operand)).collect();
        let computed = computed(expression, &words, operands[0].width);
        self.word(computed)
    }

    /// A word holding what is computed, new unless the same has been computed before.
    fn word(&mut self, computed: String) -> String {
        if let Some(word) = self.known.get(&computed) {
            return word.clone();
        }
        let word = format!("w{}", self.known.len());
        self.lines.push(format!("let {word} = {computed};"));
        self.known.insert(computed, word.clone());
        word
    }
}

/// Rust for one operator; `width` is that of its first operand.
fn computed(expression: &Expression, words: &[String], width: u32) -> String {
    let kept = mask(expression.width);
    let [a, b, c] = [0, 1, 2].map(|index| words.get(index).map_or("", String::as_str));
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
        Node::Constant(_) | Node::Signal(_) | Node::Extend(_) => a.to_owned(),
    }
}
