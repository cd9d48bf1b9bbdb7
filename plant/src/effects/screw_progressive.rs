//! The machine's screw is too long or too short, more and more along its length.
//!
//! ```text
//! δ(x) = c1·x + c2·x² + c3·x³
//!
//! δ in µm    x travel in m    c1 in µm/m    c2 in µm/m²    c3 in µm/m³
//! ```
//!
//! c1 = 35 µm/m over 1 m: 35 µm at the end, the cumulative error of document 1.

use crate::machine::Part;
use crate::units::{UM_PER_M, UM_PER_M2, UM_PER_M3};
use crate::{Basis, Card, Effect, Entry, Instant, Nature, Parameter, Smoothness};

pub(super) const CARD: Card = Card {
    kind: "screw-progressive",
    entry: Entry::Motion,
    summary: "the machine's screw is too long or too short, more and more along its length",
    formula: "c1·x + c2·x² + c3·x³, x in m",
    example: "c1 = 35 µm/m: 35 µm after 1 m",
    parameters: &[
        Parameter::linear("linear", UM_PER_M, "slope").within(-500.0..=500.0).or(0.0),
        Parameter::linear("quadratic", UM_PER_M2, "bend").within(-1000.0..=1000.0).or(0.0),
        Parameter::linear("cubic", UM_PER_M3, "change of the bend")
            .within(-2000.0..=2000.0)
            .or(0.0),
    ],
    parts: &[Part::Table],
    needs: &[],
    signature: "a smooth curve over travel, the same in every pass",
    confused_with: &["cosine", "air-temperature", "air-pressure", "workpiece-expansion"],
    separated_by: "shift the carriage along the bed, log air and workpiece temperature",
    source: "document 1, results: 30 to 40 µm cumulative error of the machine",
    random: false,
    candidate: true,
    nature: Nature::PLAIN,
    basis: |_, _| {
        let power = |exponent| -> Box<dyn Effect> { Box::new(Power { exponent }) };
        Ok(Basis { columns: [1, 2, 3].map(power).into(), fixed: None })
    },
};

/// Travel in m to a power.
#[derive(Debug)]
struct Power {
    exponent: i32,
}

impl Effect for Power {
    fn delta_um(&self, now: &Instant<'_>) -> f64 {
        let position_m = now.position_m();
        (0..self.exponent).fold(1.0, |power, _| power * position_m)
    }

    fn smoothness(&self, _: f64, _: f64) -> Smoothness {
        Smoothness::Polynomial
    }
}
