//! Decade of figure 7: four JK flip-flops that ripple.
//!
//! | pulses | 0 | 1 | 2 | 3 | 4 | 5 | 6 | 7 | 8 | 9 | 10 |
//! |--------|---|---|---|---|---|---|---|---|---|---|----|
//! | `d`    | 0 | 0 | 0 | 0 | 0 | 0 | 0 | 0 | 1 | 1 | 0  |
//! | `c`    | 0 | 0 | 0 | 0 | 1 | 1 | 1 | 1 | 0 | 0 | 0  |
//! | `b`    | 0 | 0 | 1 | 1 | 0 | 0 | 1 | 1 | 0 | 0 | 0  |
//! | `a`    | 0 | 1 | 0 | 1 | 0 | 1 | 0 | 1 | 0 | 1 | 0  |
//!
//! It counts when `pulse` falls, and the next decade when `d` falls.
//!
//! # Inferred
//!
//! "Decade counter" is all the text says. This is the ripple decade of the SN7490: A by itself, B
//! and C by ripple, D with J = B·C, and B's J = ¬D, so that nine is followed by nought. A decade of
//! another code, or one with all clocks joined, would decode differently; a gate that looks at the
//! high bits only is never too early in this one while J and K rest.

use crate::circuit::{Circuit, Jk, Net};

/// One decade's outputs, low bit first, each with its complement.
pub type Digit = [[Net; 2]; 4];

/// The bits a, b, c, d, each with its complement; `clear` is active low.
pub fn add(c: &mut Circuit, pulse: Net, clear: Net) -> Digit {
    let high = Circuit::HIGH;
    let fourth = c.flip_flop_wires("d");
    let first = c.flip_flop("a", Jk::toggle(pulse, clear));
    let second = c.flip_flop("b", Jk { j: &[fourth[1]], ..Jk::toggle(first[0], clear) });
    let third = c.flip_flop("c", Jk::toggle(second[0], clear));
    let j = [second[0], third[0]];
    let pins = Jk { clock: first[0], j: &j, k: &[high], preset: high, clear };
    c.flip_flop_onto(fourth, pins);
    [first, second, third, fourth]
}

/// Several decades in a row, units first.
pub fn row(c: &mut Circuit, names: &[&str], pulse: Net, clear: Net) -> Vec<Digit> {
    let mut digits: Vec<Digit> = Vec::new();
    for name in names {
        let carry = digits.last().map_or(pulse, |digit| digit[3][0]);
        digits.push(c.block(name, |c| add(c, carry, clear)));
    }
    digits
}

/// Contacts of a wheel: low when the digit shows all the ones of its number.
pub fn wheel(c: &mut Circuit, name: &str, digit: &Digit, number: u16) -> Net {
    let ones = (0..4).filter(|bit| number >> bit & 1 == 1);
    let contacts: Vec<_> = ones.map(|bit| digit[bit][0]).collect();
    if contacts.is_empty() { Circuit::LOW } else { c.nand(name, &contacts) }
}

/// The drawing alone.
#[must_use]
pub fn circuit() -> Circuit {
    let mut c = Circuit::new("decade");
    let (pulse, clear_bar) = (c.input("pulse", false), c.input("clear_bar", true));
    let digit = add(&mut c, pulse, clear_bar);
    for (name, bit) in ["q0", "q1", "q2", "q3"].into_iter().zip(digit) {
        c.output(name, bit[0]);
    }
    c
}
