//! Divider, figure 7: three decades, an AND gate on the chosen number, and a clear through a delay.
//!
//! ```text
//! pulse ─ units ─ tens ─ hundreds
//!           │      │       │  contacts of the band switch
//!           └─ NAND each ─ NOR ─ coincidence = divided
//!                                  └ delay ─ NOR(reset) ─ clear of all decades
//! ```
//!
//! ```text
//! N = 3
//! pulse     ▁▔▁▔▁▔▁▁▁▁▁▁▔▁▔▁▔▁▁▁▁▁▁
//! divided   ▁▁▁▁▁▁▔▔▁▁▁▁▁▁▁▁▁▁▔▔▁▁▁
//! clear_bar ▔▔▔▔▔▔▔▁▁▔▔▔▔▔▔▔▔▔▔▔▁▁▔
//! ```
//!
//! The divided pulse lasts as long as the delay, and so does the clear behind it: every flip-flop
//! gets one of full length. A pulse that falls while the clear is low is not counted.
//!
//! # Inferred
//!
//! The text has "AND gate, inverter, delay" and that coincidence gives one pulse and clears the
//! counter. The switch has contacts for the ones of the number only (alternative: all bits, with
//! complements for the noughts; an up-counter that starts at nought does not need them). The delay
//! is an RC network of 0.5 µs, long against a flip-flop and short against 100 µs between pulses;
//! the text gives no value.

use crate::circuit::{Circuit, Net};

use super::decade;

/// Delay of the clear, ps.
pub const DELAY_PS: u64 = 500_000;

/// How coincidence clears the decades.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Clear {
    /// Through the delay, as printed.
    Delayed,
    /// At once: the remedy is taken out.
    AtOnce,
}

/// The divided pulse; `number` is 1 to 999.
pub fn add(c: &mut Circuit, pulse: Net, reset: Net, number: u16, clear: Clear) -> Net {
    let clear_bar = c.wire("clear_bar");
    let digits = decade::row(c, &["units", "tens", "hundreds"], pulse, clear_bar);
    let mut missing = Vec::new();
    for ((name, digit), power) in
        ["units_wheel", "tens_wheel", "hundreds_wheel"].into_iter().zip(&digits).zip([1, 10, 100])
    {
        missing.push(decade::wheel(c, name, digit, number / power % 10));
    }
    let coincidence = c.nor("coincidence", &missing);
    let late = match clear {
        Clear::Delayed => c.delay("late", coincidence, DELAY_PS),
        Clear::AtOnce => coincidence,
    };
    c.nor_onto(clear_bar, &[late, reset]);
    coincidence
}

/// The drawing alone, set to a number from 1 to 999.
#[must_use]
pub fn circuit(number: u16, clear: Clear) -> Circuit {
    let mut c = Circuit::new("divider");
    let (pulse, reset) = (c.input("pulse", false), c.input("reset", false));
    let divided = add(&mut c, pulse, reset, number, clear);
    c.output("divided", divided);
    c
}
