//! Refractive index of moist air, by two independent equations.
//!
//! - Ciddor, Applied Optics 35 (1996) 1566: [`ciddor`], used throughout
//! - Edlén as modified by Birch and Downs, Metrologia 31 (1994) 315: [`edlen`], to check it
//!
//! They agree within 2.7e-9 from 10 to 30 °C at 50 % of humidity. At 20 °C, 1013.25 hPa, 50 % the index changes by
//! −0.93e-6 per K, +0.268e-6 per hPa, −0.0085e-6 per % of humidity.

use crate::machine::Air;

/// Carbon dioxide in the air, ppm.
const CO2_PPM: f64 = 450.0;
/// 0 °C in K.
const ZERO_C: f64 = 273.15;

/// Refractive index of air at a vacuum wavelength in µm, after Ciddor; 450 ppm of carbon dioxide.
///
/// # Examples
///
/// At 633 nm, 20 °C, 1013.25 hPa, 20 %:
///
/// ```
/// use helixlock_plant::{air::ciddor, machine::Air};
///
/// let air = Air { temperature_c: 20.0, pressure_hpa: 1013.25, humidity_pct: 20.0 };
/// assert!((ciddor(0.633, &air) - 1.000_271_628_534).abs() < 1e-11);
/// ```
#[must_use]
pub fn ciddor(wavelength_um: f64, air: &Air) -> f64 {
    let (temperature_k, pressure_pa) = (air.temperature_c + ZERO_C, 100.0 * air.pressure_hpa);
    let wave = 1.0 / (wavelength_um * wavelength_um);
    let dry = 1e-8 * (5_792_105.0 / (238.0185 - wave) + 167_917.0 / (57.362 - wave));
    let dry = dry * (1.0 + 0.534e-6 * (CO2_PPM - 450.0));
    let vapour = 1.022e-8 * (295.235 + wave * (2.6422 + wave * (-0.032_380 + wave * 0.004_028)));
    let enhancement =
        1.00062 + 3.14e-8 * pressure_pa + 5.6e-7 * air.temperature_c * air.temperature_c;
    let saturation_pa = saturation_giacomo_pa(temperature_k);
    let water = enhancement * air.humidity_pct / 100.0 * saturation_pa / pressure_pa;
    let moles = moles_per_m3(temperature_k, pressure_pa, water);
    let dry_share = moles * (1.0 - water) / moles_per_m3(288.15, 101_325.0, 0.0);
    let vapour_share = moles * water / moles_per_m3(293.15, 1333.0, 1.0);
    1.0 + dry_share * dry + vapour_share * vapour
}

/// Refractive index of air at a vacuum wavelength in µm, after Edlén, modified.
#[must_use]
pub fn edlen(wavelength_um: f64, air: &Air) -> f64 {
    let pressure_pa = 100.0 * air.pressure_hpa;
    let wave = 1.0 / (wavelength_um * wavelength_um);
    let standard = 1e-8 * (8342.54 + 2_406_147.0 / (130.0 - wave) + 15_998.0 / (38.9 - wave));
    let density = (1.0 + 1e-8 * (0.601 - 0.00972 * air.temperature_c) * pressure_pa)
        / (1.0 + 0.003_661 * air.temperature_c);
    let dry = pressure_pa * standard * density / 96_095.43;
    let temperature_k = air.temperature_c + ZERO_C;
    let vapour_pa = air.humidity_pct / 100.0 * saturation_iapws_pa(temperature_k);
    1.0 + dry - 1e-10 * (292.75 / temperature_k) * (3.7345 - 0.0401 * wave) * vapour_pa
}

/// Amount of moist air, mol/m³, with the mole fraction `water` of vapour (BIPM 1981/91 density).
fn moles_per_m3(temperature_k: f64, pressure_pa: f64, water: f64) -> f64 {
    let celsius = temperature_k - ZERO_C;
    let ratio = pressure_pa / temperature_k;
    let first = 1.581_23e-6
        + celsius * (-2.9331e-8 + celsius * 1.1043e-10)
        + (5.707e-6 - 2.051e-8 * celsius) * water
        + (1.9898e-4 - 2.376e-6 * celsius) * water * water;
    let second = 1.83e-11 - 0.765e-8 * water * water;
    let compressibility = 1.0 - ratio * first + ratio * ratio * second;
    ratio / (8.314_510 * compressibility)
}

/// Saturation pressure of water, Pa, after Giacomo, which Ciddor's equation is built on.
fn saturation_giacomo_pa(temperature_k: f64) -> f64 {
    let exponent = 1.237_884_7e-5 * temperature_k * temperature_k - 1.912_131_6e-2 * temperature_k
        + 33.937_110_47
        - 6.343_164_5e3 / temperature_k;
    libm::exp(exponent)
}

/// Saturation pressure of water, Pa, after IAPWS-IF97, region 4.
fn saturation_iapws_pa(temperature_k: f64) -> f64 {
    let theta = temperature_k - 0.238_555_575_678 / (temperature_k - 650.175_348_448);
    let a = theta * (theta + 1_167.052_145_28) - 724_213.167_032;
    let b = theta * (-17.073_846_940_1 * theta + 12_020.824_702_5) - 3_232_555.032_23;
    let c = theta * (14.915_108_613_5 * theta - 4_823.265_736_16) + 405_113.405_421;
    let root = 2.0 * c / (-b + (b * b - 4.0 * a * c).sqrt());
    let square = root * root;
    1e6 * square * square
}

#[cfg(test)]
mod tests {
    use super::*;

    fn air(temperature_c: f64, humidity_pct: f64) -> Air {
        Air { temperature_c, pressure_hpa: 1013.25, humidity_pct }
    }

    /// An independent package at 633.0 nm; its vapour pressure over 60 °C water differs by 25 ppm.
    #[test]
    fn check_values() {
        let table = [
            (20.0, 20.0, 1.000_271_628_534_058, 1.000_271_629_169_165, 1e-11),
            (20.0, 80.0, 1.000_271_118_347_263, 1.000_271_119_763_523, 1e-11),
            (60.0, 80.0, 1.000_234_024_175_406, 1.000_233_974_854_282, 3e-10),
        ];
        for (temperature_c, humidity_pct, by_ciddor, by_edlen, tolerance) in table {
            let air = air(temperature_c, humidity_pct);
            assert!((ciddor(0.633, &air) - by_ciddor).abs() < tolerance, "{air:?}");
            assert!((edlen(0.633, &air) - by_edlen).abs() < 1e-14, "{air:?}");
        }
    }

    #[test]
    fn the_two_agree_at_room_temperature() {
        for celsius in 10..=30 {
            let air = air(f64::from(celsius), 50.0);
            let apart = (ciddor(0.633, &air) - edlen(0.633, &air)).abs();
            assert!(apart < 2.7e-9, "{air:?}: {apart}");
        }
    }

    #[test]
    fn sensitivities_are_those_of_the_textbook() {
        let base = air(20.0, 50.0);
        let change = |other: Air| 1e6 * (ciddor(0.633, &other) - ciddor(0.633, &base));
        let warmer = change(Air { temperature_c: 21.0, ..base });
        let denser = change(Air { pressure_hpa: 1014.25, ..base });
        let wetter = change(Air { humidity_pct: 51.0, ..base });
        // −0.927 from the density and −0.03 from the vapour that 50 % then holds more.
        assert!((warmer + 0.93).abs() < 0.04, "{warmer}");
        assert!((denser - 0.268).abs() < 0.001, "{denser}");
        assert!((wetter + 0.0085).abs() < 0.0005, "{wetter}");
    }
}
