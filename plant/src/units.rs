//! Quantities with units: `"6 rpm"` to the number in the unit asked for.

use std::fmt;

/// What kind of quantity a unit measures; only like converts into like.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimension {
    /// Length, in m.
    Length,
    /// Angle, in rad.
    Angle,
    /// Speed of rotation, in turns a second.
    Rotation,
    /// Temperature, in °C.
    Temperature,
    /// Pressure, in Pa.
    Pressure,
    /// Relative humidity, in %.
    Humidity,
    /// Frequency, in Hz.
    Frequency,
    /// Time, in s.
    Time,
    /// Length per length, a pure ratio.
    Slope,
    /// Slope per length, in 1/m.
    Curvature,
    /// Curvature per length, in 1/m².
    CurvatureChange,
    /// Relative length per temperature, in 1/K.
    Expansion,
    /// Length per force, in m/N.
    Compliance,
    /// Angle per force, in rad/N.
    AngularCompliance,
    /// Force, in N.
    Force,
    /// Length per time, in m/s.
    Drift,
    /// Ratio per time, in 1/s.
    RelativeDrift,
    /// A number without a unit.
    Number,
}

/// A unit of measurement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// As it is written in a machine file.
    pub symbol: &'static str,
    /// What it measures.
    pub dimension: Dimension,
    /// Its size in the base unit of the dimension, as a ratio of two exact numbers.
    size: (f64, f64),
    /// Where its zero lies in the base unit.
    zero: f64,
}

impl Unit {
    const fn new(symbol: &'static str, dimension: Dimension, size: (f64, f64)) -> Self {
        Self { symbol, dimension, size, zero: 0.0 }
    }

    /// A unit of differences, such as of temperatures: its zero is zero, and no other converts into it.
    #[must_use]
    pub const fn difference(symbol: &'static str) -> Self {
        Self::new(symbol, Dimension::Number, (1.0, 1.0))
    }

    /// The unit of the same parameter on a rotary chain, whose δ is in seconds of arc.
    #[must_use]
    pub fn on_rotary_chain(self) -> Self {
        [(UM, ARCSEC), (UM_PER_H, ARCSEC_PER_H), (UM_PER_N, ARCSEC_PER_N)]
            .into_iter()
            .find_map(|(length, angle)| (self == length).then_some(angle))
            .unwrap_or(self)
    }

    /// True of what cannot be told without a clock: a time, a frequency, a rate.
    #[must_use]
    pub fn is_of_time(&self) -> bool {
        use Dimension::{Drift, Frequency, RelativeDrift, Time};
        matches!(self.dimension, Time | Frequency | Drift | RelativeDrift)
    }

    /// True of how fast something runs away evenly, of which each pass's zero takes all that came before it.
    #[must_use]
    pub fn is_of_drift(&self) -> bool {
        self.dimension == Dimension::Drift
    }

    /// The unit as the tail of a column or key name, such as `um_per_m`; empty for a number.
    #[must_use]
    pub fn suffix(&self) -> String {
        match self.symbol {
            "degC" => "c".into(),
            "%" => "pct".into(),
            symbol => symbol.replace('/', "_per_").replace('^', "").to_lowercase(),
        }
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.symbol)
    }
}

/// No part of a machine moves further: 1 km, in µm.
pub(crate) const LARGEST_UM: f64 = 1e9;

/// True for a number of µm that a machine can follow.
pub(crate) fn in_reach(value_um: f64) -> bool {
    value_um.abs() <= LARGEST_UM
}

/// Micrometre.
pub const UM: Unit = Unit::new("um", Dimension::Length, (1.0, 1e6));
/// Millimetre.
pub const MM: Unit = Unit::new("mm", Dimension::Length, (1.0, 1e3));
/// Metre.
pub const M: Unit = Unit::new("m", Dimension::Length, (1.0, 1.0));
/// Radian.
pub const RAD: Unit = Unit::new("rad", Dimension::Angle, (1.0, 1.0));
/// Milliradian.
pub const MRAD: Unit = Unit::new("mrad", Dimension::Angle, (1.0, 1e3));
/// Degree.
pub const DEG: Unit = Unit::new("deg", Dimension::Angle, (std::f64::consts::PI, 180.0));
/// Second of arc.
pub const ARCSEC: Unit = Unit::new("arcsec", Dimension::Angle, (std::f64::consts::PI, 648_000.0));
/// Turns a minute.
pub const RPM: Unit = Unit::new("rpm", Dimension::Rotation, (1.0, 60.0));
/// Degree Celsius.
pub const DEG_C: Unit = Unit::new("degC", Dimension::Temperature, (1.0, 1.0));
/// Hectopascal.
pub const HPA: Unit = Unit::new("hPa", Dimension::Pressure, (100.0, 1.0));
/// Relative humidity in per cent.
pub const PCT: Unit = Unit::new("%", Dimension::Humidity, (1.0, 1.0));
/// Hertz.
pub const HZ: Unit = Unit::new("Hz", Dimension::Frequency, (1.0, 1.0));
/// Second.
pub const S: Unit = Unit::new("s", Dimension::Time, (1.0, 1.0));
/// Micrometre per metre.
pub const UM_PER_M: Unit = Unit::new("um/m", Dimension::Slope, (1.0, 1e6));
/// Parts per million.
pub const PPM: Unit = Unit::new("ppm", Dimension::Slope, (1.0, 1e6));
/// Micrometre per square metre.
pub const UM_PER_M2: Unit = Unit::new("um/m^2", Dimension::Curvature, (1.0, 1e6));
/// Micrometre per cubic metre.
pub const UM_PER_M3: Unit = Unit::new("um/m^3", Dimension::CurvatureChange, (1.0, 1e6));
/// Parts per million per kelvin.
pub const PPM_PER_K: Unit = Unit::new("ppm/K", Dimension::Expansion, (1.0, 1e6));
/// Micrometre per newton.
pub const UM_PER_N: Unit = Unit::new("um/N", Dimension::Compliance, (1.0, 1e6));
/// Second of arc per newton.
pub const ARCSEC_PER_N: Unit =
    Unit::new("arcsec/N", Dimension::AngularCompliance, (std::f64::consts::PI, 648_000.0));
/// Newton.
pub const N: Unit = Unit::new("N", Dimension::Force, (1.0, 1.0));
/// Micrometre per hour.
pub const UM_PER_H: Unit = Unit::new("um/h", Dimension::Drift, (1.0, 3.6e9));
/// Second of arc per hour.
pub const ARCSEC_PER_H: Unit =
    Unit::new("arcsec/h", Dimension::Rotation, (1.0, 1_296_000.0 * 3600.0));
/// Parts per million per hour.
pub const PPM_PER_H: Unit = Unit::new("ppm/h", Dimension::RelativeDrift, (1.0, 3.6e9));
/// No unit: counts and ratios.
pub const NUMBER: Unit = Unit::new("", Dimension::Number, (1.0, 1.0));

/// Every unit a machine file may use, the usual one of each dimension first.
pub const UNITS: &[Unit] = &[
    MM,
    UM,
    Unit::new("nm", Dimension::Length, (1.0, 1e9)),
    Unit::new("cm", Dimension::Length, (1.0, 100.0)),
    M,
    Unit::new("in", Dimension::Length, (127.0, 5000.0)),
    DEG,
    RAD,
    MRAD,
    Unit::new("urad", Dimension::Angle, (1.0, 1e6)),
    ARCSEC,
    Unit::new("arcmin", Dimension::Angle, (std::f64::consts::PI, 10_800.0)),
    Unit::new("rev", Dimension::Angle, (2.0 * std::f64::consts::PI, 1.0)),
    RPM,
    Unit::new("rev/s", Dimension::Rotation, (1.0, 1.0)),
    Unit::new("rev/min", Dimension::Rotation, (1.0, 60.0)),
    Unit::new("rev/h", Dimension::Rotation, (1.0, 3600.0)),
    Unit::new("rev/day", Dimension::Rotation, (1.0, 86_400.0)),
    Unit::new("deg/s", Dimension::Rotation, (1.0, 360.0)),
    Unit::new("deg/h", Dimension::Rotation, (1.0, 1_296_000.0)),
    Unit::new("arcsec/s", Dimension::Rotation, (1.0, 1_296_000.0)),
    ARCSEC_PER_H,
    DEG_C,
    Unit::new("°C", Dimension::Temperature, (1.0, 1.0)),
    Unit { symbol: "K", dimension: Dimension::Temperature, size: (1.0, 1.0), zero: -273.15 },
    HPA,
    Unit::new("Pa", Dimension::Pressure, (1.0, 1.0)),
    Unit::new("kPa", Dimension::Pressure, (1000.0, 1.0)),
    Unit::new("mbar", Dimension::Pressure, (100.0, 1.0)),
    Unit::new("bar", Dimension::Pressure, (1e5, 1.0)),
    Unit::new("mmHg", Dimension::Pressure, (133.322_387_415, 1.0)),
    PCT,
    HZ,
    Unit::new("mHz", Dimension::Frequency, (1.0, 1e3)),
    Unit::new("kHz", Dimension::Frequency, (1e3, 1.0)),
    Unit::new("MHz", Dimension::Frequency, (1e6, 1.0)),
    S,
    Unit::new("ms", Dimension::Time, (1.0, 1e3)),
    Unit::new("us", Dimension::Time, (1.0, 1e6)),
    Unit::new("min", Dimension::Time, (60.0, 1.0)),
    Unit::new("h", Dimension::Time, (3600.0, 1.0)),
    Unit::new("day", Dimension::Time, (86_400.0, 1.0)),
    UM_PER_M,
    PPM,
    Unit::new("nm/mm", Dimension::Slope, (1.0, 1e6)),
    Unit::new("um/mm", Dimension::Slope, (1.0, 1e3)),
    Unit::new("mm/m", Dimension::Slope, (1.0, 1e3)),
    Unit::new("ppb", Dimension::Slope, (1.0, 1e9)),
    UM_PER_M2,
    UM_PER_M3,
    PPM_PER_K,
    Unit::new("um/m/K", Dimension::Expansion, (1.0, 1e6)),
    Unit::new("1/K", Dimension::Expansion, (1.0, 1.0)),
    UM_PER_N,
    Unit::new("nm/N", Dimension::Compliance, (1.0, 1e9)),
    Unit::new("um/kN", Dimension::Compliance, (1.0, 1e9)),
    ARCSEC_PER_N,
    N,
    Unit::new("kN", Dimension::Force, (1e3, 1.0)),
    UM_PER_H,
    Unit::new("um/min", Dimension::Drift, (1.0, 6e7)),
    Unit::new("um/s", Dimension::Drift, (1.0, 1e6)),
    Unit::new("nm/s", Dimension::Drift, (1.0, 1e9)),
    PPM_PER_H,
    Unit::new("ppm/min", Dimension::RelativeDrift, (1.0, 6e7)),
    Unit::new("ppm/s", Dimension::RelativeDrift, (1.0, 1e6)),
    Unit::new("ppb/h", Dimension::RelativeDrift, (1.0, 3.6e12)),
];

/// Why a text is not the quantity asked for.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum QuantityError {
    /// It does not begin with a number.
    #[error("no number")]
    NoNumber,
    /// A number alone.
    #[error("no unit")]
    NoUnit,
    /// A unit that nobody knows, or of another dimension.
    #[error("unit `{found}`")]
    Unit {
        /// The unit found.
        found: String,
    },
    /// A comma where the decimal point belongs.
    #[error("a comma in the number")]
    Comma,
    /// Infinite or too large for the arithmetic.
    #[error("no finite number")]
    NotFinite,
}

/// The number in `wanted` that `text` says, such as 0.1 for `"6 rpm"` in turns a second.
///
/// A number is decimal with an optional exponent; a unit of the same dimension follows it. In the
/// wanted unit itself the number is the text's own, correctly rounded; otherwise it is off by at
/// most two roundings.
///
/// # Errors
///
/// [`QuantityError`] when number or unit is missing, unknown, or of another dimension.
///
/// # Examples
///
/// ```
/// use helixlock_plant::units::{MM, read_quantity};
///
/// assert_eq!(read_quantity("1 in", &MM), Ok(25.4));
/// ```
pub fn read_quantity(text: &str, wanted: &Unit) -> Result<f64, QuantityError> {
    let text = text.trim();
    let (number, symbol) = text.split_at(number_length(text));
    let value: f64 = number.parse().map_err(|_| QuantityError::NoNumber)?;
    if !value.is_finite() {
        return Err(QuantityError::NotFinite);
    }
    // The micro sign and the Greek letter look alike.
    let symbol = symbol.trim().replace(['\u{b5}', '\u{3bc}'], "u");
    let symbol = symbol.as_str();
    if symbol == wanted.symbol {
        return Ok(value);
    }
    let unit = UNITS
        .iter()
        .find(|unit| unit.symbol == symbol && unit.dimension == wanted.dimension)
        .ok_or_else(|| match symbol {
            "" => QuantityError::NoUnit,
            found if found.starts_with(',') => QuantityError::Comma,
            found => QuantityError::Unit { found: found.into() },
        })?;
    let factor = (unit.size.0 * wanted.size.1) / (unit.size.1 * wanted.size.0);
    let converted = value * factor + (unit.zero - wanted.zero) * wanted.size.1 / wanted.size.0;
    if converted.is_finite() { Ok(converted) } else { Err(QuantityError::NotFinite) }
}

/// Units in which a quantity of this dimension may be written, as a list for a message.
#[must_use]
pub fn spellings(dimension: Dimension) -> String {
    let symbols: Vec<_> = UNITS
        .iter()
        .filter(|unit| unit.dimension == dimension && unit.symbol.is_ascii())
        .map(|unit| unit.symbol)
        .collect();
    symbols.join(", ")
}

/// Bytes of the longest beginning of `text` that is a decimal number.
pub(crate) fn number_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let digits =
        |from: usize| bytes[from..].iter().take_while(|byte| byte.is_ascii_digit()).count() + from;
    let sign = usize::from(matches!(bytes.first(), Some(b'+' | b'-')));
    let mut end = digits(sign);
    if bytes.get(end) == Some(&b'.') {
        end = digits(end + 1);
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let signed = end + 1 + usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        if signed < digits(signed.min(bytes.len())) {
            end = digits(signed);
        }
    }
    end
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_in_the_wanted_unit_are_kept_to_the_bit() {
        assert_eq!(read_quantity("0.63281983 um", &UM), Ok(0.632_819_83));
        assert_eq!(read_quantity("-5e-1um", &UM), Ok(-0.5));
    }

    #[test]
    fn like_converts_into_like() {
        assert_eq!(read_quantity("0.25 rev/s", &RPM), Ok(15.0));
        assert_eq!(read_quantity("293.15 K", &DEG_C), Ok(20.0));
        assert_eq!(read_quantity("12 MHz", &HZ), Ok(12e6));
        assert_eq!(read_quantity("101.325 kPa", &HPA), Ok(1013.25));
        assert_eq!(read_quantity("1 day", &S), Ok(86_400.0));
        // The micro sign and the Greek letter.
        assert_eq!(read_quantity("1 \u{b5}m", &UM), Ok(1.0));
        assert_eq!(read_quantity("1 \u{3bc}m/m^2", &UM_PER_M2), Ok(1.0));
    }

    #[test]
    fn what_is_not_a_quantity_is_refused() {
        assert_eq!(read_quantity("6", &MM), Err(QuantityError::NoUnit));
        assert_eq!(read_quantity("six mm", &MM), Err(QuantityError::NoNumber));
        assert_eq!(read_quantity("6 s", &MM), Err(QuantityError::Unit { found: "s".into() }));
        assert_eq!(read_quantity("1e999 mm", &MM), Err(QuantityError::NotFinite));
        assert_eq!(read_quantity("1e mm", &MM), Err(QuantityError::Unit { found: "e mm".into() }));
        assert_eq!(read_quantity("", &MM), Err(QuantityError::NoNumber));
    }

    #[test]
    fn suffixes_fit_column_names() {
        let suffixes: Vec<_> = [UM, UM_PER_M2, PPM_PER_K, DEG_C, NUMBER].map(|u| u.suffix()).into();
        assert_eq!(suffixes, ["um", "um_per_m2", "ppm_per_k", "c", ""]);
    }
}
