//! The workpiece is ground warm and measured at 20 °C.
//!
//! ```text
//! δ = −α·x·(T_w − 20 °C)
//!
//! δ in µm    α expansion in ppm/K, from the machine file    x travel in m    T_w in °C
//! ```
//!
//! Steel of 11.5 ppm/K, 1 m, 2 K too warm: 23 µm too short. Physics fixes the coefficient to 5 %.

use super::shape::polynomial;
use crate::machine::Part;
use crate::{Basis, Card, Covariate, Entry, Nature, Parameter};

pub(super) const CARD: Card = Card {
    kind: "workpiece-expansion",
    entry: Entry::Workpiece,
    summary: "the workpiece is ground warm and measured at 20 °C",
    formula: "−α·x·(T_w − 20 °C)",
    example: "α = 11.5 ppm/K, x = 1 m, 22 °C: −23 µm",
    parameters: &[Parameter::known(0.05, "factor on the physics")],
    parts: &[Part::Workpiece],
    needs: &["workpiece_temperature_c"],
    signature: "follows x times the logged workpiece temperature, on the thread only",
    confused_with: &["wheel-wear", "screw-progressive", "air-temperature"],
    separated_by: "log the workpiece with a contact thermometer",
    source: "definition of thermal expansion; reference temperature of ISO 1",
    random: false,
    candidate: true,
    nature: Nature::PLAIN,
    basis: |context, _| {
        let expansion = context.machine.workpiece.expansion_ppm_per_k;
        Ok(Basis::one(polynomial(move |now| {
            let above_k = now.covariate(Covariate::WorkpieceTemperature) - 20.0;
            -expansion * now.position_m() * above_k
        })))
    },
};
