//! Direction discriminator, figures 15 and 16: three NAND gates and a flip-flop with two clocks.
//!
//! ```text
//! start, middle ─ standard (double-input flip-flop)
//! NAND3 = ¬standard
//! NAND1 = ¬(T1 ∧ NAND3)      ─ CP1 ─ Q high, motor forward
//! NAND2 = ¬(T2 ∧ standard)   ─ CP2 ─ Q low, motor reverse
//! ```
//!
//! Figure 16, wider and narrower:
//!
//! ```text
//! standard ▁▔▔▔▁▁▁▔▔▔▁▁▁
//! meter    ▁▔▔▔▔▁▁▔▔▁▁▁▁
//! CP1      ▔▔▔▔▁▔▔▔▔▔▔▔▔
//! CP2      ▔▔▔▔▔▔▔▔▔▁▔▔▔
//! Q        ▁▁▁▁▔▔▔▔▔▁▁▁▁
//! ```
//!
//! At the start of a comparison meter and standard rise together, each in its own time; their
//! difference comes out of NAND1 and NAND2 as a runt. It is the clock inputs that keep it out.
//!
//! # Inferred
//!
//! "Double-input JK flip-flop" is read as a double-input flip-flop whose clocks are coupled in by RC
//! networks, as flip-flops of discrete parts were: what is shorter than [`COUPLING_PS`] does not get
//! in. Both waves rise at one instant in any circuit of three NANDs, and the longest runt that gates
//! within their data sheets can make of it is 61.5 ns: 11.5 and 16.5 ns between the two NANDs and
//! the two latches, 15 ns of NAND3, and 18.5 ns by which NAND1 rises later than it falls. The report
//! calls its square-wave trigger proof against interference and ground 200 screws with it, so its
//! inputs kept that out. Alternatives: inputs that want a pulse of clock length, 20 ns at most, as
//! the 7472 does, so that every other device loses directions; two NAND gates alone (they take a
//! runt that is longer than themselves); or a JK whose clocks are joined by a gate (it counts every
//! runt). The standard wave is made by a flip-flop like the meter's, so that both have
//! the same delay; see [`range_stage`](super::range_stage) for the alternative.

use crate::circuit::{Circuit, Net};

use super::phase_meter;

/// Time constant of the coupling of the clocks, ps: with 20 % less still longer than any runt.
pub const COUPLING_PS: u64 = 100_000;

/// How the NAND gates act on the flip-flop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ClockInputs {
    /// Through RC networks.
    Coupled,
    /// Through inputs that want a pulse of clock length.
    OfClockLength,
    /// At once: the remedy is taken out.
    Missing,
}

/// Q and its complement from meter and standard wave.
pub fn add(c: &mut Circuit, [t1, t2]: [Net; 2], standard: Net, inputs: ClockInputs) -> [Net; 2] {
    let nand3 = c.nand("nand3", &[standard, Circuit::HIGH]);
    let nand1 = c.nand("nand1", &[t1, nand3]);
    let nand2 = c.nand("nand2", &[t2, standard]);
    let [cp1, cp2] = match inputs {
        ClockInputs::Coupled => {
            [c.delay("cp1", nand1, COUPLING_PS), c.delay("cp2", nand2, COUPLING_PS)]
        }
        ClockInputs::OfClockLength => [c.clock_input("cp1", nand1), c.clock_input("cp2", nand2)],
        ClockInputs::Missing => [nand1, nand2],
    };
    c.latch("q", &[cp1], &[cp2])
}

/// The standard wave: set with the meter, cleared in the middle.
pub fn standard(c: &mut Circuit, start: Net, middle: Net, hold_bar: Net) -> Net {
    let set = c.nand("standard_set", &[start, hold_bar]);
    let clear = c.not("standard_clear", middle);
    c.latch("standard", &[set], &[clear, hold_bar])[0]
}

/// The drawing with its meter and standard wave: the comparison.
#[must_use]
pub fn circuit() -> Circuit {
    with(ClockInputs::Coupled)
}

/// The comparison with other clock inputs.
#[must_use]
pub fn with(inputs: ClockInputs) -> Circuit {
    let mut c = Circuit::new("discriminator");
    let [start, middle, laser] = ["start", "middle", "laser"].map(|name| c.input(name, false));
    let hold_bar = c.input("hold_bar", true);
    let meter = phase_meter::add(&mut c, start, laser, hold_bar);
    let standard = standard(&mut c, start, middle, hold_bar);
    let [q, q_bar] = add(&mut c, meter, standard, inputs);
    c.output("q", q);
    c.output("q_bar", q_bar);
    c
}
