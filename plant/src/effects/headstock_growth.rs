//! The headstock warms up and grows, and carries the interferometer with it.
//!
//! ```text
//! δ(t) = a·(1 − exp(−t/τ))
//!
//! δ, a in µm    t time since the start of the record, τ time constant, in s
//! ```
//!
//! a = 2 µm, τ = 600 s: 1.26 µm after ten minutes, whatever the travel.

use super::shape::banded;
use crate::machine::Part;
use crate::units::{S, UM};
use crate::{Basis, Card, Entry, Nature, Parameter, Search, Smoothness};

pub(super) const CARD: Card = Card {
    kind: "headstock-growth",
    entry: Entry::LengthReference,
    summary: "the headstock warms up and grows",
    formula: "a·(1 − exp(−t/τ))",
    example: "a = 2 µm, τ = t = 600 s: 1.264 µm",
    parameters: &[
        Parameter::linear("amplitude", UM, "growth in the end").within(-200.0..=200.0),
        Parameter::nonlinear("time_constant", S, Search::Logarithmic, "of warming up")
            .within(10.0..=1e5),
    ],
    parts: &[Part::Table],
    needs: &[],
    signature: "a saturating drift in time, whatever the travel",
    confused_with: &["dead-path", "wheel-wear", "phase-drift"],
    separated_by: "start late, when it is warm; grind in reverse",
    source: "first-order warming up",
    random: false,
    candidate: true,
    nature: Nature::PLAIN,
    basis: |_, nonlinear| {
        let constant_s = nonlinear[0];
        let growth = banded(
            move |now| -libm::expm1(-now.time_s / constant_s),
            move |_, _| Smoothness::Band { amplitude_um: 1.0, rate_per_s: 1.0 / constant_s },
        );
        Ok(Basis::one(growth))
    },
};
