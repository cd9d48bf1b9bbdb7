//! The machine's screw is worn or knocked at one place.
//!
//! ```text
//! δ(x) = h·exp(−(x − x₀)²/2w²)
//!
//! δ, h in µm    x travel, x₀ place, w width (standard deviation of the bump), in mm
//! ```
//!
//! A bump of 2 µm, 30 mm wide, is 1.21 µm high 30 mm beside its middle.

use super::shape::banded;
use crate::machine::Part;
use crate::units::{MM, UM};
use crate::{Basis, Card, Entry, Nature, Parameter, Search, Smoothness};

pub(super) const CARD: Card = Card {
    kind: "screw-wear",
    entry: Entry::Motion,
    summary: "the machine's screw is worn or knocked at one place",
    formula: "h·exp(−(x − x₀)²/2w²)",
    example: "h = 2 µm, w = 30 mm: 1.213 µm at 30 mm from its middle",
    parameters: &[
        Parameter::linear("height", UM, "height of the bump").within(-100.0..=100.0),
        Parameter::nonlinear("position", MM, Search::Position, "place of its middle")
            .within(-1e4..=1e4),
        Parameter::nonlinear("width", MM, Search::Logarithmic, "its standard deviation")
            .within(0.5..=500.0),
    ],
    parts: &[Part::Table],
    needs: &[],
    signature: "a bump at one place, the same in every pass",
    confused_with: &["screw-progressive", "steady-sag"],
    separated_by: "repeat the pass: a bump stays at its place, a knock does not come again",
    source: "engineering judgement: wear is where the machine works most",
    random: false,
    candidate: true,
    nature: Nature::PLAIN,
    basis: |_, nonlinear| {
        let (position_mm, width_mm) = (nonlinear[0], nonlinear[1]);
        let bump = banded(
            move |now| {
                let off = (now.position_mm - position_mm) / width_mm;
                libm::exp(-off * off / 2.0)
            },
            // Derivative k of the bell is below 1.09·√k!, which is 2.32¹² at the twelfth.
            move |_, travel_mm_s| Smoothness::Band {
                amplitude_um: 1.0,
                rate_per_s: 2.32 * travel_mm_s / width_mm,
            },
        );
        Ok(Basis::one(bump))
    },
};
