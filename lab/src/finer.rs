//! The samples behind a thinned measurement, for what a mean or a choice does not stand for.

use std::ops::Range;

use helixlock_plant::Record;
use helixlock_plant::prediction::Prediction;

use crate::measurement::means;

/// A record and the groups of its samples that were averaged, or chosen as groups of one.
///
/// A formula of the mean is not the mean of a formula: a jump in the error, as the meter's dead
/// zone makes it, is smeared in one and lost in the other. And the error counts from the first
/// sample of each pass, which may not be among those chosen.
#[derive(Debug, Clone)]
pub struct Finer {
    /// All samples.
    pub record: Record,
    /// Which of them make up each mean.
    pub groups: Vec<Range<usize>>,
}

impl Finer {
    /// Means of values that belong to all samples.
    #[must_use]
    pub fn means(&self, values: &[f64]) -> Vec<f64> {
        means(values, &self.groups)
    }

    /// Means of a prediction for all samples.
    #[must_use]
    pub fn mean_of(&self, whole: &Prediction) -> Prediction {
        Prediction {
            error_um: self.means(&whole.error_um),
            steps: self.means(&whole.steps),
            lead_error_um: self.means(&whole.lead_error_um),
        }
    }
}
