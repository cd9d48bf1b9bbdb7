//! The meter swallows pulses that are too narrow, near 0° and 360°.
//!
//! ```text
//! p = frac(m/(r·B) + e/R)·R                     the pulse, R = r·B·λ/2 a whole turn
//! δ = −p  where p < w,   R − p  where R − p < w,   else 0
//!
//! δ, p, e error at the meter, w width, in µm    m initial phase, B divider, r range
//! ```
//!
//! At 180° it is out of sight; at m = 0 and w = 0.5 µm an error of 0.2 µm reads 0.

use super::shape::feedback;
use crate::machine::Part;
use crate::units::UM;
use crate::{Basis, Card, Covariate, Entry, Nature, Parameter, Search};

pub(super) const CARD: Card = Card {
    kind: "meter-dead-zone",
    entry: Entry::Electronics,
    summary: "the meter swallows pulses that are too narrow, near 0° and 360°",
    formula: "−p where p < w, R − p where R − p < w, p pulse as table travel, R a turn",
    example: "m = 0, w = 0.5 µm, e = 0.2 µm: −0.2 µm",
    parameters: &[Parameter::nonlinear(
        "width",
        UM,
        Search::Logarithmic,
        "shortest pulse, as table travel",
    )
    .within(0.01..=20.0)],
    parts: &[Part::Table, Part::Dividers],
    needs: &["initial_phase"],
    signature: "a flat piece near 0° and 360° that moves with the initial phase",
    confused_with: &["fringe-nonlinearity"],
    separated_by: "step the initial phase through a turn",
    source: "document 1, phase meter: two complementary outputs",
    random: false,
    candidate: true,
    nature: Nature::PLAIN,
    basis: |context, nonlinear| {
        let (width_um, turn_um) = (nonlinear[0], context.machine.full_scale_um());
        let fringe_um = context.machine.fringe_um();
        Ok(Basis::fixed(feedback(move |now| {
            let phase_um = now.covariate(Covariate::InitialPhase) * fringe_um;
            let turns = (phase_um + now.error_um) / turn_um;
            let pulse_um = (turns - turns.floor()) * turn_um;
            let gap_um = turn_um - pulse_um;
            if pulse_um < width_um {
                -pulse_um
            } else if gap_um < width_um {
                gap_um
            } else {
                0.0
            }
        })))
    },
};
