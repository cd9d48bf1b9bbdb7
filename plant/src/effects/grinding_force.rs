//! The grinding force bends workpiece and wheel apart.
//!
//! ```text
//! δ = c·F
//!
//! δ in µm    c compliance in µm/N    F normal force in N
//! ```
//!
//! 0.01 µm/N under 50 N is 0.5 µm.

use super::shape::polynomial;
use crate::machine::Part;
use crate::units::UM_PER_N;
use crate::{Basis, Card, Covariate, Entry, Nature, Parameter};

pub(super) const CARD: Card = Card {
    kind: "grinding-force",
    entry: Entry::Workpiece,
    summary: "the grinding force bends workpiece and wheel apart",
    formula: "c·F",
    example: "c = 0.01 µm/N, F = 50 N: 0.5 µm",
    parameters: &[
        Parameter::linear("compliance", UM_PER_N, "of workpiece and wheel").within(-1.0..=1.0)
    ],
    parts: &[Part::Workpiece],
    needs: &["force_n"],
    signature: "follows the logged force, on the thread only",
    confused_with: &["workpiece-expansion", "wind-up"],
    separated_by: "grind a spark-out pass without force",
    source: "Hooke's law",
    random: false,
    candidate: true,
    nature: Nature::PLAIN,
    basis: |_, _| Ok(Basis::one(polynomial(|now| now.covariate(Covariate::Force)))),
};
