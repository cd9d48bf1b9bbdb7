//! Columns of an effect at the places of its grid.

use std::sync::Arc;

use helixlock_plant::Formula;

use super::candidates::Candidate;
use crate::model::{Columns, Component, GridColumns, Problem};
use crate::numerics::in_parallel;

/// Most values kept of one effect: 64 MiB.
const MOST_VALUES: usize = 1 << 23;

/// Columns at every place of a candidate's grid, from memory if they are there.
///
/// A grid of one place is not worth it, and may be that of a twin with other priors.
#[must_use]
pub(crate) fn on_grid(problem: &Problem, candidate: &Candidate) -> GridColumns {
    let kind = match &candidate.term.formula {
        Formula::Card(card) => Some(card.kind),
        Formula::Custom(_) | Formula::Curve(_) => None,
    };
    let width = candidate.term.priors().len();
    let values = candidate.grid.len() * width * problem.samples.len();
    let at = |point| usable(problem, &Component::new(candidate.at(point)));
    let make = || Arc::new(in_parallel(0..candidate.grid.len(), at));
    match kind.filter(|_| 1 < candidate.grid.len() && values <= MOST_VALUES) {
        Some(kind) => {
            let key = (kind, candidate.term.instead_of, width);
            problem.designs.of(key, &candidate.grid, make)
        }
        None => make(),
    }
}

/// Columns of a component; `None` when they cannot be made or say nothing.
#[must_use]
pub(crate) fn usable(problem: &Problem, component: &Component) -> Option<Columns> {
    let columns = Columns::of(problem, std::slice::from_ref(component)).ok()?;
    columns.raw.iter().all(|column| is_usable(column)).then_some(columns)
}

/// Smallest swing, µm, of a column that says anything: what lies below is the far end of a bump
/// outside the data, and would ask for coefficients of hundreds of digits.
const SMALLEST_SWING_UM: f64 = 1e-12;

fn is_usable(column: &[f64]) -> bool {
    // Four lanes, so that no comparison waits for the one before.
    let (mut low, mut high) = ([f64::INFINITY; 4], [f64::NEG_INFINITY; 4]);
    for values in column.chunks(4) {
        for (lane, value) in values.iter().enumerate() {
            if !value.is_finite() {
                return false;
            }
            low[lane] = if *value < low[lane] { *value } else { low[lane] };
            high[lane] = if high[lane] < *value { *value } else { high[lane] };
        }
    }
    let low = low.into_iter().fold(f64::INFINITY, f64::min);
    let swing_um = high.into_iter().fold(f64::NEG_INFINITY, f64::max) - low;
    swing_um <= 0.0 || SMALLEST_SWING_UM < swing_um
}
