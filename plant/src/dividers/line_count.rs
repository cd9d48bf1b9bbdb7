//! Line counts of a grating that make a set of leads rational.
//!
//! `N/M ≈ p/q` with small `p` and `q` gives every lead `S = c/d` the dividers `B/A = S·p/q`, all
//! with the same residual, so that one setting of the compensator serves them all.

use num_rational::Ratio;

use super::{LARGEST_PRESET, fringes_per_mm};
use crate::lead::{Lead, LeadUnit};

/// A line count and the ratio it works by.
#[derive(Clone, Debug, PartialEq)]
pub struct LineCount {
    /// Lines a turn.
    pub lines: u32,
    /// `p/q`: fringes per line, for 1 mm of lead (π mm for module leads).
    pub ratio: Ratio<i64>,
    /// Residual, ppm, the same for every lead.
    pub residual_ppm: f64,
    /// Largest preset that any of the leads needs.
    pub largest_preset: i64,
}

/// Line counts from `lines` for which all leads fit the thumb wheels and leave at most
/// `tolerance_ppm`, those with the smallest presets first, then the smallest residual.
///
/// The leads must be all of one kind, metric and inch or module; otherwise the list is empty.
///
/// # Examples
///
/// The outer track of document 1:
///
/// ```
/// use helixlock_plant::dividers::find_line_counts;
///
/// let leads = ["6 mm".parse()?, "1/6 in".parse()?];
/// let found = find_line_counts(&leads, 0.632_819_83, 13_000..=14_000, 1.0);
/// assert!(found.iter().any(|count| count.lines == 13_906));
/// # Ok::<(), helixlock_plant::LeadError>(())
/// ```
#[must_use]
pub fn find_line_counts(
    leads: &[Lead],
    wavelength_um: f64,
    lines: std::ops::RangeInclusive<u32>,
    tolerance_ppm: f64,
) -> Vec<LineCount> {
    let module = |lead: &Lead| lead.unit == LeadUnit::PiMm;
    let Some(kind) = leads.first().map(module) else { return Vec::new() };
    if leads.iter().any(|lead| module(lead) != kind) {
        return Vec::new();
    }
    let unit_mm = if kind { std::f64::consts::PI } else { 1.0 };
    let fringes = unit_mm * fringes_per_mm(wavelength_um);
    let mut found: Vec<_> =
        lines.filter_map(|lines| line_count(leads, fringes, lines, tolerance_ppm)).collect();
    found.sort_by(|one, other| {
        let residuals = one.residual_ppm.abs().total_cmp(&other.residual_ppm.abs());
        one.largest_preset.cmp(&other.largest_preset).then(residuals)
    });
    found
}

/// The simplest ratio within the tolerance, if its presets fit.
fn line_count(leads: &[Lead], fringes: f64, lines: u32, tolerance_ppm: f64) -> Option<LineCount> {
    let sought = fringes / f64::from(lines);
    for q in 1..=i64::from(LARGEST_PRESET) {
        #[expect(clippy::cast_precision_loss, reason = "at most 999")]
        let p = libm::round(sought * q as f64);
        #[expect(clippy::cast_precision_loss, reason = "at most 999")]
        let residual_ppm = (p / (sought * q as f64) - 1.0) * 1e6;
        if 1.0 <= p && residual_ppm.abs() <= tolerance_ppm {
            #[expect(clippy::cast_possible_truncation, reason = "a ratio of small numbers")]
            let ratio = Ratio::new(p as i64, q);
            let largest_preset = leads.iter().map(|lead| largest(*lead, ratio)).max()?;
            let fits = largest_preset <= i64::from(LARGEST_PRESET);
            return fits.then_some(LineCount { lines, ratio, residual_ppm, largest_preset });
        }
    }
    None
}

/// The larger of the two presets of a lead.
fn largest(lead: Lead, ratio: Ratio<i64>) -> i64 {
    let (lead, ratio) = (lead.rational(), ratio);
    let wide =
        |ratio: Ratio<i64>| Ratio::new(i128::from(*ratio.numer()), i128::from(*ratio.denom()));
    let presets = wide(lead) * wide(ratio);
    i64::try_from((*presets.numer()).max(*presets.denom())).unwrap_or(i64::MAX)
}
