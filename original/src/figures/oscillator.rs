//! Step oscillator of figure 14: a gate that drives itself through an RC network.
//!
//! | `run` | `tick`                                             |
//! |-------|----------------------------------------------------|
//! | 0     | high                                               |
//! | 1     | square wave, its period twice network and gate     |
//!
//! # Inferred
//!
//! The text calls it a harmonic oscillator, free-running, whose frequency is the correction speed;
//! its circuit is not printed. The alternative of the time is an LC or RC sine oscillator and a
//! Schmitt trigger; what comes out is the same square wave. That it can be stopped is ours, so that
//! a simulation begins at rest.

use crate::circuit::{Circuit, Net};

/// The square wave, of this half period in the RC network, ps.
pub fn add(c: &mut Circuit, run: Net, half_period_ps: u64) -> Net {
    let tick = c.wire("tick");
    let late = c.delay("late", tick, half_period_ps);
    c.nand_onto(tick, &[run, late]);
    tick
}

/// The drawing alone, with a period of about 6 ms: 160 steps a second, 2 µm/s at the table.
#[must_use]
pub fn circuit() -> Circuit {
    let mut c = Circuit::new("oscillator");
    let run = c.input("run", false);
    let tick = add(&mut c, run, 3_000_000_000);
    c.output("out", tick);
    c
}
