//! A whole design as one flat list of signals, registers and assignments in evaluation order.
//!
//! This is what every engine is made from. All registers share one clock; a combinational loop
//! never gets here.

/// Index of a signal in [`Netlist::signals`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct SignalId(pub u32);

/// A named bundle of at most 64 wires.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Signal {
    /// Names of the instances down to it and its own, joined by dots: `divider_a.units.digit`.
    pub path: String,
    /// Number of bits, 1 to 64.
    pub width: u32,
}

/// A flip-flop of `width` bits: takes `input` at each rising edge of the clock.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Register {
    /// The signal it drives (q).
    pub output: SignalId,
    /// The signal it takes (d).
    pub input: SignalId,
    /// Its state at power-up.
    pub initial: u64,
}

/// `target` follows `value` at once.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Assignment {
    /// The signal driven.
    pub target: SignalId,
    /// What drives it; as wide as the target.
    pub value: Expression,
}

/// A value of `width` bits.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Expression {
    /// Number of bits, 1 to 64; arithmetic wraps at it.
    pub width: u32,
    /// How it is computed.
    pub node: Node,
}

/// The operators. Operands of a two-operand node are equally wide; comparisons are unsigned and
/// give one bit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Node {
    /// A constant that fits the width.
    Constant(u64),
    /// The signal of that width.
    Signal(SignalId),
    /// Bitwise complement.
    Not(Box<Expression>),
    /// Bitwise and.
    And(Box<Expression>, Box<Expression>),
    /// Bitwise or.
    Or(Box<Expression>, Box<Expression>),
    /// Bitwise exclusive or.
    Xor(Box<Expression>, Box<Expression>),
    /// Sum, wrapping.
    Add(Box<Expression>, Box<Expression>),
    /// Difference, wrapping.
    Subtract(Box<Expression>, Box<Expression>),
    /// Left operand shifted up by the right one; zeros come in.
    ShiftUp(Box<Expression>, Box<Expression>),
    /// Left operand shifted down by the right one; zeros come in.
    ShiftDown(Box<Expression>, Box<Expression>),
    /// One bit: equal.
    Equal(Box<Expression>, Box<Expression>),
    /// One bit: left below right, unsigned.
    Less(Box<Expression>, Box<Expression>),
    /// One bit: left not above right, unsigned.
    LessOrEqual(Box<Expression>, Box<Expression>),
    /// One bit: all bits set.
    All(Box<Expression>),
    /// One bit: some bit set.
    Any(Box<Expression>),
    /// One bit: odd number of bits set.
    Parity(Box<Expression>),
    /// `width` bits of a wider value, from bit `low` up.
    Slice {
        /// The value cut.
        of: Box<Expression>,
        /// Its lowest bit taken.
        low: u32,
    },
    /// The operand with zeros above it.
    Extend(Box<Expression>),
    /// `then` when the one-bit condition holds, else `otherwise`.
    Select {
        /// One bit.
        condition: Box<Expression>,
        /// Value when it is set.
        then: Box<Expression>,
        /// Value when it is clear.
        otherwise: Box<Expression>,
    },
}

/// A flat design.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Netlist {
    /// Every signal, by [`SignalId`]; the clock is not among them.
    pub signals: Vec<Signal>,
    /// Inputs of the top module, in port order, without the clock.
    pub inputs: Vec<SignalId>,
    /// Outputs of the top module, in port order.
    pub outputs: Vec<SignalId>,
    /// Flip-flops, in order of their paths.
    pub registers: Vec<Register>,
    /// Assignments; each reads only inputs, registers and targets before it.
    pub assignments: Vec<Assignment>,
}

impl Netlist {
    /// The signal of that path.
    #[must_use]
    pub fn find(&self, path: &str) -> Option<SignalId> {
        let index = self.signals.iter().position(|signal| signal.path == path)?;
        u32::try_from(index).ok().map(SignalId)
    }

    /// Name and width of a signal.
    ///
    /// # Panics
    ///
    /// When the id belongs to another netlist and is too large for this one.
    #[must_use]
    pub fn signal(&self, id: SignalId) -> &Signal {
        &self.signals[id.0 as usize]
    }
}

impl Expression {
    /// Its value when the signals have the given ones, in the order of [`Netlist::signals`].
    ///
    /// # Panics
    ///
    /// When it reads a signal that `values` does not have.
    #[must_use]
    pub fn evaluate(&self, values: &[u64]) -> u64 {
        let of = |operand: &Self| operand.evaluate(values);
        let raw = match &self.node {
            Node::Constant(value) => *value,
            Node::Signal(id) => values[id.0 as usize],
            Node::Not(a) => !of(a),
            Node::And(a, b) => of(a) & of(b),
            Node::Or(a, b) => of(a) | of(b),
            Node::Xor(a, b) => of(a) ^ of(b),
            Node::Add(a, b) => of(a).wrapping_add(of(b)),
            Node::Subtract(a, b) => of(a).wrapping_sub(of(b)),
            Node::ShiftUp(a, b) => shift(of(b), |by| of(a) << by),
            Node::ShiftDown(a, b) => shift(of(b), |by| of(a) >> by),
            Node::Equal(a, b) => u64::from(of(a) == of(b)),
            Node::Less(a, b) => u64::from(of(a) < of(b)),
            Node::LessOrEqual(a, b) => u64::from(of(a) <= of(b)),
            Node::All(a) => u64::from(of(a) == mask(a.width)),
            Node::Any(a) => u64::from(of(a) != 0),
            Node::Parity(a) => u64::from(of(a).count_ones() & 1),
            Node::Slice { of: wider, low } => of(wider) >> low,
            Node::Extend(a) => of(a),
            Node::Select { condition, then, otherwise } => {
                of(if of(condition) == 0 { otherwise } else { then })
            }
        };
        raw & mask(self.width)
    }
}

/// `width` ones, `width` from 1 to 64.
#[inline]
#[must_use]
pub const fn mask(width: u32) -> u64 {
    u64::MAX >> (64 - width)
}

/// Shifts by 64 and more leave nothing.
fn shift(by: u64, shifted: impl Fn(u64) -> u64) -> u64 {
    if by < 64 { shifted(by) } else { 0 }
}
