//! Unit effects written as closures, with what they promise of their smoothness.

use std::fmt;

use crate::units::NUMBER;
use crate::{Effect, Instant, Parameter, Search, Smoothness};

/// A formula as a closure.
pub(super) struct Shape<F, S> {
    delta: F,
    smoothness: S,
    feeds_back: bool,
}

/// A formula that is a polynomial in time, of degree 11 at most, while logs are constant.
pub(super) fn polynomial(delta: impl Fn(&Instant<'_>) -> f64 + Send + Sync) -> impl Effect {
    banded(delta, |_, _| Smoothness::Polynomial)
}

/// A formula with jumps or bends.
pub(super) fn rough(delta: impl Fn(&Instant<'_>) -> f64 + Send + Sync) -> impl Effect {
    banded(delta, |_, _| Smoothness::Rough)
}

/// A formula whose derivatives are bounded at a given spindle speed (rad/s) and travel (mm/s).
pub(super) fn banded(
    delta: impl Fn(&Instant<'_>) -> f64 + Send + Sync,
    smoothness: impl Fn(f64, f64) -> Smoothness + Send + Sync,
) -> impl Effect {
    Shape { delta, smoothness, feeds_back: false }
}

/// A formula of the error that the meter sees.
pub(super) fn feedback(delta: impl Fn(&Instant<'_>) -> f64 + Send + Sync) -> impl Effect {
    Shape { delta, smoothness: |_, _| Smoothness::Rough, feeds_back: true }
}

/// 0 before `time_s`, 1 from then on.
pub(super) fn since(time_s: f64, now: &Instant<'_>) -> f64 {
    if now.time_s < time_s { 0.0 } else { 1.0 }
}

/// How what winds up behind a turn is at the start of a pass, which no log tells.
pub(super) const PASS_START: Parameter = Parameter::nonlinear(
    "pass_start",
    NUMBER,
    Search::Switch,
    "how a pass begins: 0 taken up, 1 as the one before left it, 2 as behind a turn",
)
.within(0.0..=2.0)
.or(0.0);

/// Way behind the last turn, mm; infinite before any. A pass that begins where the one before ended may go on
/// from there, and any may begin where the axis has come to from the other side.
pub(super) fn behind_turn_mm(now: &Instant<'_>, pass_start: f64) -> f64 {
    if pass_start < 1.0 {
        now.since_reversal_mm
    } else if 1.0 < pass_start && now.since_turn_mm.is_infinite() {
        now.travelled_mm
    } else {
        now.since_turn_mm
    }
}

impl<F, S> fmt::Debug for Shape<F, S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Shape").field("feeds_back", &self.feeds_back).finish_non_exhaustive()
    }
}

impl<F, S> Effect for Shape<F, S>
where
    F: Fn(&Instant<'_>) -> f64 + Send + Sync,
    S: Fn(f64, f64) -> Smoothness + Send + Sync,
{
    fn delta_um(&self, now: &Instant<'_>) -> f64 {
        (self.delta)(now)
    }

    fn smoothness(&self, speed_rad_s: f64, travel_mm_s: f64) -> Smoothness {
        (self.smoothness)(speed_rad_s, travel_mm_s)
    }

    fn feeds_back(&self) -> bool {
        self.feeds_back
    }
}
