//! Calibrator, figures 11 and 12: flip-flop E makes a known phase, D sees that it is the right one.
//!
//! Three flip-flops count eighths, the last of them is D. E toggles when an eighth ends: at 8 and,
//! for 45°, at 3, so that it is high for three eighths, 135°, if it was low before. If it was high,
//! it is high for the other five: 225°. So the rise of D, in the middle of the pause, clears E.
//!
//! | step | E toggles at the end of | T1 high in the eighths | phase |
//! |------|-------------------------|------------------------|-------|
//! | 180° | 7 and 3                 | 0 1 2 3                | 180°  |
//! | 90°  | 7 and 1                 | 0 1                    | 90°   |
//! | 45°  | 7 and 2                 | 0 1 2                  | 135°  |
//!
//! # Inferred
//!
//! The text names D and E, the clamp pulse from D to E, and that without it E might start high and
//! the phase be 225°. Its wave-forms are lost. The gate that ends an eighth is open only while
//! `line` is high, when the ripple is over; without this it would see 2 while 3 becomes 4, and
//! clock E once too often, which the clamp of the same moment hides. The first period after switching on may be the wrong one, until D has
//! clamped once; the synchronous block has no such state.

use crate::circuit::{Circuit, Jk, Net};

/// Length of the clamp pulse, ps.
const CLAMP_PS: u64 = 500_000;

/// The band switch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// Half a turn.
    Degrees180,
    /// A quarter.
    Degrees90,
    /// 135°, 45° below the middle.
    Degrees45,
}

/// What may be taken out of the drawing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Remedy {
    /// Nothing.
    InPlace,
    /// The clamp from D to E.
    NoClamp,
    /// The strobe of the gate that ends an eighth.
    NoStrobe,
}

/// T1 and T2 of a calibration by these lines.
pub fn add(c: &mut Circuit, line: Net, step: Step, remedy: Remedy) -> [Net; 2] {
    let high = Circuit::HIGH;
    let first = c.flip_flop("first", Jk::toggle(line, high));
    let second = c.flip_flop("second", Jk::toggle(first[0], high));
    let d = c.flip_flop("d", Jk::toggle(second[0], high));
    let strobe = if remedy == Remedy::NoStrobe { high } else { line };
    let last_bar = c.nand("last_bar", &[first[0], second[0], d[0], strobe]);
    let end = match step {
        Step::Degrees180 => [first[0], second[0]],
        Step::Degrees90 => [first[0], second[1]],
        Step::Degrees45 => [first[1], second[0]],
    };
    let end_bar = c.nand("end_bar", &[end[0], end[1], d[1], strobe]);
    let toggle = c.nand("toggle", &[last_bar, end_bar]);
    let late = c.delay("late", d[0], CLAMP_PS);
    let late_bar = c.not("late_bar", late);
    let clamp_bar = c.nand("clamp_bar", &[d[0], late_bar]);
    let clear = if remedy == Remedy::NoClamp { high } else { clamp_bar };
    c.flip_flop("e", Jk::toggle(toggle, clear))
}

/// The drawing alone.
#[must_use]
pub fn circuit(step: Step) -> Circuit {
    without(step, Remedy::InPlace)
}

/// The drawing with something taken out.
#[must_use]
pub fn without(step: Step, remedy: Remedy) -> Circuit {
    let mut c = Circuit::new("calibrator");
    let line = c.input("line", false);
    let [t1, t2] = add(&mut c, line, step, remedy);
    c.output("t1", t1);
    c.output("t2", t2);
    c
}
