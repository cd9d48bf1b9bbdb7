//! A design as Rust source: compiled ahead of time, it runs at the speed of hand-written code.
//!
//! The source names what `helixlock-sim` defines (`Kernel`, `Moment`, …) and is included there; it
//! holds straight-line code on 64-bit words, one word a signal, without a branch in the logic.

mod dense;
mod lanes;
mod pieces;
mod words;

use std::fmt::Write as _;

use crate::Netlist;

/// Rust items that define `name`: a kernel that steps every clock and one that leaps.
///
#[must_use]
pub fn generate(netlist: &Netlist, name: &str) -> String {
    let mut source = String::new();
    // Writing into a string does not fail.
    let _ = write!(
        source,
        "/// Generated from the netlist.\n#[derive(Clone, Copy, Debug)]\npub struct {name};\n\n"
    );
    source += &dense::source(netlist, name);
    source += &pieces::source(netlist, name);
    source += &lanes::source(netlist, name);
    source
}
