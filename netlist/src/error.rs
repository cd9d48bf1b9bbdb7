//! Why a design cannot be turned into logic.

use thiserror::Error;

/// A design that has no single, sound meaning as logic. `block` is the path of the instance.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum NetlistError {
    /// Code other than an update kernel or a plain D flip-flop.
    #[error(
        "{block}: found {found}; expected an update kernel under `#[hdl_gen]` or a `DFF` on the rising edge"
    )]
    UnsupportedCode {
        /// Instance.
        block: String,
        /// Sort of code.
        found: &'static str,
    },
    /// A language element that has no place in a netlist.
    #[error("{block}: `{text}`: {feature} is not supported")]
    Unsupported {
        /// Instance.
        block: String,
        /// Statement or expression.
        text: String,
        /// What it is.
        feature: &'static str,
    },
    /// Words that are not flip-flops.
    #[error("{block}: found a memory, which no engine has")]
    Memory {
        /// Instance.
        block: String,
    },
    /// A name in the kernel that is no field.
    #[error(
        "{block}: `{name}` is not a signal of this block\nhint: a Rust constant needs a `Constant` field"
    )]
    UnknownSignal {
        /// Instance.
        block: String,
        /// Name as written.
        name: String,
    },
    /// The simulator and the Verilog of rust-hdl would compute different values.
    #[error(
        "{block}: `{expression}` means {simulator} in simulation and {verilog} in Verilog\nhint: give the inner part a `Local` signal of its own"
    )]
    TwoMeanings {
        /// Instance.
        block: String,
        /// The whole right-hand side or condition.
        expression: String,
        /// Meaning where every operator works at its operands' width.
        simulator: String,
        /// Meaning under Verilog's context-determined widths.
        verilog: String,
    },
    /// Rust and Verilog group the operators differently.
    #[error(
        "{block}: `{expression}` groups differently in Rust and in Verilog\nhint: add parentheses"
    )]
    Precedence {
        /// Instance.
        block: String,
        /// The expression without parentheses.
        expression: String,
    },
    /// A value that does not fit where it stands.
    #[error("{block}: `{text}`: found {found} bits, expected {expected}")]
    Width {
        /// Instance.
        block: String,
        /// Expression.
        text: String,
        /// Bits found.
        found: usize,
        /// Bits expected; 64 is the most there is.
        expected: usize,
    },
    /// A literal whose width nothing fixes, or that does not fit.
    #[error("{block}: literal `{literal}` does not fit {expected} bits")]
    Literal {
        /// Instance.
        block: String,
        /// As written.
        literal: String,
        /// Bits there are.
        expected: u32,
    },
    /// A clock that is gated, derived or missing.
    #[error(
        "{block}: clock of `{target}`: found {found}; expected the block's own clock input, always"
    )]
    Clock {
        /// Instance.
        block: String,
        /// Clocked field.
        target: String,
        /// What drives it.
        found: &'static str,
    },
    /// A signal that keeps its value on some path.
    #[error(
        "{block}: `{signal}` is not assigned on every path; that is a latch\nhint: assign a default first"
    )]
    Latch {
        /// Instance.
        block: String,
        /// Signal.
        signal: String,
    },
    /// A signal read above its first assignment.
    #[error("{block}: `{signal}` is read before it is assigned")]
    ReadBeforeAssigned {
        /// Instance.
        block: String,
        /// Signal.
        signal: String,
    },
    /// A signal nothing drives.
    #[error("{block}: nothing drives `{signal}`")]
    Undriven {
        /// Instance.
        block: String,
        /// Signal.
        signal: String,
    },
    /// A signal with a driver of its own is assigned again.
    #[error("{block}: `{signal}` is assigned, but it is {driver}")]
    DrivenTwice {
        /// Instance.
        block: String,
        /// Signal.
        signal: String,
        /// What drives it already.
        driver: &'static str,
    },
    /// Two things of one block get the same name.
    #[error("{block}: `{name}` names two things\nhint: a flip-flop `x` makes `x_d` and `x_q`")]
    NameClash {
        /// Instance.
        block: String,
        /// The name.
        name: String,
    },
    /// Logic that feeds itself without a flip-flop.
    #[error("combinational loop: {}", path.join(" → "))]
    Loop {
        /// Signals around the loop; the first one is repeated at the end.
        path: Vec<String>,
    },
}
