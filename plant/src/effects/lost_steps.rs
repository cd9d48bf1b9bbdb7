//! The motor loses steps: the counter and the table disagree from then on.
//!
//! ```text
//! δ = k·step·[t ≥ t₀]
//!
//! δ, step in µm    k steps lost, a whole number    t₀ moment
//! ```
//!
//! 40 steps of 0.0125 µm are 0.5 µm. The closed loop makes them up, and the counter shows it.

use super::shape::{rough, since};
use crate::machine::Part;
use crate::units::{NUMBER, S};
use crate::{Basis, Card, Entry, Nature, Parameter, Search};

pub(super) const CARD: Card = Card {
    kind: "lost-steps",
    entry: Entry::Actuator,
    summary: "the motor loses steps, and the counter no longer tells the table",
    formula: "k·step·[t ≥ t₀]",
    example: "k = 40, step 0.0125 µm: 0.5 µm",
    parameters: &[
        Parameter::linear("count", NUMBER, "how many, a whole number").within(-1000.0..=1000.0),
        Parameter::nonlinear("time", S, Search::Time, "when").within(0.0..=1e7),
    ],
    parts: &[Part::Drive],
    needs: &[],
    signature: "a step for good at one moment",
    confused_with: &["corrector-lost-motion", "fringe-slip"],
    separated_by: "play back to zero: the table does not come home",
    source: "document 1, counting channels",
    random: false,
    candidate: true,
    nature: Nature::PLAIN,
    basis: |context, nonlinear| {
        let time_s = nonlinear[0];
        let size_um = context.machine.drive.step_um;
        Ok(Basis::one(rough(move |now| size_um * since(time_s, now))))
    },
};
