//! The beam is not parallel to the travel.
//!
//! ```text
//! δ = x·(1 − cos α) = ½·10⁶·x·α²
//!
//! δ in µm    x travel in m    α angle in rad
//! ```
//!
//! 1 mrad over 1 m is 0.5 µm. The laser reads short, so the thread comes out long.

use super::shape::polynomial;
use crate::machine::Part;
use crate::units::MRAD;
use crate::{Basis, Card, Entry, Nature, Parameter};

pub(super) const CARD: Card = Card {
    kind: "cosine",
    entry: Entry::LengthReference,
    summary: "the beam is not parallel to the travel",
    formula: "½·10⁶·x·α²",
    example: "α = 1 mrad, x = 1 m: 0.5 µm",
    parameters: &[Parameter::squared("angle", MRAD, "between beam and travel").within(0.0..=30.0)],
    parts: &[Part::Table, Part::Laser],
    needs: &[],
    signature: "a slope over travel, always to the same side",
    confused_with: &["screw-progressive", "air-temperature", "air-pressure", "workpiece-expansion"],
    separated_by: "align the beam anew and repeat",
    source: "geometry",
    random: false,
    candidate: true,
    nature: Nature::PLAIN,
    basis: |_, _| Ok(Basis::one(polynomial(|now| 0.5 * now.position_m()))),
};
