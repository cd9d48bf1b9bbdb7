//! A lead as an exact number of millimetres, inches, or multiples of π.

use std::f64::consts::PI;
use std::fmt;
use std::str::FromStr;

use num_rational::Ratio;

/// What the ratio of a lead multiplies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LeadUnit {
    /// Millimetres.
    Mm,
    /// Inches of exactly 25.4 mm.
    Inch,
    /// Millimetres times π: module leads.
    PiMm,
}

/// Advance in one turn: an exact ratio of a [`LeadUnit`].
///
/// # Examples
///
/// ```
/// use helixlock_plant::Lead;
///
/// let lead: Lead = "1/6 in".parse()?;
/// assert_eq!(lead.mm(), 127.0 / 30.0);
/// assert_eq!(lead.to_string(), "1/6 in");
/// # Ok::<(), helixlock_plant::LeadError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Lead {
    /// How many of the unit; more than zero.
    pub ratio: Ratio<i64>,
    /// Of what.
    pub unit: LeadUnit,
}

/// Why a text is not a lead.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum LeadError {
    /// The number cannot be read.
    #[error("found `{found}`, expected a number such as `6`, `0.5` or `1/6` with its unit")]
    Number {
        /// The text.
        found: String,
    },
    /// It has no unit, or another one.
    #[error("found unit `{found}`, expected `mm`, `in`, `tpi` or `pi mm`")]
    Unit {
        /// The text after the number.
        found: String,
    },
    /// Zero, negative, or out of all proportion.
    #[error("out of range, expected 0.001 mm to 1000 mm")]
    Range,
}

/// Numerator and denominator stay below this, so that products of four fit 128 bits.
const LARGEST_TERM: i64 = 1_000_000_000;

impl Lead {
    /// The lead in mm, correctly rounded for metric leads.
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "numerator and denominator are below 2⁵³")]
    pub fn mm(&self) -> f64 {
        let ratio = self.rational();
        let mm = *ratio.numer() as f64 / *ratio.denom() as f64;
        if self.unit == LeadUnit::PiMm { mm * PI } else { mm }
    }

    /// The lead in mm, or in π mm for a module lead.
    #[must_use]
    pub fn rational(&self) -> Ratio<i64> {
        match self.unit {
            LeadUnit::Inch => self.ratio * Ratio::new_raw(127, 5),
            LeadUnit::Mm | LeadUnit::PiMm => self.ratio,
        }
    }
}

impl fmt::Display for Lead {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let unit = match self.unit {
            LeadUnit::Mm => "mm",
            LeadUnit::Inch => "in",
            LeadUnit::PiMm => "pi mm",
        };
        write!(f, "{} {unit}", self.ratio)
    }
}

impl FromStr for Lead {
    type Err = LeadError;

    /// Reads `"6 mm"`, `"1/6 in"`, `"6 tpi"` (threads per inch), `"0.5 pi mm"`, `"pi mm"`.
    fn from_str(text: &str) -> Result<Self, LeadError> {
        let text = text.trim();
        let end = text
            .find(|c: char| !(c.is_ascii_digit() || matches!(c, '.' | '/' | '+' | '-')))
            .unwrap_or(text.len());
        let (number, unit) = text.split_at(end);
        let words: Vec<_> = unit.split_whitespace().collect();
        let number = if number.is_empty() && words.first() == Some(&"pi") { "1" } else { number };
        let ratio =
            read_ratio(number).ok_or_else(|| LeadError::Number { found: shown(number, text) })?;
        let (ratio, unit) = match words.as_slice() {
            ["mm"] => (ratio, LeadUnit::Mm),
            ["in" | "inch"] => (ratio, LeadUnit::Inch),
            ["tpi"] if *ratio.numer() != 0 => (ratio.recip(), LeadUnit::Inch),
            ["pi" | "π", "mm"] => (ratio, LeadUnit::PiMm),
            _ => return Err(LeadError::Unit { found: unit.trim().into() }),
        };
        let lead = Self { ratio, unit };
        let sensible = *ratio.numer() > 0 && (0.001..=1000.0).contains(&lead.mm());
        if sensible { Ok(lead) } else { Err(LeadError::Range) }
    }
}

/// What to show of a text whose number could not be read.
fn shown(number: &str, text: &str) -> String {
    if number.is_empty() { text.into() } else { number.into() }
}

/// `"3"`, `"0.5"`, `"1/6"` as an exact ratio.
fn read_ratio(text: &str) -> Option<Ratio<i64>> {
    let (numerator, denominator) = text.split_once('/').unwrap_or((text, "1"));
    let (numerator, denominator) = (read_decimal(numerator)?, read_decimal(denominator)?);
    if *denominator.numer() == 0 {
        return None;
    }
    let ratio = numerator / denominator;
    (ratio.numer().abs() < LARGEST_TERM && *ratio.denom() < LARGEST_TERM).then_some(ratio)
}

/// `"-12.75"` as an exact ratio, of at most nine digits.
fn read_decimal(text: &str) -> Option<Ratio<i64>> {
    let (whole, fraction) = text.split_once('.').unwrap_or((text, ""));
    let digits = format!("{whole}{fraction}");
    let unsigned = digits.trim_start_matches(['+', '-']);
    let plain = !unsigned.is_empty() && unsigned.bytes().all(|byte| byte.is_ascii_digit());
    if !plain || 9 < unsigned.len() || 1 < digits.len() - unsigned.len() {
        return None;
    }
    let places = u32::try_from(fraction.len()).ok()?;
    Some(Ratio::new(digits.parse().ok()?, 10_i64.pow(places)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lead(text: &str) -> Lead {
        text.parse().expect(text)
    }

    #[test]
    fn leads_of_document_1_are_exact() {
        assert_eq!(lead("6 mm").rational(), Ratio::new(6, 1));
        assert_eq!(lead("1/6 in").rational(), Ratio::new(127, 30));
        assert_eq!(lead("0.5 pi mm").rational(), Ratio::new(1, 2));
        assert_eq!(lead("0.5 pi mm").mm().to_bits(), std::f64::consts::FRAC_PI_2.to_bits());
    }

    #[test]
    fn other_spellings_of_the_same_lead() {
        assert_eq!(lead("6 tpi"), lead("1/6 inch"));
        assert_eq!(lead("pi mm"), lead("1.0 π mm"));
        assert_eq!(lead("12.70 mm").rational(), lead("1/2 in").rational());
    }

    #[test]
    fn what_is_no_lead_is_refused() {
        for text in ["", "6", "mm", "six mm", "6 s", "0 mm", "-6 mm", "1/0 mm", "6 mm mm", "1e3 mm"]
        {
            assert!(text.parse::<Lead>().is_err(), "{text}");
        }
        assert_eq!("2000 mm".parse::<Lead>(), Err(LeadError::Range));
        assert_eq!(
            "0 tpi".parse::<Lead>().map_err(|e| e.to_string()),
            Err("found unit `tpi`, expected `mm`, `in`, `tpi` or `pi mm`".into())
        );
    }
}
