//! Cumulative compensator, figure 9: every F-th laser pulse, one is blocked or one is added.
//!
//! ```text
//! laser ─┬─ seven decades ─ four wheels, line 123 ─ gate ─ due ─┬─ delay ─ clear of all decades
//!        │                                                      ├─ flip-flop `owed` ─ gate ①
//!        └──────────────────────────────────────────────────────┴─ OR or gate ① ─ pulse
//! ```
//!
//! | ΔS  | `pulse`                                                        |
//! |-----|----------------------------------------------------------------|
//! | > 0 | every laser pulse but the one behind each F-th                 |
//! | < 0 | every laser pulse, and one of 0.5 µs behind the fall of each F-th |
//!
//! # Inferred
//!
//! "The four digits and line 123 see to it that exactly one pulse is blocked": line 123 is read as
//! "the lower three decades show 000". Without a flip-flop the gate would stay shut until the clear,
//! 0.5 µs, and block nothing; so `owed` is set when F is reached and cleared by the fall of the next
//! pulse, which it has blocked. Alternative: no clear, and a gate that is shut from the F-th to the
//! next pulse; then the period would be F + 1, or 10⁷. An added pulse stands in the pause behind the
//! F-th pulse, so it meets no real one.

use crate::circuit::{Circuit, Jk, Net};

use super::decade;
use super::divider::DELAY_PS;

/// Which way the compensator corrects.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Correction {
    /// ΔS > 0: a pulse is blocked.
    Block,
    /// ΔS < 0: a pulse is added.
    Insert,
}

const DECADES: [&str; 7] = ["d0", "d1", "d2", "d3", "d4", "d5", "d6"];
const WHEELS: [(&str, u16); 4] = [("w3", 1), ("w4", 10), ("w5", 100), ("w6", 1000)];

/// The compensated train; `thousands` is F/1000, 1 to 9999.
pub fn add(c: &mut Circuit, laser: Net, reset: Net, thousands: u16, way: Correction) -> Net {
    let clear_bar = c.wire("clear_bar");
    let digits = decade::row(c, &DECADES, laser, clear_bar);
    let lower: Vec<Net> = digits[..3].iter().flatten().map(|bit| bit[1]).collect();
    let (some, others) = (c.nand("some", &lower[..8]), c.nand("others", &lower[8..]));
    let line_123 = c.nor("line_123", &[some, others]);
    let mut shown = vec![line_123];
    for ((name, power), digit) in WHEELS.into_iter().zip(&digits[3..]) {
        let missing = decade::wheel(c, name, digit, thousands / power % 10);
        if missing != Circuit::LOW {
            shown.push(c.not(&format!("{name}_shown"), missing));
        }
    }
    let due_bar = c.nand("due_bar", &shown);
    let due = c.not("due", due_bar);
    let late = c.delay("late", due, DELAY_PS);
    c.nor_onto(clear_bar, &[late, reset]);
    match way {
        Correction::Insert => c.or("added", [laser, due]),
        Correction::Block => {
            let (low, high) = (Circuit::LOW, Circuit::HIGH);
            let reset_bar = c.not("reset_bar", reset);
            let pins =
                Jk { clock: laser, j: &[low], k: &[high], preset: due_bar, clear: reset_bar };
            let [_, free] = c.flip_flop("owed", pins);
            c.and("passed", [laser, free])
        }
    }
}

/// The drawing alone, set to F/1000 from 1 to 9999.
#[must_use]
pub fn circuit(thousands: u16, way: Correction) -> Circuit {
    let mut c = Circuit::new("compensator");
    let (laser, reset) = (c.input("laser", false), c.input("reset", false));
    let pulse = add(&mut c, laser, reset, thousands, way);
    c.output("pulse", pulse);
    c
}
