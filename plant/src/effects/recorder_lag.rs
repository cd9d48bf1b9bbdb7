//! The recorder follows the error only after a while.
//!
//! ```text
//! τ·dy/dt + y = e,   δ = y − e
//!
//! δ, y what is recorded, e error at the meter, in µm    τ time constant in s
//! ```
//!
//! A record may begin while it follows: its passes then begin with a δ of their own, which dies away
//! as `δ₀·exp(−(t − t₀)/τ)`.
//!
//! A ramp of 0.1 µm/s through τ = 2 s reads 0.2 µm behind. The loop does not go through the recorder,
//! so it leaves table and counter alone: in a run it is [`crate::Model::recorder_lags_s`].

use crate::units::S;
use crate::{Basis, Card, Effect, Entry, Instant, LowPass, Nature, Parameter, Record, Search};

pub(super) const CARD: Card = Card {
    kind: "recorder-lag",
    entry: Entry::Electronics,
    summary: "the recorder follows the error only after a while",
    formula: "τ·dy/dt + y = e, δ = y − e",
    example: "τ = 2 s, ramp 0.1 µm/s: −0.2 µm",
    parameters: &[Parameter::nonlinear("time_constant", S, Search::Logarithmic, "of the recorder")
        .within(0.01..=1000.0)],
    parts: &[],
    needs: &[],
    signature: "waves come smaller and later the faster the spindle turns",
    confused_with: &["screw-periodic"],
    separated_by: "repeat at a second speed",
    source: "first-order lag",
    random: false,
    candidate: true,
    nature: Nature { delays: true, ..Nature::PLAIN },
    basis: |_, nonlinear| Ok(Basis::fixed(Lag { time_constant_s: nonlinear[0] })),
};

#[derive(Debug)]
struct Lag {
    time_constant_s: f64,
}

impl Effect for Lag {
    /// Nothing: a recorder has a memory, and it is not part of the machine.
    fn delta_um(&self, _: &Instant<'_>) -> f64 {
        0.0
    }

    fn deltas_um(&self, record: &Record) -> Vec<f64> {
        let mut deltas = Vec::with_capacity(record.len());
        for rows in record.passes() {
            let mut recorder = LowPass::new(self.time_constant_s);
            let shown = record.time_s[rows.clone()].iter().zip(&record.error_um[rows]);
            deltas.extend(shown.map(|(time_s, error)| recorder.next(*time_s, *error) - error));
        }
        deltas
    }

    fn remembers(&self) -> bool {
        true
    }

    fn feeds_back(&self) -> bool {
        true
    }

    fn started(&self, pass: usize) -> Option<Box<dyn Effect>> {
        Some(Box::new(Start { time_constant_s: self.time_constant_s, pass }))
    }
}

/// What is left of a pass's first δ, 1 µm.
#[derive(Debug)]
struct Start {
    time_constant_s: f64,
    pass: usize,
}

impl Effect for Start {
    /// Nothing, as above.
    fn delta_um(&self, _: &Instant<'_>) -> f64 {
        0.0
    }

    fn deltas_um(&self, record: &Record) -> Vec<f64> {
        let mut deltas = vec![0.0; record.len()];
        for rows in record.passes().into_iter().filter(|rows| record.pass[rows.start] == self.pass)
        {
            let first_s = record.time_s[rows.start];
            for row in rows {
                let elapsed_s = record.time_s[row] - first_s;
                deltas[row] = libm::exp(-elapsed_s / self.time_constant_s);
            }
        }
        deltas
    }

    /// What the recorder shows goes through it no other time.
    fn feeds_back(&self) -> bool {
        true
    }
}
