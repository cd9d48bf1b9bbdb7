//! Quantities on the command line: `"5 mm"`, `"0.5 um"`, or a number in the unit the help names.

use helixlock_plant::units::{self, QuantityError, Unit, read_quantity};

/// A length in mm, more than zero.
pub(crate) fn length_mm(text: &str) -> Result<f64, String> {
    positive(read(text, &units::MM)?)
}

/// A position in mm.
pub(crate) fn position_mm(text: &str) -> Result<f64, String> {
    read(text, &units::MM)
}

/// A length in µm, more than zero.
pub(crate) fn length_um(text: &str) -> Result<f64, String> {
    positive(read(text, &units::UM)?)
}

/// A deviation in µm, of either sign.
pub(crate) fn deviation_um(text: &str) -> Result<f64, String> {
    read(text, &units::UM)
}

/// A frequency in Hz, more than zero.
pub(crate) fn frequency_hz(text: &str) -> Result<f64, String> {
    positive(read(text, &units::HZ)?)
}

/// A time in s, more than zero.
pub(crate) fn time_s(text: &str) -> Result<f64, String> {
    positive(read(text, &units::S)?)
}

/// A lead in mm: metric, inch or a multiple of π.
pub(crate) fn lead_mm(text: &str) -> Result<f64, String> {
    if text.trim().parse::<f64>().is_ok() {
        return length_mm(text);
    }
    let lead: helixlock_plant::Lead = text.parse().map_err(|error| format!("{error}"))?;
    Ok(lead.mm())
}

fn read(text: &str, unit: &Unit) -> Result<f64, String> {
    match read_quantity(text, unit) {
        Ok(value) => Ok(value),
        Err(QuantityError::NoUnit) => number(text).ok_or_else(|| expected(unit)),
        Err(error) => Err(format!("{error}, {}", expected(unit))),
    }
}

fn number(text: &str) -> Option<f64> {
    text.trim().parse().ok().filter(|value: &f64| value.is_finite())
}

fn expected(unit: &Unit) -> String {
    format!("expected a number with one of the units {}", units::spellings(unit.dimension))
}

fn positive(value: f64) -> Result<f64, String> {
    if 0.0 < value { Ok(value) } else { Err("expected more than 0".into()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_convert_and_plain_numbers_are_taken() {
        assert_eq!(length_mm("1 in"), Ok(25.4));
        assert_eq!(deviation_um("-3"), Ok(-3.0));
        assert_eq!(lead_mm("5 mm"), Ok(5.0));
        assert!(lead_mm("1/6 in").is_ok_and(|mm| (mm - 127.0 / 30.0).abs() < 1e-12));
    }

    #[test]
    fn other_dimensions_are_refused_with_what_is_expected() {
        let error = length_mm("5 rpm").expect_err("a speed is no length");
        assert!(error.starts_with("unit `rpm`, expected a number with one of"), "{error}");
        assert_eq!(length_um("0 um"), Err("expected more than 0".into()));
    }
}
