//! Channels of an instrument that nobody selected, which it writes as zeros.

use super::{Candidate, NONE};
use crate::decide::Decisions;
use crate::error::quoted;

/// What instruments call such a channel.
const NAMES: [&str; 3] = ["not selected", "unselected", "not assigned"];

/// Leaves them out, and says how many there are.
pub(super) fn left_out(candidates: &mut [Candidate<'_>], decisions: &mut Decisions<'_>) {
    let mut unused: Vec<&mut Candidate<'_>> =
        candidates.iter_mut().filter(|candidate| is_open(candidate)).collect();
    let Some(first) = unused.first() else { return };
    let name = quoted(&first.header.name);
    decisions.note(match unused.len() {
        1 => format!("column {name} is zero throughout and left out, as its name says"),
        number => format!(
            "{number} columns are zero throughout and left out, as their names say, first {name}"
        ),
    });
    for candidate in &mut unused {
        candidate.decide(NONE, "not selected, and zero throughout");
    }
}

fn is_open(candidate: &Candidate<'_>) -> bool {
    candidate.rule.to.is_none() && is_unused(candidate)
}

/// True for a column of zeros whose name says that nobody selected it.
pub(super) fn is_unused(candidate: &Candidate<'_>) -> bool {
    let name = candidate.header.name.to_lowercase();
    NAMES.iter().any(|unused| name.contains(unused))
        && candidate.samples.values.iter().all(|value| value.abs() <= 0.0)
}
