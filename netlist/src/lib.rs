//! A rust-hdl design as typed, flat logic; knows no grinder.
//!
//! [`elaborate()`] reads a block into a [`Design`] of modules, from which Verilog is written;
//! [`Netlist::new`] joins them into the flat list that engines are made from.

mod agreed;
mod display;
pub mod drivers;
mod elaborate;
mod error;
mod execute;
mod expression;
mod fields;
mod flat;
mod flatten;
mod flip_flop;
mod kernel;
mod kernel_text;
mod library;
mod meaning;
mod module;
mod order;
pub mod partition;
mod scope;
pub mod settle;
mod simulated;
mod source;
mod synthesised;

pub use display::literal;
pub use elaborate::elaborate;
pub use error::NetlistError;
pub use flat::{Assignment, Expression, Netlist, Node, Register, Signal, SignalId, mask};
pub use library::Library;
pub use module::{Design, Instance, Memory, Module, ModuleSignal, Port, PortKind, Role, Statement};
