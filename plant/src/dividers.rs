//! Thumb wheels for a lead, and line counts for a set of leads, by exact arithmetic.
//!
//! The two pulse trains have the same frequency when `M/A = S·N/B`: `M` grating lines a turn, `A`
//! and `B` the dividers, `S` the lead, `N` fringes per mm (document 1, "decimal rationalisation").
//! `N` is not rational; what the nearest `B/A` leaves is a slope that the compensator takes out.

mod line_count;

use std::f64::consts::PI;

use num_rational::Ratio;

use crate::lead::{Lead, LeadUnit};

pub use line_count::{LineCount, find_line_counts};

/// Measuring range: how much table error turns the meter once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Range {
    /// `B·λ/2`.
    X1,
    /// Twice that.
    X2,
}

impl Range {
    /// 1 or 2.
    #[must_use]
    pub fn factor(self) -> u16 {
        match self {
            Self::X1 => 1,
            Self::X2 => 2,
        }
    }
}

/// Largest number three thumb wheels can show.
pub const LARGEST_PRESET: u16 = 999;
/// Lines of the outer track, for metric and inch leads (document 1).
pub const METRIC_TRACK: u32 = 13_906;
/// Lines of the inner track, for module leads (document 1).
pub const MODULE_TRACK: u32 = 11_060;
/// Largest slope the compensator can take out, ppm: one pulse in a thousand.
pub const COMPENSATOR_REACH_PPM: f64 = 1000.0;

/// Fringes per mm of table travel, `N = 2/λ`.
#[must_use]
pub fn fringes_per_mm(wavelength_um: f64) -> f64 {
    2000.0 / wavelength_um
}

/// Laser pulses by which the channels start apart so that the meter stands nearest to 180°.
#[must_use]
pub fn centre_phase(b: u16, range: Range) -> u16 {
    (range.factor() * b / 2).min(LARGEST_PRESET)
}

/// The phase that an initial phase selects, °: `m/(range·B)·360°`.
#[must_use]
pub fn phase_deg(initial_phase: u16, b: u16, range: Range) -> f64 {
    360.0 * f64::from(initial_phase) / f64::from(range.factor() * b)
}

/// Laser pulses between two compensations for a rate in µm/m, as four thumb wheels can show it.
///
/// `F = 10⁶/ΔS`, seven decades of which the lowest three cannot be set: 1 000 to 9 999 000.
/// `None` when the rate is 0 or out of reach.
///
/// Source: document 1, figure 9.
///
/// # Examples
///
/// The example of document 1: 6.4 µm/m is 156 250 pulses, of which 156 000 can be set.
///
/// ```
/// assert_eq!(helixlock_plant::dividers::settable_cycle(6.4), Some(156_000));
/// ```
#[must_use]
pub fn settable_cycle(compensation_um_per_m: f64) -> Option<u32> {
    let thousands = libm::round(1000.0 / compensation_um_per_m.abs());
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 to 9999")]
    (1.0..=9999.0).contains(&thousands).then(|| 1000 * thousands as u32)
}

/// Dividers for one lead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setting {
    /// Grating divider.
    pub a: u16,
    /// Laser divider.
    pub b: u16,
    /// What they leave, ppm of the travel, as the recorder shows it: µm per m.
    pub residual_ppm: f64,
}

impl Setting {
    /// Table error that 360° of phase stand for, µm.
    #[must_use]
    pub fn full_scale_um(&self, task: &Task, range: Range) -> f64 {
        f64::from(range.factor() * self.b) * task.wavelength_um / 2.0
    }

    /// Compensation that takes the residual out, µm/m, and its cycle, as far as the wheels can.
    #[must_use]
    pub fn compensation(&self) -> Option<(f64, u32)> {
        let cycle = settable_cycle(self.residual_ppm)?;
        Some((libm::copysign(1e6 / f64::from(cycle), -self.residual_ppm), cycle))
    }
}

/// Measuring range that `×1` is near to unless another is asked for, µm: that of the metric example
/// of document 1.
pub const USUAL_RANGE_UM: f64 = 47.5;

/// What dividers are sought for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Task {
    /// The lead to grind.
    pub lead: Lead,
    /// Lines of the grating.
    pub lines: u32,
    /// Wavelength in the machine's air, µm.
    pub wavelength_um: f64,
    /// Measuring range to come near to at ×1, µm.
    pub range_um: f64,
}

/// The dividers that leave the least, of those the multiple nearest to the range asked for.
///
/// All `A` from 1 to 999 are tried with the `B` nearest to their ratio. Fractions apart differ by
/// at least a millionth, so that the choice is exact although `N` is not rational; the residual is
/// right to 1e-9 ppm.
///
/// `None` when even the best pair leaves more than the compensator can take out.
///
/// # Examples
///
/// The metric example of document 1:
///
/// ```
/// use helixlock_plant::dividers::{METRIC_TRACK, Task, solve};
///
/// let lead = "6 mm".parse()?;
/// let task = Task { lead, lines: METRIC_TRACK, wavelength_um: 0.632_819_83, range_um: 47.5 };
/// let found = solve(&task).expect("the example");
/// assert_eq!((found.a, found.b), (110, 150));
/// assert!((found.residual_ppm - -0.846).abs() < 0.001);
/// # Ok::<(), helixlock_plant::LeadError>(())
/// ```
#[must_use]
pub fn solve(task: &Task) -> Option<Setting> {
    let sought = task.lead.mm() * fringes_per_mm(task.wavelength_um) / f64::from(task.lines);
    let mut best: Option<(f64, Ratio<u16>)> = None;
    for a in 1..=LARGEST_PRESET {
        let b = libm::round(f64::from(a) * sought);
        if !(1.0..=f64::from(LARGEST_PRESET)).contains(&b) {
            continue;
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 to 999")]
        let pair = Ratio::new(b as u16, a);
        let off = residual_ppm(task, a, b).abs();
        // The same fraction comes again with its multiples; rounding must not make it another.
        if best.is_none_or(|(least, known)| pair != known && off < least) {
            best = Some((off, pair));
        }
    }
    let (off, pair) = best.filter(|(off, _)| *off <= COMPENSATOR_REACH_PPM)?;
    let (a, b) = widened(pair, 2.0 * task.range_um / task.wavelength_um);
    let residual_ppm = libm::copysign(off, residual_ppm(task, a, f64::from(b)));
    Some(Setting { a, b, residual_ppm })
}

/// `M·B·λ/(2·S·A) − 1`, ppm.
fn residual_ppm(task: &Task, a: u16, b: f64) -> f64 {
    let lead = task.lead.rational();
    let pi = if task.lead.unit == LeadUnit::PiMm { PI } else { 1.0 };
    // The difference is taken of products of whole numbers, so nothing cancels but what must.
    #[expect(clippy::cast_precision_loss, reason = "below 2⁵³")]
    let turn = *lead.numer() as f64 * f64::from(a) * pi * fringes_per_mm(task.wavelength_um);
    #[expect(clippy::cast_precision_loss, reason = "below 2⁵³")]
    let lines = f64::from(task.lines) * b * *lead.denom() as f64;
    (lines - turn) / turn * 1e6
}

/// The multiple of `B/A` whose `B` is nearest to the one sought, both within the wheels.
fn widened(pair: Ratio<u16>, b_sought: f64) -> (u16, u16) {
    let (b, a) = (*pair.numer(), *pair.denom());
    let most = LARGEST_PRESET / a.max(b);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 to 999")]
    let times = libm::round(b_sought / f64::from(b)).clamp(1.0, f64::from(most)) as u16;
    (a * times, b * times)
}

#[cfg(test)]
mod tests;
