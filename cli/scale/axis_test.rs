//! An ISO 230-2 test against what it has to keep.

use helixlock_metrology::Conformity;
use helixlock_metrology::iso230::AxisResult;

use crate::shared::sheet::{Line, Sheet};

/// What was found, and what it is held against.
pub(crate) struct AxisTest {
    /// What was found.
    pub(crate) found: AxisResult,
    /// The figures with their uncertainty and tolerances, A first.
    pub(crate) sheet: Sheet,
    /// True when a file told of the measurement.
    pub(crate) told: bool,
    /// What a reader of the result must know.
    pub(crate) notes: Vec<String>,
}

impl AxisTest {
    /// True when there is no limit or it is kept; proven so where the uncertainty is known.
    pub(crate) fn holds(&self) -> bool {
        self.sheet.holds()
    }

    /// Largest accuracy A allowed, µm.
    pub(crate) fn limit_um(&self) -> Option<f64> {
        self.accuracy()?.tolerance_um
    }

    /// Expanded uncertainty of A, µm.
    pub(crate) fn expanded_um(&self) -> Option<f64> {
        Some(self.accuracy()?.budget.as_ref()?.expanded_um())
    }

    /// The decision on A by ISO 14253-1; absent without a limit or an uncertainty.
    pub(crate) fn conformity(&self) -> Option<Conformity> {
        self.accuracy()?.conformity()
    }

    fn accuracy(&self) -> Option<&Line> {
        self.sheet.lines.first()
    }
}
