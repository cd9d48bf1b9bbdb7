//! The lines of the grating are not evenly divided.
//!
//! ```text
//! δ(θ) = a·sin(k·θ + φ),  k ≥ 2
//!
//! δ, a in µm as lead    θ spindle angle    k harmonic    φ phase
//! ```
//!
//! 0.05 µm at k = 2 and 6 mm of lead is 10.8 seconds of arc on the disc. k = 1 is eccentricity.

use super::wave::{Run, indexed};
use crate::machine::Part;
use crate::units::{NUMBER, UM};
use crate::{Card, Covariate, Entry, Nature, Parameter, Search};

pub(super) const CARD: Card = Card {
    kind: "grating-graduation",
    entry: Entry::AngleReference,
    summary: "the lines of the grating are not evenly divided",
    formula: "a·sin(k·(θ + index) + φ), k ≥ 2",
    example: "a = 0.05 µm, S = 6 mm: 10.8 seconds of arc",
    parameters: &[
        Parameter::amplitude("amplitude", UM, "as lead").within(0.0..=50.0),
        Parameter::phase("phase", "phase at spindle angle 0, disc not turned"),
        Parameter::nonlinear("harmonic", NUMBER, Search::Whole, "waves per turn")
            .within(2.0..=24.0)
            .or(2.0),
    ],
    parts: &[Part::Grating],
    needs: &[],
    signature: "whole waves per turn, from 2, that turn with the disc (grating_index_deg)",
    confused_with: &["gear-error", "screw-periodic", "clamping-runout"],
    separated_by: "turn the disc on its hub and repeat",
    source: "division errors of circular scales",
    random: false,
    candidate: true,
    nature: Nature::PLAIN,
    basis: |_, nonlinear| {
        let order = nonlinear[0];
        Ok(indexed(Run::Spindle { order }, 1.0, Some((Covariate::GratingIndex, order))))
    },
};
