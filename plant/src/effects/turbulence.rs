//! Air moves in the beam.
//!
//! ```text
//! δ(t) = s·L^0.9·w(t)
//!
//! δ in µm    s strength, µm rms at 1 m    L travel in m    w noise of unit rms, as much in every octave
//! ```
//!
//! w is a sum of 24 sinusoids, evenly spaced in the logarithm from 1 mHz to 10 Hz, each with a phase
//! from the seed: the same seed gives the same air. 0.05 µm at 1 m is 0.027 µm at 0.5 m.
//!
//! It is not named from data. One course of it in one pass is a slow curve, which vibration, drift
//! and the noise of the recorder make as well; what sets it apart, growth with the travel, is the
//! growth of everything that is proportional to the travel. Two dwells tell it.

use std::f64::consts::TAU;

use super::shape::rough;
use crate::machine::Part;
use crate::units::{NUMBER, UM};
use crate::{Basis, Card, Entry, Nature, Parameter, Search};

pub(super) const CARD: Card = Card {
    kind: "turbulence",
    entry: Entry::LengthReference,
    summary: "air moves in the beam",
    formula: "s·L^0.9·w(t), w noise of unit rms with a 1/f spectrum",
    example: "s = 0.05 µm: 0.05 µm rms at 1 m, 0.027 µm at 0.5 m",
    parameters: &[
        Parameter::linear("strength", UM, "rms at 1 m").within(0.0..=5.0),
        Parameter::nonlinear("seed", NUMBER, Search::Fixed, "which course it takes")
            .within(0.0..=4_294_967_295.0)
            .or(1.0),
    ],
    parts: &[Part::Table, Part::Laser],
    needs: &[],
    signature: "noise that grows with the travel",
    confused_with: &["vibration"],
    separated_by: "lock the table at either end of its travel and record, then once more with the beam covered: air is the scatter that grows from end to end and goes with the cover",
    source: "growth with L^0.9 and 1/f: measured in workshops, order of magnitude",
    random: true,
    candidate: true,
    nature: Nature::PLAIN,
    basis: |_, nonlinear| {
        let waves = waves(nonlinear[0]);
        Ok(Basis::one(rough(move |now| {
            let sum: f64 =
                waves.iter().map(|(hz, phase)| libm::sin(TAU * (hz * now.time_s + phase))).sum();
            libm::pow(now.position_m().abs(), 0.9) * (2.0 / WAVES).sqrt() * sum
        })))
    },
};

/// Number of sinusoids.
const WAVES: f64 = 24.0;

/// Frequencies in Hz with phases in turns.
fn waves(seed: f64) -> Vec<(f64, f64)> {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 2³² − 1")]
    let mut state = seed as u64;
    (0..24)
        .map(|place| {
            let hz = libm::pow(10.0, -3.0 + 4.0 * f64::from(place) / (WAVES - 1.0));
            (hz, next_turn(&mut state))
        })
        .collect()
}

/// Next number of `SplitMix64` (Steele, Lea, Flood 2014), from 0 to 1.
fn next_turn(state: &mut u64) -> f64 {
    *state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
    let mut bits = *state;
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    bits ^= bits >> 31;
    f64::from(u32::try_from(bits >> 32).unwrap_or_default()) / 4_294_967_296.0
}
