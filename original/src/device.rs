//! The device whole: the figures joined, from the two trains of pulses to the motor's phases.
//!
//! ```text
//! grating ─ gate ④ ─ ÷A ─ range ─┬─ start ─┬─ meter ────┐
//!             │ open             └─ middle ┴─ standard ─┴ discriminator ─ Q
//! laser ─ compensator ─┬─ phase selector                                  │
//!                      └─ ÷B ─ range ─ start ─ meter                      │
//! tick ──────────────────────────────── reset counter ─ step ─ ring ◄─────┘
//! ```
//!
//! # Inferred
//!
//! The print has a block diagram and its figures, not how one is joined to the next. The ×2 range is
//! taken, as in every example of the print; what the standard square wave is at ×1 it does not say.
//! The step oscillator of figure 14 is left outside, at `tick`: its frequency and phase are the
//! user's.

use crate::circuit::{Circuit, Net};
use crate::figures::compensator::{self, Correction};
use crate::figures::discriminator::{self, ClockInputs};
use crate::figures::divider::{self, Clear};
use crate::figures::{phase_meter, phase_selector, range_stage, reset_counter, ring};

/// How the wheels and switches stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Wheels {
    /// Divider of the grating, 1 to 999.
    pub a: u16,
    /// Divider of the laser, 1 to 999.
    pub b: u16,
    /// Laser pulses before the grating's gate opens, 0 to 999.
    pub initial_phase: u16,
    /// F/1000, 1 to 9999, and which way; `None` for a compensator that is switched off.
    pub compensation: Option<(u16, Correction)>,
}

/// The device, with these pins in: `grating`, `laser`, `tick`, `playback` and `reset`, which is high at
/// power-up. Out: `start`, `middle`, `laser_start`, `meter`, `q`, `forward`, `step`,
/// `count0` … `count11`, `zero` and `phase0` … `phase2`.
#[must_use]
pub fn circuit(wheels: &Wheels) -> Circuit {
    let mut c = Circuit::new("device");
    let [grating, laser] = ["grating", "laser"].map(|name| c.input(name, false));
    let [tick, playback] = ["tick", "playback"].map(|name| c.input(name, false));
    let reset = c.input("reset", true);
    let reset_bar = c.not("reset_bar", reset);
    let pulses = match wheels.compensation {
        Some((thousands, way)) => {
            c.block("compensator", |c| compensator::add(c, laser, reset, thousands, way))
        }
        None => laser,
    };
    let [line, open] = c.block("selector", |c| {
        phase_selector::add(c, pulses, grating, reset, wheels.initial_phase)
    });
    let a = c.block("a", |c| divider::add(c, line, reset, wheels.a, Clear::Delayed));
    let b = c.block("b", |c| divider::add(c, pulses, reset, wheels.b, Clear::Delayed));
    let [start, middle] = c.block("grating_range", |c| range_stage::add(c, a, reset_bar));
    let [laser_start, _] = c.block("laser_range", |c| range_stage::add(c, b, reset_bar));
    let meter = phase_meter::add(&mut c, start, laser_start, open);
    let standard = discriminator::standard(&mut c, start, middle, open);
    let [q, _] = discriminator::add(&mut c, meter, standard, ClockInputs::Coupled);
    let counter = c.block("counter", |c| reset_counter::add(c, tick, q, playback, reset_bar));
    let phases = c.block("ring", |c| ring::add(c, counter.step, counter.drive_forward));
    let shown = [("start", start), ("middle", middle), ("laser_start", laser_start)];
    let motor =
        [("forward", counter.drive_forward), ("step", counter.step), ("zero", counter.zero)];
    let shown = shown.into_iter().chain([("meter", meter[0]), ("q", q)]).chain(motor);
    shown.for_each(|(name, net)| c.output(name, net));
    outputs(&mut c, "count", &counter.count);
    outputs(&mut c, "phase", &phases);
    c
}

fn outputs(c: &mut Circuit, name: &str, nets: &[Net]) {
    for (number, net) in nets.iter().enumerate() {
        c.output(&format!("{name}{number}"), *net);
    }
}
