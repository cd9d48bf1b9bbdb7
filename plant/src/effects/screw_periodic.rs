//! The machine's screw wobbles once (or k times) a turn of its own.
//!
//! ```text
//! δ(x) = a·sin(2π·k·x/P + φ)
//!
//! δ, a in µm    x travel, P lead of the machine's screw, in mm    k harmonic    φ phase
//! ```
//!
//! a = 1.5 µm at P = 12 mm: 3 µm from peak to peak every 12 mm, which is what document 1 found.

use super::wave::{Run, pair};
use crate::machine::Part;
use crate::units::{NUMBER, UM};
use crate::{Card, EffectError, Entry, Nature, Parameter, Search};

pub(super) const CARD: Card = Card {
    kind: "screw-periodic",
    entry: Entry::Motion,
    summary: "the machine's screw wobbles once a turn of its own, or k times",
    formula: "a·sin(2π·k·x/P + φ), P lead of the machine's screw",
    example: "a = 1.5 µm, P = 12 mm: 3 µm from peak to peak every 12 mm",
    parameters: &[
        Parameter::amplitude("amplitude", UM, "half the wobble").within(0.0..=100.0),
        Parameter::phase("phase", "phase at x = 0"),
        Parameter::nonlinear("harmonic", NUMBER, Search::Whole, "waves per turn of the screw")
            .within(1.0..=12.0)
            .or(1.0),
    ],
    parts: &[Part::Table, Part::LeadScrew],
    needs: &[],
    signature: "a line at a whole multiple of S/P waves per spindle turn, fixed to the travel",
    confused_with: &["grating-eccentricity", "grating-graduation", "gear-error"],
    separated_by: "grind another lead S, or turn the grating disc on its hub: the screw stays",
    source: "document 1, results: 3 µm periodic error of the machine",
    random: false,
    candidate: true,
    // Derived: a screw runs out once a turn, its bearing twice; what is higher is small and comes
    // with those. Doubled: the third to the fifth are as likely as the first.
    nature: Nature { high_harmonic: Some(3.0), ..Nature::PLAIN },
    basis: |context, nonlinear| {
        let turns_per_mm = context.machine.screw_turns_per_mm().ok_or_else(|| {
            EffectError::MissingPart { effect: "screw-periodic".into(), part: Part::LeadScrew }
        })?;
        Ok(pair(Run::Travel { per_mm: nonlinear[0] * turns_per_mm }, 1.0))
    },
};
