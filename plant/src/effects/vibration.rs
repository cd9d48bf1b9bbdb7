//! Something near the machine shakes the table.
//!
//! ```text
//! δ(t) = a·sin(2π·f·t + φ)
//!
//! δ, a in µm    f in Hz    t time since the start of the record, in s    φ phase at t = 0
//! ```
//!
//! The recorder samples at the comparison frequency fφ = M/A·n/60, so it shows the alias
//! |f − k·fφ|, which moves with the speed n: 25 Hz at fφ = 12.64 Hz shows at 0.28 Hz.

use super::wave::{Run, pair};
use crate::units::{HZ, UM};
use crate::{Card, Entry, Nature, Parameter, Search};

pub(super) const CARD: Card = Card {
    kind: "vibration",
    entry: Entry::Motion,
    summary: "something near the machine shakes the table",
    formula: "a·sin(2π·f·t + φ)",
    example: "25 Hz sampled at 12.64 Hz shows at 0.28 Hz",
    parameters: &[
        Parameter::amplitude("amplitude", UM, "half the swing").within(0.0..=100.0),
        Parameter::phase("phase", "phase at the start of the record"),
        Parameter::nonlinear("frequency", HZ, Search::Logarithmic, "frequency of the shaking")
            .within(1e-3..=1e4),
    ],
    parts: &[],
    needs: &[],
    signature: "a line at a fixed frequency, or its alias, whatever the spindle does",
    confused_with: &["gear-error", "screw-periodic"],
    separated_by: "change the speed n: an order stays with the spindle, a frequency does not",
    source: "sampling theorem; document 1, filter: fφ = M/A·n/60",
    random: false,
    candidate: true,
    nature: Nature::PLAIN,
    basis: |_, nonlinear| Ok(pair(Run::Time { hz: nonlinear[0] }, 1.0)),
};
