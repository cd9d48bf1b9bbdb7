//! Range stage of the ×2 range: "both signals are divided once more".
//!
//! A JK toggles at the end of each divided pulse; two AND gates sort the pulses into those that
//! begin a comparison and those in its middle.
//!
//! | divided pulse | 1     | 2      | 3     | 4      |
//! |---------------|-------|--------|-------|--------|
//! | `start`       | pulse |        | pulse |        |
//! | `middle`      |       | pulse  |       | pulse  |
//!
//! # Inferred
//!
//! No figure shows it; the text of figure 15 says that the standard wave is the grating "divided
//! once". The alternative, the JK's own output as standard wave, rises while the meter still has
//! two gates to go: then the discriminator gets a clock pulse at the start of every comparison.

use crate::circuit::{Circuit, Jk, Net};

/// Pulses that begin a comparison, and those in its middle.
pub fn add(c: &mut Circuit, divided: Net, reset_bar: Net) -> [Net; 2] {
    let [second, first] = c.flip_flop("second", Jk::toggle(divided, reset_bar));
    [c.and("start", [divided, first]), c.and("middle", [divided, second])]
}

/// The drawing alone.
#[must_use]
pub fn circuit() -> Circuit {
    let mut c = Circuit::new("range_stage");
    let (divided, reset_bar) = (c.input("divided", false), c.input("reset_bar", true));
    let [start, middle] = add(&mut c, divided, reset_bar);
    c.output("start", start);
    c.output("middle", middle);
    c
}
