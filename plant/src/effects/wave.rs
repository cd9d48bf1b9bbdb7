//! Unit sinusoids over angle, travel or time: the columns of an amplitude and its phase.

use std::f64::consts::{FRAC_PI_2, TAU};

use crate::{Basis, Covariate, Effect, Instant, Smoothness};

/// What a sinusoid runs on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Run {
    /// Turns per spindle turn.
    Spindle {
        /// How many.
        order: f64,
    },
    /// Turns per mm of travel.
    Travel {
        /// How many.
        per_mm: f64,
    },
    /// Turns per second.
    Time {
        /// How many.
        hz: f64,
    },
}

/// `scale · sin(argument + lead)`, the lead being 0 for a sine and a quarter turn for a cosine.
#[derive(Clone, Copy, Debug)]
struct Wave {
    run: Run,
    scale: f64,
    lead_rad: f64,
    /// A logged angle that turns the pattern with it, and how many times.
    index: Option<(Covariate, f64)>,
}

/// Sine and cosine of unit amplitude times `scale`.
pub(super) fn pair(run: Run, scale: f64) -> Basis {
    indexed(run, scale, None)
}

/// The same on a part that can be turned on its seat, by an angle that is logged in degrees.
pub(super) fn indexed(run: Run, scale: f64, index: Option<(Covariate, f64)>) -> Basis {
    let wave = |lead_rad| Wave { run, scale, lead_rad, index };
    Basis::two(wave(0.0), wave(FRAC_PI_2))
}

impl Effect for Wave {
    fn delta_um(&self, now: &Instant<'_>) -> f64 {
        let argument_rad = match self.run {
            Run::Spindle { order } => order * now.spindle_rad,
            Run::Travel { per_mm } => TAU * per_mm * now.position_mm,
            Run::Time { hz } => TAU * hz * now.time_s,
        };
        let turned_rad = self.index.map_or(0.0, |(which, order)| {
            let degrees = now.covariate(which);
            if degrees.is_nan() { 0.0 } else { order * degrees.to_radians() }
        });
        self.scale * libm::sin(argument_rad + turned_rad + self.lead_rad)
    }

    fn smoothness(&self, speed_rad_s: f64, travel_mm_s: f64) -> Smoothness {
        // The index of a part is constant in a pass, so it does not change the rate.
        let rate_per_s = match self.run {
            Run::Spindle { order } => order * speed_rad_s,
            Run::Travel { per_mm } => TAU * per_mm * travel_mm_s,
            Run::Time { hz } => TAU * hz,
        };
        Smoothness::Band { amplitude_um: self.scale.abs(), rate_per_s: rate_per_s.abs() }
    }
}
