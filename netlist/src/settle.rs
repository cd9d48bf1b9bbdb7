//! Which registers count: move by the same step at every clock, and are seen only by comparisons.
//!
//! Between two events most registers of a design rest: their next value is their present one. A
//! counter does not, yet it need not be stepped either. As long as every comparison it takes part in
//! keeps its answer and everything else rests, the counter takes the same step again, so its value
//! at any later clock is known, and nobody can tell that the clocks between were not taken.
//!
//! A register `c` of width w is such a [`Counter`] when
//!
//! - it is compared (`=`, `<`, `≤`, all, any) with values that do not depend on it, and those
//!   answers are all that other registers see of it;
//! - its own next value is chosen, by conditions of that kind, among `c + step` modulo 2^w
//!   (`step` = 0 is rest) and loads of values that do not depend on `c`.
//!
//! What is compared with `c` splits its range into stretches: below the threshold, at it, above
//! it. No answer changes before `c` leaves its stretch, which [`clocks_within`] counts.

use crate::drivers::{Driver, Drivers};
use crate::{Expression, Netlist, Node, SignalId, mask};

/// A register whose future is known as long as its comparisons keep their answers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Counter {
    /// Index in [`Netlist::registers`].
    pub register: usize,
    /// One bit: the next value is the present one plus `step`; otherwise it is loaded.
    pub counting: Expression,
    /// What is added modulo 2^width while counting; does not depend on the counter but through
    /// comparisons.
    pub step: Expression,
    /// What it is compared with; may be wider than the counter.
    pub thresholds: Vec<Expression>,
    /// Signals that show more of it than comparisons do; no other register depends on them.
    pub shown: Vec<SignalId>,
}

/// The counters among the registers of at least `narrowest` bits, in order.
///
/// A counter of w bits rests from events for at most 2^w clocks: narrow ones are not worth it.
/// Outputs of the design may show a counter as it is: they are looked at, not acted upon.
#[must_use]
pub fn counters(netlist: &Netlist, narrowest: u32) -> Vec<Counter> {
    let drivers = Drivers::new(netlist);
    let wide =
        |register: usize| narrowest <= netlist.signal(netlist.registers[register].output).width;
    (0..netlist.registers.len())
        .filter(|register| wide(*register))
        .filter_map(|register| Candidate::new(&drivers, netlist, register).counter())
        .collect()
}

/// Clocks until a counter at `value` that moves by `step` leaves its stretch, at least 1.
///
/// Stretches are [0, threshold), the threshold itself, and those above up to 2^`width`; running
/// over either end of the range leaves too. A step above half of 2^`width` counts downwards.
/// A counter at rest never leaves: `u64::MAX`.
#[inline]
#[must_use]
pub fn clocks_within(value: u64, step: u64, threshold: u64, width: u32) -> u64 {
    let top = mask(width);
    if step == 0 {
        return u64::MAX;
    }
    if step <= top / 2 {
        // The last value of the stretch, so that a boundary at 2^64 needs no 65th bit.
        let last = if value < threshold { (threshold - 1).min(top) } else { top };
        let last = if value == threshold { value } else { last };
        ((last - value) / step).saturating_add(1)
    } else {
        let first = if threshold < value { threshold + 1 } else { 0 };
        let first = if value == threshold { value } else { first };
        let down = step.wrapping_neg() & top;
        ((value - first) / down).saturating_add(1)
    }
}

/// A register looked at as a counter.
struct Candidate<'a> {
    drivers: &'a Drivers<'a>,
    netlist: &'a Netlist,
    register: usize,
    /// Signals that show more of the register than comparisons do.
    shown: Vec<bool>,
    thresholds: Vec<Expression>,
}

/// Next value of a counter: `counting` chooses between a step and a load.
struct Motion {
    counting: Expression,
    step: Expression,
}

impl<'a> Candidate<'a> {
    fn new(drivers: &'a Drivers<'a>, netlist: &'a Netlist, register: usize) -> Self {
        let shown = vec![false; netlist.signals.len()];
        let mut candidate = Self { drivers, netlist, register, shown, thresholds: Vec::new() };
        let output = candidate.output();
        candidate.shown[output.0 as usize] = true;
        for assignment in &netlist.assignments {
            let shown = candidate.shows(&assignment.value);
            candidate.shown[assignment.target.0 as usize] = shown;
        }
        candidate
    }

    fn counter(self) -> Option<Counter> {
        let seen_by_others = self
            .netlist
            .registers
            .iter()
            .enumerate()
            .any(|(index, other)| index != self.register && self.shown[other.input.0 as usize]);
        if seen_by_others || !self.shown[self.input().0 as usize] {
            return None;
        }
        let motion = self.motion(&read(self.input(), self.width()))?;
        // A register that only ever holds or loads rests by itself.
        if matches!(motion.step.node, Node::Constant(0)) {
            return None;
        }
        let Motion { counting, step } = motion;
        let shown = (0..).zip(&self.shown).filter(|(_, shown)| **shown);
        let shown = shown.map(|(index, _)| SignalId(index)).collect();
        let Self { register, thresholds, .. } = self;
        Some(Counter { register, counting, step, thresholds, shown })
    }

    fn output(&self) -> SignalId {
        self.netlist.registers[self.register].output
    }

    fn input(&self) -> SignalId {
        self.netlist.registers[self.register].input
    }

    fn width(&self) -> u32 {
        self.netlist.signal(self.output()).width
    }

    /// True when the value tells more of the register than comparisons do; notes what it is
    /// compared with on the way.
    fn shows(&mut self, value: &Expression) -> bool {
        if let Node::Signal(id) = value.node {
            return self.shown[id.0 as usize];
        }
        // Each is asked, so that every threshold is noted.
        let shown: Vec<bool> =
            value.operands().into_iter().map(|operand| self.shows(operand)).collect();
        if !shown.contains(&true) {
            return false;
        }
        match self.threshold(value) {
            Some(threshold) => {
                if !self.thresholds.contains(&threshold) {
                    self.thresholds.push(threshold);
                }
                false
            }
            None => true,
        }
    }

    /// What the register is compared with, when `value` is such a comparison.
    fn threshold(&self, value: &Expression) -> Option<Expression> {
        match &value.node {
            Node::Equal(a, b) | Node::Less(a, b) | Node::LessOrEqual(a, b) => {
                if self.is_register(a) && self.hides(b) {
                    Some((**b).clone())
                } else if self.is_register(b) && self.hides(a) {
                    Some((**a).clone())
                } else {
                    None
                }
            }
            Node::All(a) => self.is_register(a).then(|| constant(mask(self.width()), self.width())),
            Node::Any(a) => self.is_register(a).then(|| constant(0, self.width())),
            _ => None,
        }
    }

    /// True for the register itself, under any name and with zeros above it.
    fn is_register(&self, value: &Expression) -> bool {
        match &value.node {
            Node::Signal(id) => self.drivers.origin(*id) == self.output(),
            Node::Extend(a) => self.is_register(a),
            _ => false,
        }
    }

    /// How the register moves when `value` is its next one.
    fn motion(&self, value: &Expression) -> Option<Motion> {
        let width = self.width();
        if let Node::Select { condition, then, otherwise } = &value.node
            && self.hides(condition)
        {
            let (then, otherwise) = (self.motion(then)?, self.motion(otherwise)?);
            return Some(Motion {
                counting: select(condition, then.counting, otherwise.counting),
                step: select(condition, then.step, otherwise.step),
            });
        }
        if let Node::Signal(id) = value.node
            && id != self.output()
            && self.shown[id.0 as usize]
            && let Driver::Assignment(index) = self.drivers.of(id)
        {
            return self.motion(&self.netlist.assignments[index].value);
        }
        match self.step(value) {
            Some(step) => Some(Motion { counting: constant(1, 1), step }),
            None if self.hides(value) => {
                Some(Motion { counting: constant(0, 1), step: constant(0, width) })
            }
            None => None,
        }
    }

    /// True when the value shows nothing of the register; comparisons of it may stand inside.
    fn hides(&self, value: &Expression) -> bool {
        if let Node::Signal(id) = value.node {
            return !self.shown[id.0 as usize];
        }
        value.operands().into_iter().all(|operand| self.hides(operand))
            || self.threshold(value).is_some()
    }

    /// What `value` adds to the register, modulo 2^width, when it is the register plus something.
    fn step(&self, value: &Expression) -> Option<Expression> {
        let width = self.width();
        match &value.node {
            Node::Signal(id) if *id == self.output() => Some(constant(0, width)),
            Node::Signal(id) if self.shown[id.0 as usize] => self.step(self.drivers.logic(*id)?),
            Node::Extend(a) if width <= a.width => self.step(a),
            Node::Slice { of, low: 0 } if width <= value.width => self.step(of),
            Node::Add(a, b) if self.hides(b) => Some(add(self.step(a)?, fit(b, width))),
            Node::Add(a, b) if self.hides(a) => Some(add(self.step(b)?, fit(a, width))),
            Node::Subtract(a, b) if self.hides(b) => Some(subtract(self.step(a)?, fit(b, width))),
            _ => None,
        }
    }
}

fn constant(value: u64, width: u32) -> Expression {
    Expression { width, node: Node::Constant(value) }
}

fn read(signal: SignalId, width: u32) -> Expression {
    Expression { width, node: Node::Signal(signal) }
}

fn select(condition: &Expression, then: Expression, otherwise: Expression) -> Expression {
    if then == otherwise {
        return then;
    }
    let width = then.width;
    let condition = Box::new(condition.clone());
    Expression {
        width,
        node: Node::Select { condition, then: Box::new(then), otherwise: Box::new(otherwise) },
    }
}

fn add(a: Expression, b: Expression) -> Expression {
    match (&a.node, &b.node) {
        (Node::Constant(x), Node::Constant(y)) => {
            constant(x.wrapping_add(*y) & mask(a.width), a.width)
        }
        (Node::Constant(0), _) => b,
        _ => Expression { width: a.width, node: Node::Add(Box::new(a), Box::new(b)) },
    }
}

fn subtract(a: Expression, b: Expression) -> Expression {
    match (&a.node, &b.node) {
        (Node::Constant(x), Node::Constant(y)) => {
            constant(x.wrapping_sub(*y) & mask(a.width), a.width)
        }
        _ => Expression { width: a.width, node: Node::Subtract(Box::new(a), Box::new(b)) },
    }
}

/// The low `width` bits of a value that is at least as wide.
fn fit(value: &Expression, width: u32) -> Expression {
    match &value.node {
        Node::Constant(bits) => constant(bits & mask(width), width),
        _ if value.width == width => value.clone(),
        _ => Expression { width, node: Node::Slice { of: Box::new(value.clone()), low: 0 } },
    }
}
