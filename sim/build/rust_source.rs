//! A design as Rust source: compiled ahead of time, it runs at the speed of hand-written code.
//!
//! The source names what `src/engine` defines (`Kernel`, `Moment`, …) and is included beside it; it
//! computes on 64-bit words, one word a signal but for bits that are packed to be looked up;
//! branches only pass over what has nothing to do.

mod activity;
mod blocks;
mod cuts;
mod dense;
mod digits;
mod following;
mod gates;
mod gather;
mod lane_circuit;
mod lanes;
mod layout;
mod leaping;
mod outside;
mod packing;
mod plan;
mod signals;
mod split;
mod tables;
mod words;

use helixlock_netlist::Netlist;

/// Rust items that define `name`: a kernel for the engines that step and leap.
pub(crate) fn generate(netlist: &Netlist, name: &str) -> String {
    let item = format!(
        "/// Generated from the netlist.\n#[derive(Clone, Copy, Debug, Default)]\npub struct {name};\n\n"
    );
    item + &signals::source(netlist, name) + &dense::source(netlist, name)
}

/// Rust items that make of the `name` that [`generate`] defines a kernel of many copies too.
pub(crate) fn generate_lanes(netlist: &Netlist, name: &str) -> String {
    lanes::source(netlist, name)
}
