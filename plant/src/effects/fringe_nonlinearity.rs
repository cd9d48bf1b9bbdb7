//! Polarisations mix in the interferometer, so that the fringes are not evenly spaced.
//!
//! ```text
//! δ = λ/4π·ε·sin(4π·e/λ + φ)
//!
//! δ, e error at the meter, λ wavelength, in µm    ε mixing ratio    φ phase where e = 0
//! ```
//!
//! φ is where in a fringe the count began: the report's device sets it, an instrument that starts
//! anywhere does not. From pass to pass it counts on.
//! ε = 0.1 is at most 0.005 µm: it matters where everything else has gone.

use std::f64::consts::{FRAC_PI_2, PI};

use super::shape::feedback;
use crate::machine::Part;
use crate::units::NUMBER;
use crate::{Basis, Card, Entry, Nature, Parameter};

pub(super) const CARD: Card = Card {
    kind: "fringe-nonlinearity",
    entry: Entry::LengthReference,
    summary: "polarisations mix, so that fringes are not evenly spaced",
    formula: "λ/4π·ε·sin(4π·e/λ + φ), e error at the meter",
    example: "ε = 0.1, e = λ/8: 0.0050 µm",
    parameters: &[
        Parameter::amplitude("mixing", NUMBER, "ratio of the wrong polarisation").within(0.0..=1.0),
        Parameter::phase("phase", "phase where the error is 0"),
    ],
    parts: &[Part::Table, Part::Laser],
    needs: &[],
    signature: "a ripple over the error itself, every λ/2 of it",
    confused_with: &["meter-dead-zone"],
    separated_by: "sweep the initial phase",
    source: "periodic nonlinearity of homodyne interferometers, first order",
    random: false,
    candidate: true,
    nature: Nature::PLAIN,
    basis: |context, _| {
        let wavelength_um = context.machine.laser.wavelength_um;
        let wave = move |lead_rad: f64| {
            feedback(move |now| {
                let wave_rad = 4.0 * PI * now.error_um / wavelength_um;
                wavelength_um / (4.0 * PI) * libm::sin(wave_rad + lead_rad)
            })
        };
        Ok(Basis::two(wave(0.0), wave(FRAC_PI_2)))
    },
};
