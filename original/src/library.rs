//! Parts of the time, with the delays that their data sheets print.
//!
//! The report names no part. TTL of the 74 series is taken, which Chinese works made from 1970 on
//! under their own numbers and to the same limits.
//!
//! Typical and maximum delays, and the flip-flops' shortest pulses, are those of *The TTL Data Book
//! for Design Engineers* (Texas Instruments, 2nd edition 1976), switching characteristics at 5 V,
//! 25 °C, 15 pF, 400 Ω. Other makers' sheets say the same where they were at hand: ITT's data book of
//! the time for its 7430 (8 and 15 ns to low, 13 and 22 ns to high), and Fairchild DS006613 of July
//! 2001 for the DM7400 (at most 22 and 15 ns; it prints nothing else).
//!
//! None prints a **minimum**. Half the typical delay is assumed, for every part alike: the limits are
//! then about as far above the typical delay as below it, by ratio, and nothing here depends on a part
//! being slower than that. Delays of one package, which resemble each other, are drawn apart.

/// Shortest, typical and longest of a time, ps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Span {
    /// No part is quicker.
    pub shortest_ps: u64,
    /// What the sheet calls typical.
    pub typical_ps: u64,
    /// No part is slower.
    pub longest_ps: u64,
}

/// Delays of an output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// From low to high, tPLH.
    pub rise: Span,
    /// From high to low, tPHL.
    pub fall: Span,
}

/// A part of the data book.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    /// Its number.
    pub name: &'static str,
    /// What it is.
    pub what: &'static str,
    /// Delays of its outputs.
    pub limits: Limits,
}

/// What a 7472, 7473 or 7476 asks of its inputs, ps; set-up and hold are 0, but J and K have to
/// rest while the clock is high.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pulses {
    /// Shortest clock, high.
    pub clock_high_ps: u64,
    /// Shortest time between clocks.
    pub clock_low_ps: u64,
    /// Shortest preset or clear.
    pub preset_clear_ps: u64,
}

/// Minimum pulse widths of the JK flip-flops.
pub const FLIP_FLOP_PULSES: Pulses =
    Pulses { clock_high_ps: 20_000, clock_low_ps: 47_000, preset_clear_ps: 25_000 };

/// Inverter.
pub const SN7404: Part = gate("SN7404", "inverter", (12_000, 22_000), (8_000, 15_000));
/// NAND of two.
pub const SN7400: Part = gate("SN7400", "2-input NAND", (11_000, 22_000), (7_000, 15_000));
/// NAND of three.
pub const SN7410: Part = gate("SN7410", "3-input NAND", (11_000, 22_000), (7_000, 15_000));
/// NAND of four.
pub const SN7420: Part = gate("SN7420", "4-input NAND", (12_000, 22_000), (8_000, 15_000));
/// NAND of eight.
pub const SN7430: Part = gate("SN7430", "8-input NAND", (13_000, 22_000), (8_000, 15_000));
/// NOR of two.
pub const SN7402: Part = gate("SN7402", "2-input NOR", (12_000, 22_000), (8_000, 15_000));
/// NOR of three.
pub const SN7427: Part = gate("SN7427", "3-input NOR", (10_000, 15_000), (7_000, 11_000));
/// AND of two.
pub const SN7408: Part = gate("SN7408", "2-input AND", (17_500, 27_000), (12_000, 19_000));
/// OR of two.
pub const SN7432: Part = gate("SN7432", "2-input OR", (10_000, 15_000), (14_000, 22_000));
/// AND-OR-invert, two by two.
pub const SN7451: Part = gate("SN7451", "AND-OR-INVERT", (13_000, 22_000), (8_000, 15_000));
/// JK flip-flop with three J and three K inputs, master and slave.
pub const SN7472: Part = gate("SN7472", "AND-gated JK", (16_000, 25_000), (25_000, 40_000));
/// JK flip-flop with preset and clear, master and slave.
pub const SN7476: Part = gate("SN7476", "JK flip-flop", (16_000, 25_000), (25_000, 40_000));

/// Every part, in the order of their numbers.
pub const PARTS: &[Part] = &[
    SN7400, SN7402, SN7404, SN7408, SN7410, SN7420, SN7427, SN7430, SN7432, SN7451, SN7472, SN7476,
];

/// A resistor and a capacitor before a gate. Both had ±10 % in ordinary grades, ±20 % together.
pub const RC_DELAY: &str = "RC";

/// A clock input of the two-clock flip-flop: shorter pulses do not get in. The longest is the
/// 20 ns that the sheet of the 7472 asks for; the others are assumed.
pub const CLOCK_INPUT: Part = Part {
    name: "CP",
    what: "clock input",
    limits: Limits {
        rise: Span { shortest_ps: 7_000, typical_ps: 14_000, longest_ps: 20_000 },
        fall: Span { shortest_ps: 7_000, typical_ps: 14_000, longest_ps: 20_000 },
    },
};

/// Delays of a network of this time constant, ps.
#[must_use]
pub const fn rc_limits(nominal_ps: u64) -> Limits {
    let fifth = nominal_ps / 5;
    let span = Span {
        shortest_ps: nominal_ps - fifth,
        typical_ps: nominal_ps,
        longest_ps: nominal_ps + fifth,
    };
    Limits { rise: span, fall: span }
}

/// Typical and longest delay of either edge, as the sheet has them.
const fn gate(name: &'static str, what: &'static str, rise: (u64, u64), fall: (u64, u64)) -> Part {
    Part { name, what, limits: Limits { rise: span(rise), fall: span(fall) } }
}

const fn span((typical_ps, longest_ps): (u64, u64)) -> Span {
    Span { shortest_ps: typical_ps / 2, typical_ps, longest_ps }
}
