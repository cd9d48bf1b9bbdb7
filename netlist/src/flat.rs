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
