//! A compensation is on though the machine file says otherwise.
//!
//! ```text
//! δ = ±λ/2·floor(x/(F·λ/2)),  F = 10⁶/|r|
//!
//! δ, x, λ in µm    r rate in µm/m    F fringes between two blocked (+) or inserted (−) pulses
//! ```
//!
//! 10 µm/m is one pulse of 0.316 µm every 31.6 mm.

use super::shape::rough;
use crate::compensation::stairs_um;
use crate::machine::Part;
use crate::units::UM_PER_M;
use crate::{Basis, Card, Entry, Nature, Parameter, Search};

pub(super) const CARD: Card = Card {
    kind: "compensator-staircase",
    entry: Entry::LengthReference,
    summary: "a compensation is on though the machine file says otherwise",
    formula: "±λ/2·floor(x/(F·λ/2)), F = 10⁶/|r|",
    example: "r = 10 µm/m: a step of 0.316 µm every 31.64 mm",
    parameters: &[Parameter::nonlinear(
        "rate",
        UM_PER_M,
        Search::Linear,
        "compensation that is on",
    )
    .within(-100.0..=100.0)],
    parts: &[Part::Table, Part::Dividers],
    needs: &[],
    signature: "stairs of λ/2 over travel",
    confused_with: &["cosine", "screw-progressive"],
    separated_by: "change F: the period of the stairs moves",
    source: "document 1, figure 9",
    random: false,
    candidate: true,
    nature: Nature::PLAIN,
    basis: |context, nonlinear| {
        let (rate, fringe_um) = (nonlinear[0], context.machine.fringe_um());
        let stairs = rough(move |now| stairs_um(rate, fringe_um, now.position_mm));
        Ok(Basis::fixed(stairs))
    },
};
