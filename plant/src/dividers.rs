//! Thumb wheels for a lead, by exact arithmetic.
//!
//! The two pulse trains have the same frequency when `M/A = S·N/B`: `M` grating lines a turn, `A`
//! and `B` the dividers, `S` the lead, `N` fringes per mm (document 1, "decimal rationalisation").

use crate::machine::Range;

/// Fringes per mm of table travel, `N = 2/λ`.
#[must_use]
pub fn fringes_per_mm(wavelength_um: f64) -> f64 {
    2000.0 / wavelength_um
}

/// Laser pulses by which the channels start apart so that the meter stands nearest to 180°.
#[must_use]
pub fn centre_phase(b: u16, range: Range) -> u16 {
    (range.factor() * b / 2).min(999)
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
