//! A wheel of the gear train runs out, or its teeth do not mesh evenly.
//!
//! ```text
//! δ(θ) = a·sin(o·θ + φ)
//!
//! δ, a in µm    θ spindle angle in rad    o order: turns of the shaft, or teeth, per spindle turn
//! ```
//!
//! A wheel of 48 teeth on a shaft of order 2.5 shows at 2.5 and, by its teeth, at 120.

use super::wave::{Run, pair};
use crate::units::{NUMBER, UM};
use crate::{Card, Entry, Nature, Parameter, Search};

pub(super) const CARD: Card = Card {
    kind: "gear-error",
    entry: Entry::Motion,
    summary: "a wheel of the gear train runs out, or its teeth do not mesh evenly",
    formula: "a·sin(o·θ + φ), o order of the shaft, or order × teeth",
    example: "48 teeth on a shaft of order 2.5: lines at 2.5 and 120",
    parameters: &[
        Parameter::amplitude("amplitude", UM, "half the swing").within(0.0..=1000.0),
        Parameter::phase("phase", "phase at spindle angle 0"),
        Parameter::nonlinear("order", NUMBER, Search::GearOrder, "waves per spindle turn")
            .within(1e-6..=1e9),
    ],
    parts: &[],
    needs: &[],
    signature: "a line at the order of a [[gear]], or at its order times its teeth; beside it, overtones",
    confused_with: &["screw-periodic", "grating-graduation", "vibration"],
    separated_by: "swap the gear: the order moves with it",
    source: "kinematics of the train",
    random: false,
    candidate: true,
    nature: Nature::PLAIN,
    basis: |_, nonlinear| Ok(pair(Run::Spindle { order: nonlinear[0] }, 1.0)),
};
