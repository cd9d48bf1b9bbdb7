//! The workpiece sags between its steady rests.
//!
//! ```text
//! δ(x) = a·sin²(π·x/p)
//!
//! δ, a in µm    x travel, p spacing of the rests, in mm; a rest stands at x = 0
//! ```
//!
//! a = 1 µm at rests every 250 mm: 1 µm in the middle between two, 0 at each.

use std::f64::consts::TAU;

use super::shape::banded;
use crate::machine::Part;
use crate::units::{MM, UM};
use crate::{Basis, Card, Entry, Nature, Parameter, Search, Smoothness};

pub(super) const CARD: Card = Card {
    kind: "steady-sag",
    entry: Entry::Workpiece,
    summary: "the workpiece sags between its steady rests",
    formula: "a·sin²(π·x/p)",
    example: "a = 1 µm, p = 250 mm: 1 µm at x = 125 mm",
    parameters: &[
        Parameter::linear("amplitude", UM, "between two rests").within(-100.0..=100.0),
        Parameter::nonlinear("spacing", MM, Search::Logarithmic, "from rest to rest")
            .within(20.0..=2000.0),
    ],
    parts: &[Part::Workpiece],
    needs: &[],
    signature: "a wave over travel on the thread only, as long as the rests are apart",
    confused_with: &["screw-progressive", "screw-wear"],
    separated_by: "move a steady rest: the wave moves",
    source: "shape by engineering judgement, zero at the rests",
    random: false,
    candidate: true,
    nature: Nature::PLAIN,
    basis: |_, nonlinear| {
        let spacing_mm = nonlinear[0];
        let sag = banded(
            move |now| (1.0 - libm::cos(TAU * now.position_mm / spacing_mm)) / 2.0,
            move |_, travel_mm_s| Smoothness::Band {
                amplitude_um: 0.5,
                rate_per_s: TAU * travel_mm_s / spacing_mm,
            },
        );
        Ok(Basis::one(sag))
    },
};
