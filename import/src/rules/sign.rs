//! The sign of an error that stands beside target and actual position: they show it.

use super::Candidate;
use crate::error::quoted;
use crate::samples::Holds;

/// Values that mean the same move together, whatever was rounded or corrected in them.
const ALIKE: f64 = 0.9;

/// Gives errors the sign that target and actual show; a sign that a recipe says stays.
pub(super) fn shown(candidates: &mut [Candidate<'_>], target: usize, actual: usize) {
    let [aimed_at, came_to] = [&candidates[target], &candidates[actual]];
    let turned = [aimed_at, came_to].iter().any(|place| place.rule.sign.is_some());
    let units =
        [aimed_at, came_to].map(|place| place.rule.unit.as_ref().or(place.header.unit.as_ref()));
    if turned || units[0] != units[1] {
        return;
    }
    let behind: Vec<f64> = aimed_at
        .samples
        .values
        .iter()
        .zip(&came_to.samples.values)
        .map(|(target, actual)| target - actual)
        .collect();
    let names = [came_to, aimed_at].map(|place| quoted(&place.header.name));
    for error in candidates.iter_mut().filter(|candidate| is_error(candidate)) {
        let alike = likeness(&behind, &error.samples.values);
        if ALIKE < alike.abs() {
            error.rule.sign = Some(if alike < 0.0 { -1 } else { 1 });
            let shown = if alike < 0.0 { "it is" } else { "it is the reverse of" };
            error.rule.reason =
                format!("{shown} {} minus {}, as its rows show", names[0], names[1]);
        }
    }
}

fn is_error(candidate: &Candidate<'_>) -> bool {
    matches!(candidate.meaning(), "error" | "angular error")
        && candidate.samples.holds == Holds::Numbers
        && candidate.rule.sign.is_none()
        && candidate.rule.minus.is_none()
}

/// Correlation of what both have; 0 where one of them rests.
fn likeness(one: &[f64], other: &[f64]) -> f64 {
    let pairs: Vec<(f64, f64)> = one
        .iter()
        .zip(other)
        .filter(|(a, b)| a.is_finite() && b.is_finite())
        .map(|(a, b)| (*a, *b))
        .collect();
    let mean =
        |pick: fn(&(f64, f64)) -> f64| pairs.iter().map(pick).sum::<f64>() / count(pairs.len());
    let (a, b) = (mean(|pair| pair.0), mean(|pair| pair.1));
    let sum = |product: &dyn Fn(f64, f64) -> f64| {
        pairs.iter().map(|(x, y)| product(x - a, y - b)).sum::<f64>()
    };
    let spread = sum(&|x, _| x * x) * sum(&|_, y| y * y);
    if 0.0 < spread { sum(&|x, y| x * y) / spread.sqrt() } else { 0.0 }
}

#[expect(clippy::cast_precision_loss, reason = "rows are far below 2⁵³")]
fn count(rows: usize) -> f64 {
    rows as f64
}
