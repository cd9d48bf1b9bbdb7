//! What is said of a mistake.

use std::f64::consts::LN_2;

use crate::numerics::count;

/// A mistake that explains the data better than any effect.
#[derive(Debug, Clone, PartialEq)]
pub struct Doubt {
    /// What kind of mistake: `position-for-error`, `sign`, `unit`, `swap`, `shift`, `dividers`, `another-machine`.
    pub what: &'static str,
    /// Evidence against the next best explanation, in units of twice the log likelihood.
    pub evidence: f64,
    /// The mistake in a sentence.
    pub says: String,
    /// The line that puts it right: of a recipe for a column, of the machine file for a setting.
    pub mend: String,
}

/// Evidence of rows that each say so by accident no oftener than every second time.
pub(super) fn said_by(rows: usize) -> f64 {
    2.0 * LN_2 * count(rows)
}

/// The part of an import's recipe that reads a column otherwise.
pub(super) fn recipe(column: &str, how: &str) -> String {
    format!("[[column]]\nfrom = \"{column}\"\nto = \"{column}\"\n{how}")
}
