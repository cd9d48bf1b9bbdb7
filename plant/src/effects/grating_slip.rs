//! The grating channel counts lines twice, or loses some.
//!
//! ```text
//! δ = k·S/M·[t ≥ t₀]
//!
//! δ in µm    S lead in µm    M lines    k lines counted too many, a whole number    t₀ moment
//! ```
//!
//! One line at 6 mm and 13906 lines is 0.431 µm, for good; on a rotary chain 360°/M.

use super::shape::{rough, since};
use crate::machine::Part;
use crate::units::{NUMBER, S};
use crate::{Basis, Card, Entry, Nature, Parameter, Search};

pub(super) const CARD: Card = Card {
    kind: "grating-slip",
    entry: Entry::AngleReference,
    summary: "the grating channel counts lines twice, or loses some",
    formula: "k·S/M·[t ≥ t₀]",
    example: "k = 1, S = 6 mm, M = 13906: 0.431 µm from then on",
    parameters: &[
        Parameter::linear("count", NUMBER, "how many, a whole number").within(-1000.0..=1000.0),
        Parameter::nonlinear("time", S, Search::Time, "when").within(0.0..=1e7),
    ],
    parts: &[Part::Grating],
    needs: &[],
    signature: "a step for good at one moment",
    confused_with: &["fringe-slip", "lost-steps"],
    separated_by: "vary S: the size goes with it",
    source: "document 1, counting channels",
    random: false,
    candidate: true,
    nature: Nature::PLAIN,
    basis: |context, nonlinear| {
        let time_s = nonlinear[0];
        let size_um = context.machine.delta_per_rad() * std::f64::consts::TAU
            / f64::from(context.machine.grating.lines);
        Ok(Basis::one(rough(move |now| size_um * since(time_s, now))))
    },
};
