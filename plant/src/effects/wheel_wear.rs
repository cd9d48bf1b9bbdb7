//! The grinding wheel wears while it works, and is dressed between passes.
//!
//! ```text
//! δ = −w·s
//!
//! δ in µm    w wear in µm/m    s way ground since the start of the pass, in m
//! ```
//!
//! 3 µm/m over 1 m leave the end 3 µm behind. Each pass starts with a dressed wheel.

use super::shape::polynomial;
use crate::machine::Part;
use crate::units::UM_PER_M;
use crate::{Basis, Card, Entry, Nature, Parameter};

pub(super) const CARD: Card = Card {
    kind: "wheel-wear",
    entry: Entry::Workpiece,
    summary: "the grinding wheel wears while it works, and is dressed between passes",
    formula: "−w·s, s way ground since the dressing",
    example: "w = 3 µm/m, 1 m: −3 µm",
    parameters: &[Parameter::linear("rate", UM_PER_M, "wear per way ground").within(-100.0..=100.0)],
    parts: &[Part::Workpiece],
    needs: &[],
    signature: "a slope over the way ground, on the thread only, also in a reverse pass",
    confused_with: &["workpiece-expansion", "headstock-growth"],
    separated_by: "dress the wheel and repeat; grind in reverse",
    source: "engineering judgement: wear goes with the way ground",
    random: false,
    candidate: true,
    nature: Nature::PLAIN,
    basis: |_, _| Ok(Basis::one(polynomial(|now| -now.travelled_mm / 1000.0))),
};
