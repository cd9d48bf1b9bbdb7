//! The beam runs through air before it reaches the table, whatever the travel.
//!
//! ```text
//! δ = D₀·10⁶·(1 − n/n_ref) ≈ D₀·(0.93·ΔT − 0.268·Δp)
//!
//! δ in µm    D₀ dead path in m    ΔT in K, Δp in hPa against the reference air
//! ```
//!
//! 0.3 m and 2 K are 0.57 µm, at the start of the travel as at its end. Pressure counts when it is logged.

use super::air_index::AirIndex;
use super::shape::polynomial;
use crate::machine::Part;
use crate::units::M;
use crate::{Basis, Card, Entry, Nature, Parameter};

pub(super) const CARD: Card = Card {
    kind: "dead-path",
    entry: Entry::LengthReference,
    summary: "the beam runs through air before it reaches the table",
    formula: "D₀·10⁶·(1 − n/n_ref) ≈ D₀·(0.93·ΔT − 0.268·Δp)",
    example: "D₀ = 0.3 m, 2 K: 0.57 µm",
    parameters: &[Parameter::linear("path", M, "beam between interferometer and start of travel")
        .within(-5.0..=5.0)],
    parts: &[Part::Table, Part::Laser],
    needs: &["air_temperature_c"],
    signature: "follows the logged air, whatever the travel",
    confused_with: &["headstock-growth", "phase-drift"],
    separated_by: "dwell with the table locked, and log the air",
    source: "Ciddor, Applied Optics 35 (1996) 1566",
    random: false,
    candidate: true,
    // The air's sensitivities are good to a percent and a half over a day's weather.
    nature: Nature { uncertainty: 0.015, ..Nature::PLAIN },
    basis: |context, _| {
        let index = AirIndex::of(&context.machine.laser);
        Ok(Basis::one(polynomial(move |now| index.for_all(now))))
    },
};
