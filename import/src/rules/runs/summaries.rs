//! Columns that sum the runs beside them up: their means, their scatter, the figures of a standard.

use super::Found;
use crate::data;
use crate::decide::Decisions;
use crate::error::quoted;
use crate::rules::{Candidate, NONE};
use crate::statistic;

/// How near to what it sums up a column is, as part of how far the runs scatter: as a rounded one is
/// where they scatter by a few of its last digits. One that is a run lies as far from their mean as they.
const NEAR: f64 = 0.1;

/// True for a column that sums others up by its name, and in a unit that a run may have.
pub(super) fn is_one(candidate: &Candidate<'_>) -> bool {
    let fits = |unit: &str| ["length", "angle"].iter().any(|kind| data::unit(unit, kind).is_some());
    candidate.rule.pass.is_none()
        && ["", "error", "angular error", "actual", "position"].contains(&candidate.meaning())
        && candidate.header.unit.as_deref().is_none_or(fits)
        && statistic::names(&candidate.header.bare)
}

/// Leaves out what sums the runs up. Where no run stands beside them, means are what was measured.
pub(super) fn part(
    candidates: &mut [Candidate<'_>],
    found: &mut Vec<Found>,
    summaries: &[usize],
    decisions: &mut Decisions<'_>,
) {
    let direction = |at: usize| candidates[at].header.run.and_then(|run| run.direction);
    let mut left_out: Vec<usize> = summaries.to_vec();
    if found.len() < 2 {
        let is_run = |at: &usize| {
            statistic::is_mean(&candidates[*at].header.bare) && direction(*at).is_some()
        };
        if !left_out.iter().any(is_run) {
            return;
        }
        let means = left_out.iter().copied().filter(is_run);
        found.extend(means.map(|at| (at, None, direction(at))));
        left_out.retain(|at| !is_run(at) && direction(*at).is_some());
    }
    let nameless: Vec<usize> =
        found.iter().map(|(at, ..)| *at).filter(|at| sums_up(candidates, found, *at)).collect();
    found.retain(|(at, ..)| !nameless.contains(at));
    left_out.extend(nameless);
    left_out.sort_unstable();
    let Some(first) = left_out.first() else { return };
    let name = quoted(&candidates[*first].header.name);
    decisions.note(match left_out.len() {
        1 => format!("column {name} sums the runs up and is left out"),
        number => format!("{number} columns sum the runs up and are left out, first {name}"),
    });
    for at in left_out {
        candidates[at].decide(NONE, "it sums the runs up, and is none");
    }
}

/// True for a column without a number, beside others that have one, which holds the mean of these or
/// their standard deviation, whatever it is called.
fn sums_up(candidates: &[Candidate<'_>], found: &[Found], at: usize) -> bool {
    let has_digit = |at: usize| candidates[at].header.bare.contains(|c: char| c.is_ascii_digit());
    let Some((_, number, direction)) = found.iter().find(|(other, ..)| *other == at) else {
        return false;
    };
    let candidate = &candidates[at];
    if number.is_some() || has_digit(at) || candidate.rule.pass.is_some() {
        return false;
    }
    let runs: Vec<&[f64]> = found
        .iter()
        .filter(|(other, _, way)| *other != at && way == direction && has_digit(*other))
        .map(|(other, ..)| candidates[*other].samples.values.as_slice())
        .collect();
    if runs.len() < 2 {
        return false;
    }
    let (mut from_mean, mut from_s, mut squares) = (Vec::new(), Vec::new(), Vec::new());
    for (row, value) in candidate.samples.values.iter().enumerate() {
        let each: Vec<f64> = runs.iter().filter_map(|run| run.get(row).copied()).collect();
        let (mean, variance) = mean_and_variance(&each);
        if value.is_finite() && variance.is_finite() {
            from_mean.push((value - mean).powi(2));
            from_s.push((value - variance.sqrt()).powi(2));
            squares.push(variance);
        }
    }
    let mean = |all: &[f64]| mean_and_variance(all).0;
    let most = NEAR * NEAR * mean(&squares);
    2 < squares.len() && 0.0 < most && (mean(&from_mean) < most || mean(&from_s) < most)
}

/// Not numbers when there are none, or one that has no variance.
fn mean_and_variance(all: &[f64]) -> (f64, f64) {
    let (count, sum) = all.iter().fold((0.0, 0.0), |(count, sum), one| (count + 1.0, sum + one));
    let mean = sum / count;
    (mean, all.iter().map(|one| (one - mean).powi(2)).sum::<f64>() / (count - 1.0))
}
