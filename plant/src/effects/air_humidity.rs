//! Moist air is a little thinner: the laser counts too few fringes.
//!
//! ```text
//! δ = x·10⁶·(1 − n/n_ref) ≈ +0.0085·x·Δ%RH
//!
//! δ in µm    x travel in m    n refractive index after Ciddor, n_ref that of the reference air
//! ```
//!
//! 1 m and 10 % are 0.085 µm. Physics fixes the coefficient; only 2 % are left to a fit.

use super::air_index::AirIndex;
use super::shape::polynomial;
use crate::machine::Part;
use crate::{Basis, Card, Entry, Nature, Parameter};

pub(super) const CARD: Card = Card {
    kind: "air-humidity",
    entry: Entry::LengthReference,
    summary: "moist air is a little thinner, so the laser counts too few fringes",
    formula: "x·10⁶·(n(T, p) − n(T, p, h))/n_ref ≈ +0.0085·x·Δ%RH, n after Ciddor",
    example: "1 m and 10 % are 0.085 µm",
    parameters: &[Parameter::known(0.02, "factor on the physics")],
    parts: &[Part::Table, Part::Laser],
    needs: &["humidity_pct"],
    signature: "follows x times the logged humidity",
    confused_with: &["air-temperature", "air-pressure", "cosine"],
    separated_by: "log it",
    source: "Ciddor, Applied Optics 35 (1996) 1566",
    random: false,
    candidate: true,
    nature: Nature::PLAIN,
    basis: |context, _| {
        let index = AirIndex::of(&context.machine.laser);
        Ok(Basis::one(polynomial(move |now| now.position_m() * index.for_humidity(now))))
    },
};
