//! What settings leave of the travel on average: a slope.

use crate::compensation::dialled_um_per_m;
use crate::{Machine, Part};

/// Mean slope of the recorder, µm/m, from rationalisation and compensation.
///
/// `M·B·λ/(2·S·A) − 1` of the travel; −0.846 µm/m for A 110, B 150 and the wavelength as printed
/// in document 1. A compensation blocks (+) or inserts (−) one pulse in each cycle.
pub(crate) fn implied_um_per_m(machine: &Machine) -> f64 {
    rationalisation_um_per_m(machine) + dialled_um_per_m(machine)
}

/// What the dividers leave of the travel, µm/m; 0 without dividers.
#[must_use]
pub fn rationalisation_um_per_m(machine: &Machine) -> f64 {
    if !machine.has(Part::Dividers) {
        return 0.0;
    }
    let dividers = &machine.dividers;
    let fringes_per_turn =
        f64::from(machine.grating.lines) * f64::from(dividers.b) / f64::from(dividers.a);
    let rational_mm = fringes_per_turn * machine.fringe_um() / 1000.0;
    let lead_mm = machine.workpiece.lead.mm();
    (rational_mm - lead_mm) / lead_mm * 1e6
}
