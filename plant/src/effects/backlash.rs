//! The drive has lost motion, which the table takes up at a reversal.
//!
//! ```text
//! δ = b·d/2
//!
//! δ, b width in µm    d direction, +1 or −1
//! ```
//!
//! A pass in one direction hides it in its zero; a reversal inside the pass shows all of b.

use super::shape::polynomial;
use crate::units::UM;
use crate::{Basis, Card, Entry, Nature, Parameter};

pub(super) const CARD: Card = Card {
    kind: "backlash",
    entry: Entry::Motion,
    summary: "the drive has lost motion, which shows at a reversal",
    formula: "b·d/2",
    example: "b = 4 µm: +2 µm forward, −2 µm in reverse",
    parameters: &[Parameter::linear("width", UM, "lost motion").within(-200.0..=200.0)],
    parts: &[],
    needs: &[],
    signature: "a jump at each reversal inside a pass",
    confused_with: &["wind-up"],
    separated_by: "reverse inside one pass; vary the load: backlash does not care",
    source: "kinematics; the sign is that of the entry: forward is ahead",
    random: false,
    candidate: true,
    nature: Nature { at_reversal: true, ..Nature::PLAIN },
    basis: |_, _| Ok(Basis::one(polynomial(|now| now.direction / 2.0))),
};
