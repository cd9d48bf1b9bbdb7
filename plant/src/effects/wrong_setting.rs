//! A thumb wheel, the lead, or the line count is not what the machine file says.
//!
//! ```text
//! δ = x·10⁶·((M′/M)·(A/A′)·(S/S′) − B/B′)
//!
//! δ in µm    x travel in m    primed: what the machine really has
//! ```
//!
//! 1000 lines taken for 1024 are −23 437.5 µm/m. It is a setting, not physics: put it right instead of
//! modelling it. What is left out is as the file says.

use super::shape::polynomial;
use crate::units::{MM, NUMBER};
use crate::{Basis, Card, Entry, Parameter, Search};

pub(super) const CARD: Card = Card {
    kind: "wrong-setting",
    entry: Entry::AngleReference,
    summary: "a thumb wheel, the lead, or the line count is not what the file says",
    formula: "x·10⁶·((M′/M)·(A/A′)·(S/S′) − B/B′)",
    example: "M 1024 in the file, M′ 1000: −23 437.5 µm/m",
    parameters: &[
        Parameter::nonlinear("a", NUMBER, Search::Fixed, "true grating divider")
            .within(0.0..=999.0)
            .or(0.0),
        Parameter::nonlinear("b", NUMBER, Search::Fixed, "true laser divider")
            .within(0.0..=999.0)
            .or(0.0),
        Parameter::nonlinear("lines", NUMBER, Search::Fixed, "true line count")
            .within(0.0..=1e7)
            .or(0.0),
        Parameter::nonlinear("lead", MM, Search::Fixed, "true lead").within(0.0..=1000.0).or(0.0),
    ],
    needs: &[],
    signature: "a slope of a small-integer ratio, far beyond physics",
    confused_with: &["screw-progressive", "cosine"],
    separated_by: "read the wheels; compare the slope with ratios such as 1000/1024 or 127/126",
    source: "arithmetic of the channels",
    random: false,
    candidate: false,
    basis: |context, nonlinear| {
        let machine = context.machine;
        let ratio = |value: f64, says: f64| if value == 0.0 { 1.0 } else { value / says };
        let a = ratio(nonlinear[0], f64::from(machine.dividers.a));
        let b = ratio(nonlinear[1], f64::from(machine.dividers.b));
        let lines = ratio(nonlinear[2], f64::from(machine.grating.lines));
        let lead = ratio(nonlinear[3], machine.workpiece.lead.mm());
        let slope = 1e6 * (lines / (a * lead) - 1.0 / b);
        Ok(Basis::fixed(polynomial(move |now| slope * now.position_m())))
    },
};
