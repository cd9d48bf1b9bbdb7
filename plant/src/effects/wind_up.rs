//! Force winds the drive up; after a reversal it has to slide some way to wind up again.
//!
//! ```text
//! δ = d·F·c·(1 − 2·exp(−s/s₀))     s way since the reversal inside the pass
//! δ = d·F·c                        before any
//!
//! δ in µm    d direction    F force in N    c compliance in µm/N    s₀ sliding distance in mm
//! ```
//!
//! On a rotary chain δ is in seconds of arc, and s and s₀ are in degrees of the output.
//!
//! 0.01 µm/N under 100 N is 1 µm, and 2 µm from one direction to the other.

use super::shape::{PASS_START, banded, behind_turn_mm};
use crate::units::{MM, UM_PER_N};
use crate::{Basis, Card, Covariate, Entry, Nature, Parameter, Search, Smoothness};

pub(super) const CARD: Card = Card {
    kind: "wind-up",
    entry: Entry::Motion,
    summary: "force winds the drive up, and a reversal has to wind it up again",
    formula: "d·F·c·(1 − 2·exp(−s/s₀)), s way since the reversal (degrees on a rotary chain)",
    example: "c = 0.01 µm/N, F = 100 N: ±1 µm by direction",
    parameters: &[
        Parameter::linear("compliance", UM_PER_N, "travel per force").within(-1.0..=1.0),
        Parameter::nonlinear("sliding_distance", MM, Search::Logarithmic, "way to wind up again")
            .within(0.01..=50.0)
            .or(1.0)
            .of_way(),
        PASS_START,
    ],
    parts: &[],
    needs: &["force_n"],
    signature: "follows the logged force, with its sign turned by the direction",
    confused_with: &["backlash", "grinding-force"],
    separated_by: "vary the load: wind-up grows with it, backlash does not",
    source: "pre-sliding friction after Dahl, to its first exponential",
    random: false,
    candidate: true,
    nature: Nature::PLAIN,
    basis: |_, nonlinear| {
        let (sliding_mm, pass_start) = (nonlinear[0], nonlinear[1]);
        let wound = banded(
            move |now| {
                let left = libm::exp(-behind_turn_mm(now, pass_start) / sliding_mm);
                now.direction * now.covariate(Covariate::Force) * (1.0 - 2.0 * left)
            },
            // The force is part of the amplitude; 1e5 N is the most a file may say.
            move |_, travel_mm_s| Smoothness::Band {
                amplitude_um: 2e5,
                rate_per_s: travel_mm_s / sliding_mm,
            },
        );
        Ok(Basis::one(wound))
    },
};
