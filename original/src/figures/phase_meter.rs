//! Phase meter, figures 3 and 6: a double-input flip-flop.
//!
//! The divided grating sets it, the divided laser clears it; T1 and T2 are its two sides.
//!
//! ```text
//! grating ─ NAND ─ set ──┐            T1 = ¬(set ∧ T2)
//! laser ─── NOT ── clear ┤ two NANDs
//! hold_bar ──────────────┘            T2 = ¬(clear ∧ hold_bar ∧ T1)
//! ```
//!
//! | grating | laser | T1 then | T2 then |
//! |---------|-------|---------|---------|
//! | 0       | 0     | T1      | T2      |
//! | 1       | 0     | 1       | 0       |
//! | 0       | 1     | 0       | 1       |
//! | 1       | 1     | 1       | 1       |
//!
//! While both pulses last both sides are high, and the pulse that ends last decides: after a
//! coincidence the meter is as if the pulses had come one after the other. The synchronous block
//! keeps its state there.
//!
//! # Inferred
//!
//! "Double-input flip-flop" is read as two cross-coupled NAND gates. Alternatives: preset and clear
//! of a JK (the same, but for the delays), or capacitors at the inputs, so that only edges count;
//! then both sides would never be high together. Hold: the text says that the state does not change
//! while the phase is selected; here the set is blocked and the clear held.

use crate::circuit::{Circuit, Net};

/// Sides T1 and T2.
pub fn add(c: &mut Circuit, grating: Net, laser: Net, hold_bar: Net) -> [Net; 2] {
    let set = c.nand("set", &[grating, hold_bar]);
    let clear = c.not("clear", laser);
    c.latch("meter", &[set], &[clear, hold_bar])
}

/// The drawing alone.
#[must_use]
pub fn circuit() -> Circuit {
    let mut c = Circuit::new("phase_meter");
    let (grating, laser) = (c.input("grating", false), c.input("laser", false));
    let hold_bar = c.input("hold_bar", true);
    let [t1, t2] = add(&mut c, grating, laser, hold_bar);
    c.output("t1", t1);
    c.output("t2", t2);
    c
}
