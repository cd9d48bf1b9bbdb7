//! A thumb wheel, the lead, or the line count is not what the machine file says.
//!
//! ```text
//! reading 0   δ = x·10⁶·((M′/M)·(A/A′)·(S/S′) − B/B′)
//! reading 1   δ = x·10⁶·((1 + r)·(M′/M)·(A/A′)·(S/S′) − B/B′ − r)
//! reading 2   δ = x·10⁶·((B′/B)·(1 + r)·(M′/M)·(A/A′) − S′/S − r)
//!
//! δ in µm    x travel in m    primed: what the machine really has    r slope that the file implies
//! ```
//!
//! 1000 lines taken for 1024 are −23 437.5 µm/m. It is a setting, not physics: put it right instead of
//! modelling it. What is left out is as the file says.
//!
//! Reading 0 is to first order in r, which is below 10⁻⁶ where the dividers fit the lead; reading 1 is
//! exact, with x the true travel and the recorder's scale that of the file's B; in reading 2 the
//! travel is worked out from the file's lead, and the scale is that of B′.

use super::shape::polynomial;
use crate::machine::Part;
use crate::rationalisation::implied_um_per_m;
use crate::units::{MM, NUMBER};
use crate::{Basis, Card, Entry, Nature, Parameter, Search};

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
        Parameter::nonlinear(
            "reading",
            NUMBER,
            Search::Fixed,
            "0: to first order, 1: exactly, 2: travel by the file's lead, scale by the true b",
        )
        .within(0.0..=2.0)
        .or(0.0),
    ],
    parts: &[Part::Table, Part::Dividers],
    needs: &[],
    signature: "a slope of a small-integer ratio, far beyond physics",
    confused_with: &["screw-progressive", "cosine"],
    separated_by: "read the wheels; compare the slope with ratios such as 1000/1024 or 127/126",
    source: "arithmetic of the channels",
    random: false,
    candidate: false,
    nature: Nature {
        settings: &[
            ("a", "dividers.a"),
            ("b", "dividers.b"),
            ("lines", "grating.lines"),
            ("lead", "workpiece.lead"),
        ],
        ..Nature::PLAIN
    },
    basis: |context, nonlinear| {
        let machine = context.machine;
        let ratio = |value: f64, says: f64| if value == 0.0 { 1.0 } else { value / says };
        let a = ratio(nonlinear[0], f64::from(machine.dividers.a));
        let b = ratio(nonlinear[1], f64::from(machine.dividers.b));
        let lines = ratio(nonlinear[2], f64::from(machine.grating.lines));
        let lead = ratio(nonlinear[3], machine.workpiece.lead.mm());
        let implied = 1e-6 * implied_um_per_m(machine);
        let read = (1.0 + implied) * lines / a;
        let relative = match nonlinear[4] {
            reading if reading < 0.5 => lines / (a * lead) - 1.0 / b,
            reading if reading < 1.5 => read / lead - 1.0 / b - implied,
            _ => b * read - lead - implied,
        };
        let slope = 1e6 * relative;
        Ok(Basis::fixed(polynomial(move |now| slope * now.position_m())))
    },
};
