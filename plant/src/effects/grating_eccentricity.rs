//! The grating disc sits off the spindle axis.
//!
//! A disc of diameter `D`, off by `e`, shows its lines up to `2e/D` rad early or late,
//! once a turn. A turn is one lead `S`, so
//!
//! ```text
//! δ(θ) = S/2π · 2e/D · sin(θ + φ) = S·e/(π·D) · sin(θ + φ)
//!
//! δ, e in µm    S, D in mm    θ, φ in rad
//! ```
//!
//! 1 µm on a 200 mm disc is 0.0095 µm at a 6 mm lead: small, but the loop grinds it in.
//! On a rotary chain it is 2e/D itself, 2.06 seconds of arc for the same disc.

use super::wave::{Run, indexed};
use crate::machine::Part;
use crate::units::UM;
use crate::{Card, Covariate, Entry, Nature, Parameter};

pub(super) const CARD: Card = Card {
    kind: "grating-eccentricity",
    entry: Entry::AngleReference,
    summary: "the grating disc sits off the spindle axis",
    formula: "S·e/(π·D)·sin(θ + index + φ)",
    example: "e = 1 µm, D = 200 mm, S = 6 mm: 0.0095 µm",
    parameters: &[
        Parameter::amplitude("eccentricity", UM, "distance of the disc from the axis")
            .within(0.0..=500.0)
            .of_part(),
        Parameter::phase("phase", "phase at spindle angle 0, disc not turned"),
    ],
    parts: &[Part::Grating],
    needs: &[],
    signature: "one wave per spindle turn that turns with the disc (grating_index_deg)",
    confused_with: &["screw-periodic", "clamping-runout"],
    separated_by: "turn the disc by 90° on its hub and repeat the pass",
    source: "geometry; agrees with 412·e/D seconds of arc of the encoder makers",
    random: false,
    candidate: true,
    nature: Nature { every_turn: Some(1.0), ..Nature::PLAIN },
    basis: |context, _| {
        let per_micrometre =
            context.machine.delta_per_rad() * 2.0 / (1000.0 * context.machine.grating.diameter_mm);
        let index = Some((Covariate::GratingIndex, 1.0));
        Ok(indexed(Run::Spindle { order: 1.0 }, per_micrometre, index))
    },
};
