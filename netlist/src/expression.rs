//! Building expressions: every width explicit, and one spelling for one meaning.
//!
//! The builders narrow what they can (a truncated sum adds narrow operands, a comparison with
//! zeros on both sides drops them), so that two expressions of the same meaning that differ only
//! in the widths of their intermediate values come out equal.

use crate::{Expression, Node, SignalId, mask};

type TwoOperands = fn(Box<Expression>, Box<Expression>) -> Node;

impl Expression {
    /// The constant `value`, cut to `width` bits.
    #[must_use]
    pub const fn constant(width: u32, value: u64) -> Self {
        Self { width, node: Node::Constant(value & mask(width)) }
    }

    /// A signal of that width.
    #[must_use]
    pub const fn signal(width: u32, signal: SignalId) -> Self {
        Self { width, node: Node::Signal(signal) }
    }

    /// Its value, when it is a constant.
    #[must_use]
    pub const fn as_constant(&self) -> Option<u64> {
        match self.node {
            Node::Constant(value) => Some(value),
            _ => None,
        }
    }

    /// Calls `visit` with every signal read, in order, repeats included.
    pub fn for_each_signal(&self, visit: &mut impl FnMut(SignalId)) {
        if let Node::Signal(signal) = self.node {
            visit(signal);
        }
        for operand in self.operands() {
            operand.for_each_signal(visit);
        }
    }

    /// The expressions it is made of, left to right.
    #[must_use]
    pub fn operands(&self) -> Vec<&Self> {
        match &self.node {
            Node::Constant(_) | Node::Signal(_) => vec![],
            Node::Not(a) | Node::All(a) | Node::Any(a) | Node::Parity(a) | Node::Extend(a) => {
                vec![a]
            }
            Node::Slice { of, .. } => vec![of],
            Node::And(a, b)
            | Node::Or(a, b)
            | Node::Xor(a, b)
            | Node::Add(a, b)
            | Node::Subtract(a, b)
            | Node::ShiftUp(a, b)
            | Node::ShiftDown(a, b)
            | Node::Equal(a, b)
            | Node::Less(a, b)
            | Node::LessOrEqual(a, b) => vec![a, b],
            Node::Select { condition, then, otherwise } => vec![condition, then, otherwise],
        }
    }

    /// The same with every signal replaced, simplified anew.
    ///
    /// # Errors
    ///
    /// The first one of `replace`.
    pub fn substitute<E>(
        &self,
        replace: &mut impl FnMut(SignalId) -> Result<Self, E>,
    ) -> Result<Self, E> {
        Ok(match &self.node {
            Node::Constant(_) => self.clone(),
            Node::Signal(signal) => replace(*signal)?,
            Node::Not(a) => not(a.substitute(replace)?),
            Node::All(a) => all(a.substitute(replace)?),
            Node::Any(a) => any(a.substitute(replace)?),
            Node::Parity(a) => parity(a.substitute(replace)?),
            Node::Extend(a) => resize(a.substitute(replace)?, self.width),
            Node::Slice { of, low } => slice(of.substitute(replace)?, *low, self.width),
            Node::And(a, b) => and(a.substitute(replace)?, b.substitute(replace)?),
            Node::Or(a, b) => or(a.substitute(replace)?, b.substitute(replace)?),
            Node::Xor(a, b) => xor(a.substitute(replace)?, b.substitute(replace)?),
            Node::Add(a, b) => add(a.substitute(replace)?, b.substitute(replace)?),
            Node::Subtract(a, b) => subtract(a.substitute(replace)?, b.substitute(replace)?),
            Node::ShiftUp(a, b) => shift_up(a.substitute(replace)?, b.substitute(replace)?),
            Node::ShiftDown(a, b) => shift_down(a.substitute(replace)?, b.substitute(replace)?),
            Node::Equal(a, b) => equal(a.substitute(replace)?, b.substitute(replace)?),
            Node::Less(a, b) => less(a.substitute(replace)?, b.substitute(replace)?),
            Node::LessOrEqual(a, b) => {
                less_or_equal(a.substitute(replace)?, b.substitute(replace)?)
            }
            Node::Select { condition, then, otherwise } => select(
                condition.substitute(replace)?,
                then.substitute(replace)?,
                otherwise.substitute(replace)?,
            ),
        })
    }
}

/// Bits that can be set: all of a plain value, fewer of a constant or an extended one.
pub(crate) fn significant(e: &Expression) -> u32 {
    match &e.node {
        Node::Constant(value) => (64 - value.leading_zeros()).max(1),
        Node::Extend(inner) => inner.width,
        _ => e.width,
    }
}

pub(crate) fn not(e: Expression) -> Expression {
    match e.node {
        Node::Constant(value) => Expression::constant(e.width, !value),
        Node::Not(inner) => *inner,
        _ => Expression { width: e.width, node: Node::Not(Box::new(e)) },
    }
}

pub(crate) fn and(l: Expression, r: Expression) -> Expression {
    let width = significant(&l).min(significant(&r));
    if width < l.width {
        return narrowed(and, width, l, r);
    }
    match (l.as_constant(), r.as_constant()) {
        (Some(a), Some(b)) => Expression::constant(width, a & b),
        (Some(0), _) | (_, Some(0)) => Expression::constant(width, 0),
        (Some(ones), _) if ones == mask(width) => r,
        (_, Some(ones)) if ones == mask(width) => l,
        _ => plain(width, Node::And, l, r),
    }
}

pub(crate) fn or(l: Expression, r: Expression) -> Expression {
    let width = significant(&l).max(significant(&r));
    if width < l.width {
        return narrowed(or, width, l, r);
    }
    match (l.as_constant(), r.as_constant()) {
        (Some(a), Some(b)) => Expression::constant(width, a | b),
        (Some(0), _) => r,
        (_, Some(0)) => l,
        _ => plain(width, Node::Or, l, r),
    }
}

pub(crate) fn xor(l: Expression, r: Expression) -> Expression {
    let width = significant(&l).max(significant(&r));
    if width < l.width {
        return narrowed(xor, width, l, r);
    }
    match (l.as_constant(), r.as_constant()) {
        (Some(a), Some(b)) => Expression::constant(width, a ^ b),
        (Some(0), _) => r,
        (_, Some(0)) => l,
        _ => plain(width, Node::Xor, l, r),
    }
}

pub(crate) fn add(l: Expression, r: Expression) -> Expression {
    match (l.as_constant(), r.as_constant()) {
        (Some(a), Some(b)) => Expression::constant(l.width, a.wrapping_add(b)),
        (Some(0), _) => r,
        (_, Some(0)) => l,
        _ => plain(l.width, Node::Add, l, r),
    }
}

pub(crate) fn subtract(l: Expression, r: Expression) -> Expression {
    match (l.as_constant(), r.as_constant()) {
        (Some(a), Some(b)) => Expression::constant(l.width, a.wrapping_sub(b)),
        (_, Some(0)) => l,
        _ => plain(l.width, Node::Subtract, l, r),
    }
}

/// `l << r`; both equally wide.
pub(crate) fn shift_up(l: Expression, r: Expression) -> Expression {
    match (l.as_constant(), r.as_constant()) {
        (_, Some(0)) => l,
        (_, Some(by)) if by >= u64::from(l.width) => Expression::constant(l.width, 0),
        (Some(value), Some(by)) => Expression::constant(l.width, value << by),
        _ => plain(l.width, Node::ShiftUp, l, r),
    }
}

/// `l >> r`; both equally wide.
pub(crate) fn shift_down(l: Expression, r: Expression) -> Expression {
    let width = l.width;
    match (l.node, r.as_constant()) {
        (_, Some(by)) if by >= u64::from(width) => Expression::constant(width, 0),
        (node, Some(by)) => {
            let by = u32::try_from(by).unwrap_or(width);
            resize(slice(Expression { width, node }, by, width - by), width)
        }
        (Node::Extend(inner), None) if significant(&r) <= inner.width => {
            let r = resize(r, inner.width);
            resize(shift_down(*inner, r), width)
        }
        (node, None) => plain(width, Node::ShiftDown, Expression { width, node }, r),
    }
}

pub(crate) fn equal(l: Expression, r: Expression) -> Expression {
    let (l, r) = shrunk(l, r);
    match (l.width, l.as_constant(), r.as_constant()) {
        (_, Some(a), Some(b)) => Expression::constant(1, u64::from(a == b)),
        (1, None, Some(1)) => l,
        (1, None, Some(_)) => not(l),
        (1, Some(1), None) => r,
        (1, Some(_), None) => not(r),
        _ => plain(1, Node::Equal, l, r),
    }
}

pub(crate) fn less(l: Expression, r: Expression) -> Expression {
    let (l, r) = shrunk(l, r);
    match (l.as_constant(), r.as_constant()) {
        (Some(a), Some(b)) => Expression::constant(1, u64::from(a < b)),
        _ => plain(1, Node::Less, l, r),
    }
}

pub(crate) fn less_or_equal(l: Expression, r: Expression) -> Expression {
    let (l, r) = shrunk(l, r);
    match (l.as_constant(), r.as_constant()) {
        (Some(a), Some(b)) => Expression::constant(1, u64::from(a <= b)),
        _ => plain(1, Node::LessOrEqual, l, r),
    }
}

pub(crate) fn all(e: Expression) -> Expression {
    match e.as_constant() {
        _ if e.width == 1 => e,
        Some(value) => Expression::constant(1, u64::from(value == mask(e.width))),
        None => Expression { width: 1, node: Node::All(Box::new(e)) },
    }
}

pub(crate) fn any(e: Expression) -> Expression {
    match e.as_constant() {
        _ if e.width == 1 => e,
        Some(value) => Expression::constant(1, u64::from(value != 0)),
        None => Expression { width: 1, node: Node::Any(Box::new(e)) },
    }
}

pub(crate) fn parity(e: Expression) -> Expression {
    match e.as_constant() {
        _ if e.width == 1 => e,
        Some(value) => Expression::constant(1, u64::from(value.count_ones() % 2 == 1)),
        None => Expression { width: 1, node: Node::Parity(Box::new(e)) },
    }
}

pub(crate) fn select(condition: Expression, then: Expression, otherwise: Expression) -> Expression {
    match condition.as_constant() {
        Some(0) => otherwise,
        Some(_) => then,
        None if then == otherwise => then,
        None => Expression {
            width: then.width,
            node: Node::Select {
                condition: Box::new(condition),
                then: Box::new(then),
                otherwise: Box::new(otherwise),
            },
        },
    }
}

/// The value at `width` bits: zeros above, or the low bits of it.
pub(crate) fn resize(e: Expression, width: u32) -> Expression {
    if width <= e.width {
        return slice(e, 0, width);
    }
    match e.node {
        Node::Constant(value) => Expression::constant(width, value),
        Node::Extend(inner) => Expression { width, node: Node::Extend(inner) },
        _ => Expression { width, node: Node::Extend(Box::new(e)) },
    }
}

/// `width` bits from bit `low` up; the bits must be there.
pub(crate) fn slice(e: Expression, low: u32, width: u32) -> Expression {
    if low == 0 && width == e.width {
        return e;
    }
    match e.node {
        Node::Constant(value) => Expression::constant(width, value >> low),
        Node::Slice { of, low: below } => {
            Expression { width, node: Node::Slice { of, low: below + low } }
        }
        Node::Extend(inner) if low >= inner.width => Expression::constant(width, 0),
        Node::Extend(inner) => {
            let available = width.min(inner.width - low);
            resize(slice(*inner, low, available), width)
        }
        Node::Select { condition, then, otherwise } => {
            select(*condition, slice(*then, low, width), slice(*otherwise, low, width))
        }
        Node::Not(a) => not(slice(*a, low, width)),
        Node::And(a, b) => and(slice(*a, low, width), slice(*b, low, width)),
        Node::Or(a, b) => or(slice(*a, low, width), slice(*b, low, width)),
        Node::Xor(a, b) => xor(slice(*a, low, width), slice(*b, low, width)),
        node if low == 0 => truncated(Expression { width: e.width, node }, width),
        node => cut(Expression { width: e.width, node }, low, width),
    }
}

/// Low bits of arithmetic, which need only the low bits of its operands.
fn truncated(e: Expression, width: u32) -> Expression {
    match e.node {
        Node::Add(a, b) => add(slice(*a, 0, width), slice(*b, 0, width)),
        Node::Subtract(a, b) => subtract(slice(*a, 0, width), slice(*b, 0, width)),
        Node::ShiftUp(_, by) if by.as_constant().is_some_and(|by| u64::from(width) <= by) => {
            Expression::constant(width, 0)
        }
        Node::ShiftUp(a, by) if significant(&by) <= width => {
            shift_up(slice(*a, 0, width), slice(*by, 0, width))
        }
        node => cut(Expression { width: e.width, node }, 0, width),
    }
}

fn cut(of: Expression, low: u32, width: u32) -> Expression {
    Expression { width, node: Node::Slice { of: Box::new(of), low } }
}

fn plain(width: u32, node: TwoOperands, l: Expression, r: Expression) -> Expression {
    Expression { width, node: node(Box::new(l), Box::new(r)) }
}

/// Works on the low `width` bits, then puts the zeros back.
fn narrowed(
    build: fn(Expression, Expression) -> Expression,
    width: u32,
    l: Expression,
    r: Expression,
) -> Expression {
    let full = l.width;
    resize(build(slice(l, 0, width), slice(r, 0, width)), full)
}

/// Drops the zeros that both sides of a comparison share.
fn shrunk(l: Expression, r: Expression) -> (Expression, Expression) {
    let width = significant(&l).max(significant(&r)).min(l.width);
    (slice(l, 0, width), slice(r, 0, width))
}

impl Expression {
    /// True when bits are taken from anything but a signal, which Verilog cannot write.
    #[must_use]
    pub fn has_cut_arithmetic(&self) -> bool {
        let cut_here = match &self.node {
            Node::Slice { of, .. } => !matches!(of.node, Node::Signal(_)),
            _ => false,
        };
        cut_here || self.operands().into_iter().any(Self::has_cut_arithmetic)
    }
}
