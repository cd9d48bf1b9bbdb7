//! Below a critical speed the table sticks and slips.
//!
//! ```text
//! δ = J·(½ − frac(x/J)),  J = j·(1 − n/n_c)  below n_c, else 0
//!
//! δ, J, x in µm    j jump at standstill    n spindle speed, n_c critical speed, in rpm
//! ```
//!
//! The drive goes on while the table sticks: δ falls as the travel grows, until the table jumps by J.
//! Jumps are far shorter than the way between two comparisons, so a recorder shows them as scatter of
//! J/√12 that is gone above `n_c`.
//!
//! It is not named from data: scatter has no course of its own, and electrical noise or vibration
//! may change with the speed as well. A pass above `n_c` tells it.

use super::shape::rough;
use crate::units::{RPM, UM};
use crate::{Basis, Card, Entry, Nature, Parameter, Search};

pub(super) const CARD: Card = Card {
    kind: "stick-slip",
    entry: Entry::Motion,
    summary: "below a critical speed the table sticks and slips",
    formula: "J·(½ − frac(x/J)), J = j·(1 − n/n_c) below n_c",
    example: "j = 2 µm, n = n_c/2: a sawtooth of 1 µm, 0.29 µm rms",
    parameters: &[
        Parameter::nonlinear("jump", UM, Search::Fixed, "jump at the lowest speed")
            .within(0.01..=100.0),
        Parameter::nonlinear("critical_speed", RPM, Search::Fixed, "above it the table slides")
            .within(0.01..=1000.0),
    ],
    parts: &[],
    needs: &[],
    signature: "scatter below a certain speed",
    confused_with: &["fringe-slip", "vibration", "turbulence"],
    separated_by: "raise the speed n: above the critical one the scatter is gone for good, and comes back below",
    source: "relaxation oscillation of a sliding mass, drive slow against the jump",
    random: true,
    candidate: true,
    nature: Nature::PLAIN,
    basis: |_, nonlinear| {
        let (jump_um, critical_rpm) = (nonlinear[0], nonlinear[1]);
        let sawtooth = rough(move |now| {
            let height_um = jump_um * (1.0 - now.speed_rpm / critical_rpm);
            if height_um <= 0.0 {
                return 0.0;
            }
            let turns = 1000.0 * now.position_mm / height_um;
            height_um * (0.5 - (turns - turns.floor()))
        });
        Ok(Basis::fixed(sawtooth))
    },
};
