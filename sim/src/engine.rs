//! What any engine does: hold inputs, take rising edges, show every named signal.
//!
//! # When things happen
//!
//! The clock number is the count of rising edges taken since power-up. Between two edges all
//! inputs may change; combinational signals follow at once, and [`Engine::value`] shows them
//! settled. At the edge every flip-flop takes the value its input had just before:
//!
//! ```text
//! clock number   0         1         2         3
//! clock          ▁▁▁▁▔▔▔▔▁▁▁▁▔▔▔▔▁▁▁▁▔▔▔▔▁▁▁▁
//! input          ▁▁▔▔▔▔▔▔▔▔▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁      set between edges 0 and 1, …
//! flip-flop      ▁▁▁▁▔▔▔▔▔▔▔▔▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁      … taken by edge 1
//! ```
//!
//! This is a Verilog test bench that changes its inputs after one rising edge and before the next.
//! An input set after `step` number n is therefore first seen by edge n + 1.

#[cfg(test)]
mod agreement;
mod all_signals;
mod circuit;
#[allow(clippy::inline_always, reason = "compiled once a way of gathering")]
mod compiled;
mod dense;
#[allow(unsafe_code, reason = "an instruction, after asking the processor for it")]
#[allow(clippy::inline_always, reason = "in a function of its own it would lack the instruction")]
mod gather;
mod interpreted_pieces;
mod interpreter;
#[cfg(test)]
mod lane_agreement;
#[allow(unsafe_code, reason = "vector instructions, after asking the processor for them")]
#[allow(clippy::inline_always, reason = "compiled once a kind of vector")]
mod lanes;
mod leap;
#[allow(clippy::inline_always, reason = "compiled once a way of gathering")]
mod leaping;
mod moment;
mod program;
#[cfg(test)]
mod random_design;
mod rest;
#[cfg(test)]
mod samples;
mod state;
#[allow(clippy::inline_always, reason = "compiled once a way of gathering")]
mod traces;
#[allow(unsafe_code, reason = "vector instructions have no other way in")]
#[allow(clippy::inline_always, reason = "in a function of its own it would lack the instructions")]
mod vector;
#[allow(dead_code, reason = "a design may do without shifts")]
mod words;

use helixlock_netlist::{Netlist, SignalId};

#[cfg(test)]
pub(crate) use agreement::compare;
pub use all_signals::AllSignals;
pub use circuit::Circuit;
pub use compiled::Compiled;
pub use dense::{Coast, DenseKernel, Edge, Known};
pub use gather::Gather;
pub use interpreted_pieces::InterpretedPieces;
pub use interpreter::Interpreter;
#[cfg(test)]
pub(crate) use lane_agreement::compare_lanes;
pub use lanes::{LANE_WORDS, LANES, Lane, LaneKernel, Lanes};
pub use leap::Leap;
pub use leaping::Leaping;
pub use moment::{Coasting, Kernel, Moment};
#[cfg(test)]
pub(crate) use random_design::Dice;
pub use rest::Rest;
pub use state::{FlipFlops, Snapshot, SnapshotError, differences};
pub use vector::Vector;
pub(crate) use words::{choose, shift_down, shift_up};

/// Why [`Engine::run_until`] came back.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// The clock number asked for is reached; no watched signal changed on the way.
    Reached,
    /// The last edge changed a watched signal; the clock number asked for may be reached too.
    Changed,
}

/// A design that takes one clock after another.
///
/// Signals are those of [`Engine::netlist`]. Methods panic when given a signal of another netlist:
/// that is a mistake of the program, not of its user.
pub trait Engine {
    /// The design.
    fn netlist(&self) -> &Netlist;

    /// Rising edges taken since power-up.
    fn clock(&self) -> u64;

    /// Drives an input from now on.
    ///
    /// # Panics
    ///
    /// When the signal is not an input, or the value is wider than it.
    fn set_input(&mut self, input: SignalId, value: u64);

    /// The value of any signal, settled.
    fn value(&mut self, signal: SignalId) -> u64;

    /// The values of several signals, settled, instead of what `values` held.
    fn values(&mut self, signals: &[SignalId], values: &mut Vec<u64>) {
        values.clear();
        values.extend(signals.iter().map(|signal| self.value(*signal)));
    }

    /// Takes one rising edge.
    fn step(&mut self);

    /// Names the signals whose change stops [`Engine::run_until`], instead of those named before.
    fn watch(&mut self, signals: &[SignalId]);

    /// Takes rising edges with the inputs held, up to clock number `clock` or to the first edge
    /// that changes a watched signal. A clock number that has passed is reached already.
    fn run_until(&mut self, clock: u64) -> Stop;

    /// All flip-flops, in the order of [`Netlist::registers`], lowest bit first.
    fn flip_flops(&self) -> FlipFlops;

    /// Everything needed to go on from here.
    fn snapshot(&self) -> Snapshot;

    /// Goes back, or over, to a moment of the same design; watched signals stay as they are.
    ///
    /// # Panics
    ///
    /// When the snapshot has another number of inputs or flip-flops than the design.
    fn restore(&mut self, snapshot: &Snapshot);
}
