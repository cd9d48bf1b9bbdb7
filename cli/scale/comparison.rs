//! Errors of a scale before and after compensation.

use std::path::{Path, PathBuf};

use helixlock_metrology::iso230::AxisResult;
use helixlock_metrology::scale::{Corrected, Spread};

use super::samples::axis_result;

/// Errors before and after compensation.
pub(crate) struct Comparison {
    /// The file.
    pub(crate) path: PathBuf,
    /// Every sample.
    pub(crate) corrected: Vec<Corrected>,
    /// Spread before.
    pub(crate) before: Spread,
    /// Spread after.
    pub(crate) after: Spread,
    /// ISO 230-2 before and after, or why not.
    pub(crate) axis: Result<[AxisResult; 2], String>,
}

impl Comparison {
    /// Compares what was measured with what is left.
    pub(crate) fn new(path: &Path, corrected: Vec<Corrected>) -> Self {
        let spread = |error: fn(&Corrected) -> f64| {
            Spread::of(&corrected.iter().map(error).collect::<Vec<_>>())
        };
        let (before, after) = (spread(|one| one.sample.error_um), spread(|one| one.left_um));
        let axis = |error: fn(&Corrected) -> f64| {
            axis_result(corrected.iter().map(|one| (one.sample, error(one))))
        };
        let both = axis(|one| one.sample.error_um)
            .and_then(|before| axis(|one| one.left_um).map(|after| [before, after]));
        let axis = both.map_err(|error| error.to_string());
        Self { path: path.to_owned(), before, after, axis, corrected }
    }

    /// Samples the table does not reach.
    pub(crate) fn outside(&self) -> usize {
        self.corrected.iter().filter(|one| one.correction_um.is_none()).count()
    }

    /// True when no error left is beyond a limit.
    pub(crate) fn keeps(&self, limit_um: f64) -> bool {
        self.after.largest_um <= limit_um
    }
}
