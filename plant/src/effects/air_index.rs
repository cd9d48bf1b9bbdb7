//! What a change of the air does to a length that the laser measures.
//!
//! Cold air is the denser the higher the pressure: temperature, pressure and humidity do not add up, and in Mexico
//! City a kelvin is 0.72 ppm where at the sea it is 0.93. So each has its change beside the air as it was logged:
//! pressure from the reference on, temperature at that pressure, humidity at both. Together they are the whole
//! change, and a quantity that is not logged is as in the reference.

use crate::air::ciddor;
use crate::machine::{Air, Laser};
use crate::{Covariate, Instant};

/// A laser that counts as if its beam ran through the air of its reference.
pub(super) struct AirIndex {
    reference: Air,
    wavelength_um: f64,
    index: f64,
}

impl AirIndex {
    pub(super) fn of(laser: &Laser) -> Self {
        let Laser { wavelength_um, reference } = *laser;
        Self { reference, wavelength_um, index: ciddor(wavelength_um, &reference) }
    }

    /// Reads short by so much for the pressure, µm per m of its path.
    pub(super) fn for_pressure(&self, now: &Instant<'_>) -> f64 {
        let pressure_hpa = now.covariate(Covariate::AirPressure);
        self.shorter(self.index, &Air { pressure_hpa, ..self.reference })
    }

    /// For the temperature, at the pressure that was logged.
    pub(super) fn for_temperature(&self, now: &Instant<'_>) -> f64 {
        let temperature_c = now.covariate(Covariate::AirTemperature);
        let before = Air { pressure_hpa: self.logged(now).pressure_hpa, ..self.reference };
        self.shorter(self.of_air(&before), &Air { temperature_c, ..before })
    }

    /// For the humidity, at the temperature and the pressure that were logged.
    pub(super) fn for_humidity(&self, now: &Instant<'_>) -> f64 {
        let humidity_pct = now.covariate(Covariate::Humidity);
        let before = Air { humidity_pct: self.reference.humidity_pct, ..self.logged(now) };
        self.shorter(self.of_air(&before), &Air { humidity_pct, ..before })
    }

    /// For all that was logged, the temperature at least.
    pub(super) fn for_all(&self, now: &Instant<'_>) -> f64 {
        if now.covariate(Covariate::AirTemperature).is_nan() {
            return f64::NAN;
        }
        self.shorter(self.index, &self.logged(now))
    }

    fn shorter(&self, before: f64, air: &Air) -> f64 {
        1e6 * (before - self.of_air(air)) / self.index
    }

    fn of_air(&self, air: &Air) -> f64 {
        ciddor(self.wavelength_um, air)
    }

    fn logged(&self, now: &Instant<'_>) -> Air {
        let or = |column, standard: f64| {
            let value = now.covariate(column);
            if value.is_nan() { standard } else { value }
        };
        let Air { temperature_c, pressure_hpa, humidity_pct } = self.reference;
        Air {
            temperature_c: or(Covariate::AirTemperature, temperature_c),
            pressure_hpa: or(Covariate::AirPressure, pressure_hpa),
            humidity_pct: or(Covariate::Humidity, humidity_pct),
        }
    }
}
