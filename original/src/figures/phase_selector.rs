//! Initial-phase selector, figure 8: the laser counts m pulses, then the grating's gate opens.
//!
//! ```text
//! laser ─ three decades ─ gate ② ─ NOT ─ flip-flop ③ ─ open
//! grating ───────────────────────────────────── AND ④ ─ line
//! ```
//!
//! | laser pulses since `reset` | `open` | `line`    |
//! |----------------------------|--------|-----------|
//! | fewer than m               | 0      | 0         |
//! | m and more                 | 1      | `grating` |
//!
//! The gate opens when the m-th pulse falls. Nothing keeps the grating from being high at that
//! moment: then the first line is what is left of it, a runt at worst. The synchronous block lets
//! only whole lines through.
//!
//! # Inferred
//!
//! Decades of its own (alternative: those of divider B, with a switch of their own; then m could not
//! exceed B). They count on behind m, which changes nothing: flip-flop ③ is set already. Gate ⑤,
//! which holds the phase meter meanwhile, is that meter's `hold_bar`.

use crate::circuit::{Circuit, Net};

use super::decade;

/// Lines that pass, and whether the gate is open; `m` is 0 to 999.
pub fn add(c: &mut Circuit, laser: Net, grating: Net, reset: Net, m: u16) -> [Net; 2] {
    let reset_bar = c.not("reset_bar", reset);
    let digits = decade::row(c, &["units", "tens", "hundreds"], laser, reset_bar);
    let mut missing = Vec::new();
    for ((name, digit), power) in
        ["units_wheel", "tens_wheel", "hundreds_wheel"].into_iter().zip(&digits).zip([1, 10, 100])
    {
        missing.push(decade::wheel(c, name, digit, m / power % 10));
    }
    let reached = c.nor("reached", &missing);
    let set = c.not("set", reached);
    let [open, _] = c.latch("open", &[set], &[reset_bar]);
    [c.and("line", [grating, open]), open]
}

/// The drawing alone, set to m = 0 to 999.
#[must_use]
pub fn circuit(m: u16) -> Circuit {
    let mut c = Circuit::new("phase_selector");
    let (laser, grating) = (c.input("laser", false), c.input("grating", false));
    let reset = c.input("reset", true);
    let [line, open] = add(&mut c, laser, grating, reset, m);
    c.output("line", line);
    c.output("open", open);
    c
}
