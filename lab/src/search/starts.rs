//! What passes began with, without the effect that delays.
//!
//! What dies away behind the start of a pass need not be a recorder that had followed the machine: an oil film,
//! a door, a fresh wheel do so, too. An effect that delays is worth what it explains beyond that.

use crate::hypotheses::candidate;
use crate::model::{Component, Problem, Stage, State, price_of_starts, settle_beside};
use crate::noise::Noise;

/// Evidence of first values that die away, beside a model and without the effect itself, at the time constant
/// that suits them best; 0 where they are not worth their price, or the effect leaves none open.
#[must_use]
pub(super) fn worth_alone(
    problem: &Problem,
    now: &State,
    component: &Component,
    noises: &[Noise],
) -> f64 {
    if component.starts() == 0 {
        return 0.0;
    }
    let stage = Stage::new(problem, &now.columns, noises);
    let Some(anywhere) = candidate(&stage, component.term.clone()) else { return 0.0 };
    let places = (0..anywhere.grid.len()).map(|point| Component::new(anywhere.at(point)));
    let priced = places.filter_map(|one| {
        let starts = one.starts_alone(problem).ok()?;
        Some((stage.gain(&starts).gain, price_of_starts(problem, &starts), starts))
    });
    let best = priced.max_by(|a, b| (a.0 - a.1).total_cmp(&(b.0 - b.1)));
    let Some((_, price, starts)) = best else { return 0.0 };
    let with_them = now.columns.and(&starts);
    let fit = settle_beside(problem, &with_them, noises, &now.fit.noises);
    let gain = 2.0 * (fit.log_likelihood - now.fit.log_likelihood);
    (gain - price).max(0.0)
}
