//! The laser channel loses fringes, or counts some twice.
//!
//! ```text
//! δ = k·λ/2·[t ≥ t₀]
//!
//! δ, λ in µm    k fringes lost, a whole number    t₀ moment
//! ```
//!
//! One fringe is 0.316 µm, for good.

use super::shape::{rough, since};
use crate::machine::Part;
use crate::units::{NUMBER, S};
use crate::{Basis, Card, Entry, Nature, Parameter, Search};

pub(super) const CARD: Card = Card {
    kind: "fringe-slip",
    entry: Entry::LengthReference,
    summary: "the laser channel loses fringes, or counts some twice",
    formula: "k·λ/2·[t ≥ t₀]",
    example: "k = 3: 0.949 µm from then on",
    parameters: &[
        Parameter::linear("count", NUMBER, "how many, a whole number").within(-1000.0..=1000.0),
        Parameter::nonlinear("time", S, Search::Time, "when").within(0.0..=1e7),
    ],
    parts: &[Part::Table, Part::Laser],
    needs: &[],
    signature: "a step for good at one moment",
    confused_with: &["stick-slip", "grating-slip", "lost-steps"],
    separated_by: "return to the start: the error stays; vary S: the size does not",
    source: "document 1, counting channels",
    random: false,
    candidate: true,
    nature: Nature::PLAIN,
    basis: |context, nonlinear| {
        let time_s = nonlinear[0];
        let size_um = context.machine.fringe_um();
        Ok(Basis::one(rough(move |now| size_um * since(time_s, now))))
    },
};
