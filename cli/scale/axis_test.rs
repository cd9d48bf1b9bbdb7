//! An ISO 230-2 test against a limit.

use helixlock_metrology::iso230::AxisResult;
use helixlock_metrology::{Conformity, conformity};

/// What was found, and what it is held against.
pub(crate) struct AxisTest {
    /// Largest accuracy A allowed, µm.
    pub(crate) limit_um: Option<f64>,
    /// Expanded uncertainty of A (k = 2), µm.
    pub(crate) expanded_um: Option<f64>,
    /// What was found.
    pub(crate) found: AxisResult,
}

impl AxisTest {
    /// True when there is no limit or it is kept; proven so where the uncertainty is known.
    pub(crate) fn holds(&self) -> bool {
        let kept = self.limit_um.is_none_or(|limit| self.found.accuracy_um <= limit);
        self.conformity().map_or(kept, |found| found == Conformity::Proven)
    }

    /// The decision by ISO 14253-1; absent without a limit or an uncertainty.
    pub(crate) fn conformity(&self) -> Option<Conformity> {
        let (limit_um, expanded_um) = self.limit_um.zip(self.expanded_um)?;
        Some(conformity(self.found.accuracy_um, limit_um, expanded_um))
    }
}
