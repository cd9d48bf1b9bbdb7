//! The laser's wavelength drifts, or hops to another mode.
//!
//! ```text
//! δ = x·(r·t + h·[t ≥ t_h])
//!
//! δ in µm    x travel in m    r drift of the wavelength in ppm per time    h hop in ppm, at time t_h
//! ```
//!
//! A longer wavelength counts fewer fringes: 0.1 ppm/h after one hour at 1 m is 0.1 µm.
//! A hop at time 0 is none.

use super::shape::{polynomial, rough, since};
use crate::machine::Part;
use crate::units::{PPM, PPM_PER_H, S};
use crate::{Basis, Card, Entry, Nature, Parameter, Search};

pub(super) const CARD: Card = Card {
    kind: "laser-drift",
    entry: Entry::LengthReference,
    summary: "the laser's wavelength drifts, or hops to another mode",
    formula: "x·(r·t + h·[t ≥ t_h])",
    example: "r = 0.1 ppm/h, t = 1 h, x = 1 m: 0.1 µm",
    parameters: &[
        Parameter::linear("rate", PPM_PER_H, "drift of the wavelength")
            .within(-100.0..=100.0)
            .or(0.0),
        Parameter::linear("hop", PPM, "jump of the wavelength").within(-10.0..=10.0).or(0.0),
        Parameter::nonlinear("hop_time", S, Search::Time, "when it jumps")
            .within(0.0..=1e7)
            .or(0.0),
    ],
    parts: &[Part::Table, Part::Laser],
    needs: &[],
    signature: "a slope over travel that changes with time",
    confused_with: &["air-temperature", "air-pressure"],
    separated_by: "a second laser, or the lock bit of this one",
    source: "δ = x·Δλ/λ; Δλ/λ = −Δν/ν",
    random: false,
    candidate: true,
    nature: Nature::PLAIN,
    basis: |_, nonlinear| {
        let hop_s = nonlinear[0];
        let ramp = polynomial(|now| now.position_m() * now.time_s / 3600.0);
        let hop =
            rough(move |now| if hop_s <= 0.0 { 0.0 } else { now.position_m() * since(hop_s, now) });
        Ok(Basis::two(ramp, hop))
    },
};
