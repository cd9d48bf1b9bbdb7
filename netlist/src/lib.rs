//! A rust-hdl design as typed, flat logic; knows no grinder.

mod flat;

pub use flat::{Assignment, Expression, Netlist, Node, Register, Signal, SignalId, mask};
