//! The lever between motor and table has another ratio than it should.
//!
//! ```text
//! δ = (1 − g)·c
//!
//! δ, c commanded, in µm    g true ratio over nominal
//! ```
//!
//! g = 0.95 over a stroke of 30 µm leaves 1.5 µm. The lever's tangent adds c·(u/R)²/3, with the slide
//! off its middle by u and an arm R: below 3 nm at the end of the stroke, which rules it out.

use super::shape::polynomial;
use crate::machine::Part;
use crate::units::NUMBER;
use crate::{Basis, Card, Covariate, Entry, Nature, Parameter};

pub(super) const CARD: Card = Card {
    kind: "lever-ratio",
    entry: Entry::Actuator,
    summary: "the lever between motor and table has another ratio than it should",
    formula: "(1 − g)·c, c commanded travel",
    example: "g = 0.95, 30 µm: 1.5 µm",
    parameters: &[Parameter::linear("gain", NUMBER, "true ratio over nominal")
        .within(0.5..=1.5)
        .or(1.0)],
    parts: &[Part::Drive],
    needs: &["steps"],
    signature: "the counter shows more or fewer steps than the error is worth",
    confused_with: &["lost-steps"],
    separated_by: "make a known number of steps and measure the table",
    source: "geometry of the lever",
    random: false,
    candidate: true,
    nature: Nature::PLAIN,
    basis: |context, _| {
        let step_um = context.machine.drive.step_um;
        let commanded = move |now: &crate::Instant<'_>| step_um * now.covariate(Covariate::Steps);
        let mut basis = Basis::one(polynomial(move |now| -commanded(now)));
        basis.fixed = Some(Box::new(polynomial(commanded)));
        Ok(basis)
    },
};
