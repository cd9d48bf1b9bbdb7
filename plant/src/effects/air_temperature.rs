//! Warm air is thin: the wavelength grows, and the laser counts too few fringes.
//!
//! ```text
//! δ = x·10⁶·(1 − n/n_ref) ≈ +0.93·x·ΔT[K]
//!
//! δ in µm    x travel in m    n refractive index after Ciddor, n_ref that of the reference air
//! ```
//!
//! 1 m and 1 K are 0.95 µm at 50 % humidity. Physics fixes the coefficient; only 2 % are left to a fit.

use super::air_index::AirIndex;
use super::shape::polynomial;
use crate::machine::Part;
use crate::{Basis, Card, Entry, Nature, Parameter};

pub(super) const CARD: Card = Card {
    kind: "air-temperature",
    entry: Entry::LengthReference,
    summary: "warm air is thin, so the laser counts too few fringes",
    formula: "x·10⁶·(n(p) − n(p, T))/n_ref ≈ +0.93·x·ΔT[K]·p/1013, n after Ciddor",
    example: "1 m and 1 K are 0.95 µm at 50 % humidity",
    parameters: &[Parameter::known(0.02, "factor on the physics")],
    parts: &[Part::Table, Part::Laser],
    needs: &["air_temperature_c"],
    signature: "follows x times the logged air temperature",
    confused_with: &[
        "air-pressure",
        "air-humidity",
        "cosine",
        "workpiece-expansion",
        "screw-progressive",
    ],
    separated_by: "log it; soak the shop by 2 K",
    source: "Ciddor, Applied Optics 35 (1996) 1566",
    random: false,
    candidate: true,
    nature: Nature::PLAIN,
    basis: |context, _| {
        let index = AirIndex::of(&context.machine.laser);
        Ok(Basis::one(polynomial(move |now| now.position_m() * index.for_temperature(now))))
    },
};
