//! Counters as digits, each of which changes only when those below it carry, or the counter is loaded.
//!
//! In binary as in decades: the rules for blocks find the digits above inside those below.

use std::collections::{BTreeMap, BTreeSet};

use helixlock_netlist::settle::{Counter, counters};
use helixlock_netlist::{Assignment, Expression, Netlist, Node, Register, Signal, SignalId, mask};

/// Bits of a digit: the one above it is looked after at every sixteenth clock.
const DIGIT: u32 = 4;

/// A design with counters cut into digits; all its bits stand in the order of the original.
pub(super) struct Digits {
    pub(super) netlist: Netlist,
    /// Next values of the digits, by register, as they are without the condition.
    pub(super) next: BTreeMap<usize, Expression>,
}

impl Digits {
    /// Cuts every counter that counts by one, up or down.
    pub(super) fn new(netlist: &Netlist) -> Self {
        let counters = counters(netlist, DIGIT + 1);
        let mut this = Self { netlist: netlist.clone(), next: BTreeMap::new() };
        this.netlist.registers.clear();
        for (index, register) in netlist.registers.iter().enumerate() {
            let counter = counters.iter().find(|counter| counter.register == index);
            let width = netlist.signal(register.output).width;
            match counter.and_then(|counter| Some((counter, last_digit(counter, width)?))) {
                Some((counter, last)) => this.cut(*register, counter, last),
                None => this.netlist.registers.push(*register),
            }
        }
        this
    }

    /// `last` has, at each place, what a bit is before it carries.
    fn cut(&mut self, register: Register, counter: &Counter, last: u64) {
        let width = self.netlist.signal(register.output).width;
        let loaded = self.assign(one_bit(Node::Not(Box::new(counter.counting.clone()))));
        // The lowest digit moves at every clock.
        let mut carried = None;
        let mut whole = Expression::constant(width, 0);
        for low in (0..width).step_by(DIGIT as usize) {
            let digit = DIGIT.min(width - low);
            let own = self.signal(digit);
            let held = Expression::signal(digit, own);
            let of = Box::new(Expression::signal(width, register.input));
            let mut next = Expression { width: digit, node: Node::Slice { of, low } };
            if let Some(carried) = &carried {
                self.next.insert(self.netlist.registers.len(), next.clone());
                next = select(either(carried, &loaded), next, held.clone());
            }
            let input = self.signal(digit);
            self.netlist.assignments.push(Assignment { target: input, value: next });
            let initial = register.initial >> low & mask(digit);
            self.netlist.registers.push(Register { output: own, input, initial });
            let end = Box::new(Expression::constant(digit, last & mask(digit)));
            let ends = one_bit(Node::Equal(Box::new(held.clone()), end));
            let all_end = match carried {
                Some(below) => one_bit(Node::And(Box::new(below), Box::new(ends))),
                None => ends,
            };
            carried = Some(self.assign(all_end));
            whole = joined(whole, held, low);
        }
        // Who reads it comes later.
        self.netlist.assignments.insert(0, Assignment { target: register.output, value: whole });
    }

    /// A new signal with a value.
    fn assign(&mut self, value: Expression) -> Expression {
        let target = self.signal(value.width);
        let width = value.width;
        self.netlist.assignments.push(Assignment { target, value });
        Expression::signal(width, target)
    }

    fn signal(&mut self, width: u32) -> SignalId {
        let index = self.netlist.signals.len();
        self.netlist.signals.push(Signal { path: format!("digit{index}"), width });
        SignalId(u32::try_from(index).expect("a design has few signals"))
    }
}

/// What a digit of a counter by one is before it carries, or borrows.
fn last_digit(counter: &Counter, width: u32) -> Option<u64> {
    let mut steps = BTreeSet::new();
    add_steps(&counter.step, &mut steps)?;
    steps.remove(&0);
    let step = steps.pop_first().filter(|_| steps.is_empty())?;
    if step == mask(width) { Some(0) } else { (step == 1).then_some(u64::MAX) }
}

/// Constants among which a step chooses, if that is all it is.
fn add_steps(step: &Expression, steps: &mut BTreeSet<u64>) -> Option<()> {
    match &step.node {
        Node::Constant(step) => {
            steps.insert(*step);
            Some(())
        }
        Node::Select { then, otherwise, .. } => {
            add_steps(then, steps)?;
            add_steps(otherwise, steps)
        }
        _ => None,
    }
}

fn one_bit(node: Node) -> Expression {
    Expression { width: 1, node }
}

fn either(a: &Expression, b: &Expression) -> Expression {
    one_bit(Node::Or(Box::new(a.clone()), Box::new(b.clone())))
}

fn select(condition: Expression, then: Expression, otherwise: Expression) -> Expression {
    let width = then.width;
    let [condition, then, otherwise] = [condition, then, otherwise].map(Box::new);
    Expression { width, node: Node::Select { condition, then, otherwise } }
}

/// `whole` with a digit at its place.
fn joined(whole: Expression, digit: Expression, low: u32) -> Expression {
    let width = whole.width;
    let digit = Box::new(Expression { width, node: Node::Extend(Box::new(digit)) });
    let places = Box::new(Expression::constant(width, u64::from(low)));
    let digit = Expression { width, node: Node::ShiftUp(digit, places) };
    Expression { width, node: Node::Or(Box::new(whole), Box::new(digit)) }
}
