//! The workpiece sits off the axis, or bent, in its clamping.
//!
//! ```text
//! δ(θ) = a₁·sin(θ + φ₁) + a₂·sin(2θ + φ₂)
//!
//! δ, a in µm    θ spindle angle, φ phases
//! ```
//!
//! It is ground into the thread, and neither recorder nor counter sees it: 1 µm is 1 µm on the thread.

use super::wave::{Run, indexed};
use crate::machine::Part;
use crate::units::UM;
use crate::{Basis, Card, Covariate, Entry, Nature, Parameter};

pub(super) const CARD: Card = Card {
    kind: "clamping-runout",
    entry: Entry::Workpiece,
    summary: "the workpiece sits off the axis, or bent, in its clamping",
    formula: "a₁·sin(θ + index + φ₁) + a₂·sin(2·(θ + index) + φ₂)",
    example: "a₁ = 1 µm: 1 µm at a quarter turn, on the thread only",
    parameters: &[
        Parameter::amplitude("amplitude1", UM, "once a turn").within(0.0..=100.0),
        Parameter::phase("phase1", "its phase at spindle angle 0"),
        Parameter::amplitude("amplitude2", UM, "twice a turn").within(0.0..=100.0).or(0.0),
        Parameter::phase("phase2", "its phase at spindle angle 0"),
    ],
    parts: &[Part::Workpiece],
    needs: &[],
    signature: "one and two waves per turn on the thread, none on the recorder",
    confused_with: &["grating-eccentricity"],
    separated_by: "clamp the workpiece anew, turned by 180° (clamping_index_deg)",
    source: "geometry of the drunken thread",
    random: false,
    candidate: true,
    nature: Nature::PLAIN,
    basis: |_, _| {
        let wave = |order| {
            let index = Some((Covariate::ClampingIndex, order));
            indexed(Run::Spindle { order }, 1.0, index).columns
        };
        let columns = [1.0, 2.0].into_iter().flat_map(wave).collect();
        Ok(Basis { columns, fixed: None })
    },
};
