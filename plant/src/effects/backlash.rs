//! The drive has lost motion, which the table takes up at a reversal.
//!
//! ```text
//! δ = b·d/2                      s₀ ≤ s, and before any reversal
//! δ = b·d·(s/s₀ − 1/2)           s < s₀
//!
//! δ, b width in µm    d direction, +1 or −1    s way since the reversal, s₀ way to take it up, in mm
//! ```
//!
//! On a rotary chain δ is in seconds of arc, and s and s₀ are in degrees of the output.
//!
//! A pass in one direction hides it in its zero; a reversal inside the pass shows all of b. Rigid parts
//! take it up over b itself, so that a drive of little play jumps, and a joint of degrees does not. How a
//! pass begins is in no log: with the play taken up, as the one before left it, or as behind a turn.

use super::shape::{PASS_START, banded, behind_turn_mm};
use crate::units::{MM, UM};
use crate::{Basis, Card, Entry, Nature, Parameter, Search, Smoothness};

pub(super) const CARD: Card = Card {
    kind: "backlash",
    entry: Entry::Motion,
    summary: "the drive has lost motion, which shows at a reversal",
    formula: "b·d·(min(s/s₀, 1) − 1/2), s way since the reversal (degrees on a rotary chain)",
    example: "b = 4 µm: +2 µm forward, −2 µm in reverse",
    parameters: &[
        Parameter::linear("width", UM, "lost motion").within(-200.0..=200.0),
        Parameter::nonlinear("way", MM, Search::Logarithmic, "way to take it up, 0 at once")
            .within(0.0..=1000.0)
            .or(0.0)
            .of_way(),
        PASS_START,
    ],
    parts: &[],
    needs: &[],
    signature: "a jump, or a ramp, behind each reversal inside a pass",
    confused_with: &["wind-up"],
    separated_by: "reverse inside one pass; vary the load: backlash does not care",
    source: "kinematics; the sign is that of the entry: forward is ahead",
    random: false,
    candidate: true,
    nature: Nature { at_reversal: true, ..Nature::PLAIN },
    basis: |_, nonlinear| {
        let (way_mm, pass_start) = (nonlinear[0], nonlinear[1]);
        let taken_up = banded(
            move |now| {
                let gone_mm = behind_turn_mm(now, pass_start);
                let share = if gone_mm < way_mm { gone_mm / way_mm } else { 1.0 };
                now.direction * (share - 0.5)
            },
            move |_, _| if 0.0 < way_mm { Smoothness::Rough } else { Smoothness::Polynomial },
        );
        Ok(Basis::one(taken_up))
    },
};
