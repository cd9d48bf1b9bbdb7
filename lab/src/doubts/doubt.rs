//! What is said of a mistake.

use std::f64::consts::LN_2;

use crate::model::Problem;
use crate::numerics::count;

/// A mistake that explains the data better than any effect.
#[derive(Debug, Clone, PartialEq)]
pub struct Doubt {
    /// What kind of mistake: `position-for-error`, `sign`, `unit`, `swap`, `shift`, `phase`, `dividers`, `lead`,
    /// `gear`, `scale`, `reversed`, `another-machine`, `clock`, `copy`, `cut-off`, `stuck`.
    pub what: &'static str,
    /// Evidence against the next best explanation, in units of twice the log likelihood.
    pub evidence: f64,
    /// The mistake in a sentence.
    pub says: String,
    /// The line that puts it right: of a recipe for a column, of the machine file for a setting.
    pub mend: String,
}

/// A mistake that the file's own effects at other sizes, or further ones, may explain as well: to be held
/// against those that are found.
#[derive(Debug)]
pub(crate) struct Suspect {
    /// What is said of it.
    pub(crate) doubt: Doubt,
    /// The problem with the mistake put right.
    pub(crate) mended: Problem,
    /// By what that changes the prediction, against the observations as they were read.
    pub(crate) change: Vec<f64>,
    /// What it pays for its numbers and where it was looked for.
    pub(crate) price: f64,
    /// What it pays for being one of a list; nothing in the place of a name, which is one of a list, too.
    pub(crate) listed: f64,
    /// By how much it is ahead of the file's own effects at any size on one of several sensors, which no search
    /// finds.
    pub(crate) of_one_sensor: f64,
}

/// Evidence of rows that each say so by accident no oftener than every second time.
pub(super) fn said_by(rows: usize) -> f64 {
    2.0 * LN_2 * count(rows)
}

/// The part of an import's recipe that reads a column otherwise.
pub(super) fn recipe(column: &str, how: &str) -> String {
    format!("[[column]]\nfrom = \"{column}\"\nto = \"{column}\"\n{how}")
}

/// What is to be done where that is so of one pass only, which no recipe tells apart.
pub(super) fn of_pass_read(column: &str, pass: f64, how: &str) -> String {
    format!("read `{column}` of pass {pass} with {}", how.replace('\n', " and "))
}
