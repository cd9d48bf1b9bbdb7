//! Sets of delays as rows of numbers, and back: the typical ones first, then those that were drawn.

use anyhow::Context;
use helixlock_sim::blocks::{BlockCheck, Seen, Spread, figures};
use helixlock_traces::Table;

use crate::shared::cases::cells;

/// What is kept of a figure.
const OF_A_FIGURE: [&str; 5] = ["pulses", "different", "slowest_ps", "violations", "swallowed"];

/// Names of the cells of a row: each figure's.
pub(super) fn columns() -> Vec<String> {
    let of_figure = |(figure, block): (&str, &str)| {
        let figure = figure.replace(' ', "_");
        OF_A_FIGURE.map(|word| format!("{block}_figure_{figure}_{word}"))
    };
    figures().flat_map(of_figure).collect()
}

/// The row of a set.
#[expect(clippy::cast_precision_loss, reason = "counts of fewer than 2⁵³ pulses")]
pub(super) fn cells_of(set: &[Seen]) -> Vec<f64> {
    let of_figure = |seen: &Seen| {
        [seen.pulses, seen.different, seen.slowest_ps, seen.violations, seen.swallowed]
    };
    set.iter().flat_map(of_figure).map(|count| count as f64).collect()
}

/// The figures, with all sets of a table.
pub(super) fn checks_of(table: &Table, spread: &Spread) -> anyhow::Result<Vec<BlockCheck>> {
    let mut checks: Vec<BlockCheck> =
        figures().map(|(figure, block)| BlockCheck::new(figure, block)).collect();
    for (place, cells) in (0_u64..).zip(cells(table)) {
        let set = read(&cells).filter(|set| set.len() == checks.len());
        let set = set.with_context(|| {
            format!("{}: row {place} is no set of delays of these figures", table.path.display())
        })?;
        for (check, seen) in checks.iter_mut().zip(&set) {
            check.add(spread, place, seen);
        }
    }
    Ok(checks)
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "whole numbers that were written as such; a cast saturates"
)]
fn read(cells: &[f64]) -> Option<Vec<Seen>> {
    let whole = |count: f64| count as u64;
    let seen = cells.chunks(OF_A_FIGURE.len()).map(|counts| {
        let &[pulses, different, slowest_ps, violations, swallowed] = counts else {
            return None;
        };
        Some(Seen {
            pulses: whole(pulses),
            different: whole(different),
            slowest_ps: whole(slowest_ps),
            violations: whole(violations),
            swallowed: whole(swallowed),
        })
    });
    seen.collect()
}
