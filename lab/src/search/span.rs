//! Whether columns can draw what an effect shows.

use helixlock_plant::Column;

use crate::model::{Problem, State};
use crate::noise::about_means;
use crate::numerics::least_squares::{self, dot};

/// Sums of some columns, each pass about its mean.
pub(super) struct Span(Vec<Vec<f64>>);

impl Span {
    pub(super) fn of(problem: &Problem, columns: &[Column]) -> Self {
        Self(columns.iter().map(|column| about_means(&problem.layout, column)).collect())
    }

    /// True when one of them leaves less than a share of the square of something.
    pub(super) fn has(&self, shown: &[f64], share: f64) -> bool {
        let views: Vec<&[f64]> = self.0.iter().map(Vec::as_slice).collect();
        least_squares::fit(&views, shown).residual_square < share * dot(shown, shown)
    }
}

/// What an effect of a model shows, each pass about its mean; `None` when it cannot be worked out.
pub(super) fn shown(problem: &Problem, state: &State, index: usize) -> Option<Vec<f64>> {
    let (used, _) = state.coefficients(index);
    let shown = state.components[index].shown_um(problem, used)?;
    Some(about_means(&problem.layout, &shown))
}
