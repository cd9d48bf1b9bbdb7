//! What a change of the air does to a length that the laser measures.

use crate::air::ciddor;
use crate::machine::{Air, Laser};

/// How much the laser reads short in this air, µm per m of its path.
pub(super) fn slope(laser: &Laser, air: &Air) -> f64 {
    let reference = ciddor(laser.wavelength_um, &laser.reference);
    1e6 * (reference - ciddor(laser.wavelength_um, air)) / reference
}

/// The air as logged; what is not logged is as in the reference.
pub(super) fn logged(reference: &Air, temperature_c: f64, pressure_hpa: f64) -> Air {
    let or = |value: f64, standard: f64| if value.is_nan() { standard } else { value };
    Air {
        temperature_c: or(temperature_c, reference.temperature_c),
        pressure_hpa: or(pressure_hpa, reference.pressure_hpa),
        ..*reference
    }
}
