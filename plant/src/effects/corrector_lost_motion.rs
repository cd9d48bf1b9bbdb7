//! The corrector's drive has play: a reversal of the motor moves nothing until it is taken up.
//!
//! ```text
//! δ = c − y,  y the output of a play of width w with input c
//!
//! δ, c commanded, y reached, w in µm
//! ```
//!
//! w = 0.1 µm is 8 steps of 0.0125 µm that a reversal loses; the loop hunts that much wider.

use crate::machine::Part;
use crate::units::UM;
use crate::{
    Basis, Card, Covariate, Effect, Entry, Instant, Nature, Parameter, Play, Record, Search,
};

pub(super) const CARD: Card = Card {
    kind: "corrector-lost-motion",
    entry: Entry::Actuator,
    summary: "the corrector's drive has play, which a reversal of the motor has to take up",
    formula: "c − y, y the output of a play of width w",
    example: "w = 0.1 µm: ±0.05 µm by the last direction",
    parameters: &[
        Parameter::nonlinear("width", UM, Search::Logarithmic, "play").within(0.005..=20.0)
    ],
    parts: &[Part::Drive],
    needs: &["steps"],
    signature: "the counter runs ahead of the table by the play after each reversal",
    confused_with: &["lost-steps", "backlash"],
    separated_by: "make known steps with the table locked",
    source: "play operator of hysteresis theory",
    random: false,
    candidate: true,
    nature: Nature { play: true, ..Nature::PLAIN },
    basis: |context, nonlinear| {
        let step_um = context.machine.drive.step_um;
        Ok(Basis::fixed(LostMotion { width_um: nonlinear[0], step_um }))
    },
};

#[derive(Debug)]
struct LostMotion {
    width_um: f64,
    step_um: f64,
}

impl Effect for LostMotion {
    /// Nothing: play has a memory, which the [`crate::Actuator`] keeps in a run.
    fn delta_um(&self, _: &Instant<'_>) -> f64 {
        0.0
    }

    fn deltas_um(&self, record: &Record) -> Vec<f64> {
        let mut play = Play::new(self.width_um);
        let steps = record.instants().map(|now| now.covariate(Covariate::Steps));
        steps
            .map(|steps| {
                let commanded_um = steps * self.step_um;
                if commanded_um.is_nan() { 0.0 } else { commanded_um - play.follow(commanded_um) }
            })
            .collect()
    }

    fn remembers(&self) -> bool {
        true
    }
}
