//! Thresholds and supply of the meter drift.
//!
//! ```text
//! δ = r·t
//!
//! δ in µm    r rate in µm/h    t time since the start of the record, in h
//! ```
//!
//! 0.6 µm/h is 0.1 µm in ten minutes.

use super::shape::polynomial;
use crate::units::UM_PER_H;
use crate::{Basis, Card, Entry, Nature, Parameter};

pub(super) const CARD: Card = Card {
    kind: "phase-drift",
    entry: Entry::Electronics,
    summary: "thresholds and supply of the meter drift",
    formula: "r·t",
    example: "r = 0.6 µm/h, 10 min: 0.1 µm",
    parameters: &[
        Parameter::linear("rate", UM_PER_H, "drift of the reading").within(-1000.0..=1000.0)
    ],
    parts: &[],
    needs: &[],
    signature: "a straight drift in time, whatever the travel",
    confused_with: &["headstock-growth", "dead-path", "wheel-wear"],
    separated_by: "put the same signal on both channels",
    source: "engineering judgement",
    random: false,
    candidate: true,
    nature: Nature::PLAIN,
    basis: |_, _| Ok(Basis::one(polynomial(|now| now.time_s / 3600.0))),
};
