//! High pressure makes dense air: the wavelength shrinks, and the laser counts too many fringes.
//!
//! ```text
//! δ = x·10⁶·(1 − n/n_ref) ≈ −0.268·x·Δp[hPa]
//!
//! δ in µm    x travel in m    n refractive index after Ciddor, n_ref that of the reference air
//! ```
//!
//! 1 m and 1 hPa are −0.268 µm. Physics fixes the coefficient; only 2 % are left to a fit.

use super::air_index::AirIndex;
use super::shape::polynomial;
use crate::machine::Part;
use crate::{Basis, Card, Entry, Nature, Parameter};

pub(super) const CARD: Card = Card {
    kind: "air-pressure",
    entry: Entry::LengthReference,
    summary: "high pressure makes dense air, so the laser counts too many fringes",
    formula: "x·10⁶·(1 − n/n_ref) ≈ −0.268·x·Δp[hPa], n after Ciddor",
    example: "1 m and 1 hPa are −0.268 µm",
    parameters: &[Parameter::known(0.02, "factor on the physics")],
    parts: &[Part::Table, Part::Laser],
    needs: &["air_pressure_hpa"],
    signature: "follows x times the logged air pressure",
    confused_with: &[
        "air-temperature",
        "air-humidity",
        "cosine",
        "workpiece-expansion",
        "screw-progressive",
    ],
    separated_by: "log the barometer over a change of the weather",
    source: "Ciddor, Applied Optics 35 (1996) 1566",
    random: false,
    candidate: true,
    nature: Nature::PLAIN,
    basis: |context, _| {
        let index = AirIndex::of(&context.machine.laser);
        Ok(Basis::one(polynomial(move |now| now.position_m() * index.for_pressure(now))))
    },
};
