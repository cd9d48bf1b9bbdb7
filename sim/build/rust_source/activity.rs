//! When a register may take another value, read off the choices its next value is made of.
//!
//! `if clear { 0 } else if count { q + 1 } else { q }` may change under `clear` or `count`, and
//! stays as it is under neither: what computes its next value can be passed over then.

use std::collections::{BTreeMap, BTreeSet};

use super::words::{Gate, Operand, Words, number};
use helixlock_netlist::drivers::Drivers;
use helixlock_netlist::{Expression, Netlist, Node, SignalId, mask};

/// Beyond so many terms a condition is taken as it is.
const MOST_TERMS: usize = 64;

/// Bits one of which is set whenever the register may change: none for a register that never does;
/// `None` when that is not to be seen.
pub(super) fn conditions(
    words: &mut Words,
    logic: &mut Logic,
    netlist: &Netlist,
    register: usize,
) -> Option<Vec<Operand>> {
    let drivers = Drivers::new(netlist);
    let own = netlist.registers[register].output;
    let holds = |value: &Expression| is_own(&drivers, own, value);
    unless(words, logic, netlist, register, holds)
}

/// The step that a register takes at every clock but those at which one of some bits is set.
pub(super) fn step(
    words: &mut Words,
    logic: &mut Logic,
    netlist: &Netlist,
    register: usize,
) -> Option<(u64, Vec<Operand>)> {
    let drivers = Drivers::new(netlist);
    let own = netlist.registers[register].output;
    let mut steps = BTreeSet::new();
    add_steps(&drivers, own, &next(netlist, register), &mut steps);
    let step = steps.pop_first().filter(|_| steps.is_empty())?;
    let takes = |value: &Expression| step_of(&drivers, own, value) == Some(step);
    Some((step, unless(words, logic, netlist, register, takes)?))
}

/// Bits one of which is set whenever a register's next value is not of that kind.
fn unless(
    words: &mut Words,
    logic: &mut Logic,
    netlist: &Netlist,
    register: usize,
    is: impl Fn(&Expression) -> bool,
) -> Option<Vec<Operand>> {
    let drivers = Drivers::new(netlist);
    let mut found = changes(words, &drivers, &next(netlist, register), &is)?;
    found.retain(|condition| *condition != Operand::Constant(0));
    (!found.contains(&Operand::Constant(1))).then(|| logic.reduced(words, found))
}

fn next(netlist: &Netlist, register: usize) -> Expression {
    let register = netlist.registers[register];
    Expression::signal(netlist.signal(register.output).width, register.input)
}

/// True for a register as it is, under any name.
fn is_own(drivers: &Drivers, own: SignalId, value: &Expression) -> bool {
    matches!(value.node, Node::Signal(id) if drivers.origin(id) == own)
}

/// What is added, modulo its range, to a register.
fn step_of(drivers: &Drivers, own: SignalId, value: &Expression) -> Option<u64> {
    let constant = |value: &Expression| match value.node {
        Node::Constant(value) => Some(value),
        _ => None,
    };
    match &value.node {
        Node::Add(a, b) if is_own(drivers, own, a) => constant(b),
        Node::Add(a, b) if is_own(drivers, own, b) => constant(a),
        Node::Subtract(a, b) if is_own(drivers, own, a) => {
            Some(constant(b)?.wrapping_neg() & mask(value.width))
        }
        _ => None,
    }
}

/// All steps among which a value chooses.
fn add_steps(drivers: &Drivers, own: SignalId, value: &Expression, steps: &mut BTreeSet<u64>) {
    match &value.node {
        Node::Signal(id) if drivers.origin(*id) != own => {
            if let Some(logic) = drivers.logic(*id) {
                add_steps(drivers, own, logic, steps);
            }
        }
        Node::Select { then, otherwise, .. } => {
            add_steps(drivers, own, then, steps);
            add_steps(drivers, own, otherwise, steps);
        }
        _ => steps.extend(step_of(drivers, own, value)),
    }
}

/// Conditions under which `value` may be of another kind than it `is`.
fn changes(
    words: &mut Words,
    drivers: &Drivers,
    value: &Expression,
    is: &impl Fn(&Expression) -> bool,
) -> Option<Vec<Operand>> {
    match &value.node {
        _ if is(value) => Some(vec![]),
        Node::Signal(id) => changes(words, drivers, drivers.logic(*id)?, is),
        Node::Select { condition, then, otherwise } => {
            let then = changes(words, drivers, then, is);
            let otherwise = changes(words, drivers, otherwise, is);
            let when = words.value(condition);
            let unless = words.not(when);
            match (then, otherwise) {
                (None, None) => None,
                (None, Some(others)) => Some([vec![when], others].concat()),
                (Some(others), None) => Some([vec![unless], others].concat()),
                (Some(then), Some(otherwise)) => {
                    let then = then.into_iter().map(|bit| (when, bit));
                    let both = then.chain(otherwise.into_iter().map(|bit| (unless, bit)));
                    Some(both.map(|(a, b)| words.and(a, b)).collect())
                }
            }
        }
        _ => None,
    }
}

/// Words that are set, or clear, all together.
type Term = BTreeSet<(usize, bool)>;

/// What follows from what, as far as it shows in terms of one-bit gates.
#[derive(Default)]
pub(super) struct Logic {
    /// Terms one of which holds when a word is set, or clear.
    known: BTreeMap<(usize, bool), Vec<Term>>,
}

impl Logic {
    /// True only if one of `others` is set whenever one of `conditions` is; false may mean "not
    /// seen".
    pub(super) fn implies(
        &mut self,
        words: &Words,
        conditions: &[Operand],
        others: &[Operand],
    ) -> bool {
        let covering = self.terms_of_any(words, others);
        let covered = |term: &Term| covering.iter().any(|other| other.is_subset(term));
        self.terms_of_any(words, conditions).iter().all(covered)
    }

    /// The same without what the other conditions say already.
    fn reduced(&mut self, words: &Words, mut conditions: Vec<Operand>) -> Vec<Operand> {
        let mut index = 0;
        while index < conditions.len() {
            let condition = conditions.remove(index);
            match self.remaining(words, condition, &conditions) {
                None => index = 0,
                Some(part) => {
                    conditions.insert(index, part);
                    index = if part == condition { index + 1 } else { 0 };
                }
            }
        }
        conditions.sort_unstable();
        conditions
    }

    /// What a condition adds to others.
    fn remaining(
        &mut self,
        words: &Words,
        condition: Operand,
        others: &[Operand],
    ) -> Option<Operand> {
        if self.implies(words, &[condition], others) {
            return None;
        }
        match number(condition).and_then(|index| words.all()[index].gate) {
            Some(Gate::Or(a, b)) if self.implies(words, &[a], others) => Some(b),
            Some(Gate::Or(a, b)) if self.implies(words, &[b], others) => Some(a),
            _ => Some(condition),
        }
    }

    fn terms_of_any(&mut self, words: &Words, conditions: &[Operand]) -> Vec<Term> {
        conditions.iter().flat_map(|condition| self.terms(words, *condition, true)).collect()
    }

    /// The terms one of which holds when the bit is `set`.
    fn terms(&mut self, words: &Words, bit: Operand, set: bool) -> Vec<Term> {
        let index = match bit {
            Operand::Constant(value) if (value != 0) == set => return vec![Term::new()],
            Operand::Constant(_) => return vec![],
            Operand::Word(index) => index,
        };
        if let Some(terms) = self.known.get(&(index, set)) {
            return terms.clone();
        }
        let mut terms = match words.all()[index].gate {
            None => vec![Term::from([(index, set)])],
            Some(Gate::Not(a)) => self.terms(words, a, !set),
            Some(Gate::And(a, b)) => self.pair(words, [a, b], set, set),
            Some(Gate::Or(a, b)) => self.pair(words, [a, b], set, !set),
        };
        drop_covered(&mut terms);
        if MOST_TERMS < terms.len() {
            terms = vec![Term::from([(index, set)])];
        }
        self.known.insert((index, set), terms.clone());
        terms
    }

    /// Terms of two bits, of which `both` or either must be as `set` says.
    fn pair(&mut self, words: &Words, bits: [Operand; 2], set: bool, both: bool) -> Vec<Term> {
        let [left, right] = bits.map(|bit| self.terms(words, bit, set));
        if !both {
            return [left, right].concat();
        }
        let pairs = left.iter().flat_map(|a| right.iter().map(move |b| a | b));
        let possible = |term: &Term| term.iter().all(|(word, set)| !term.contains(&(*word, !set)));
        pairs.filter(possible).collect()
    }
}

/// Drops terms that hold only where another one does.
fn drop_covered(terms: &mut Vec<Term>) {
    let mut index = 0;
    while index < terms.len() {
        let term = terms.remove(index);
        if !terms.iter().any(|other| other.is_subset(&term)) {
            terms.insert(index, term);
            index += 1;
        }
    }
}
