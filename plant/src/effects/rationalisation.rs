//! The dividers stand for a rational number of fringes, the laser has another.
//!
//! ```text
//! δ = x·10⁶·(M·B·λ/(2·S·A) − 1)
//!
//! δ in µm    x travel in m    M lines    A, B dividers    λ wavelength, S lead, in the same unit
//! ```
//!
//! A 110, B 150 at 6 mm, 13906 lines and λ = 0.63281983 µm leave −0.846 µm/m. It follows from the
//! machine file and is always in the prediction; as an effect of its own it adds nothing.

use crate::machine::Part;
use crate::{Basis, Card, Entry, Nature};

pub(super) const CARD: Card = Card {
    kind: "rationalisation",
    entry: Entry::LengthReference,
    summary: "the dividers stand for a rational number of fringes, the laser has another",
    formula: "x·10⁶·(M·B·λ/(2·S·A) − 1)",
    example: "A 110, B 150, S 6 mm, M 13906, λ 0.63281983 µm: −0.846 µm/m",
    parameters: &[],
    parts: &[Part::Table, Part::Dividers],
    needs: &[],
    signature: "a slope over travel that follows from the machine file",
    confused_with: &["cosine"],
    separated_by: "metric against module track",
    source: "document 1, decimal rationalisation",
    random: false,
    candidate: false,
    nature: Nature::PLAIN,
    basis: |_, _| Ok(Basis::default()),
};
