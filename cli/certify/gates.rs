//! The figures gate by gate, in words.

use std::io::Write;

use helixlock_original::Hazard;
use helixlock_sim::blocks::BlockCheck;
use helixlock_sim::{Drawn, WholeGates};
use helixlock_traces::Table;

use crate::shared::trace_column::trace_column;

/// Each figure against its block.
pub(crate) fn print(checks: &[BlockCheck], out: &mut dyn Write) -> anyhow::Result<()> {
    let alike = if checks.iter().all(BlockCheck::is_alike) { "alike" } else { "NOT alike" };
    writeln!(
        out,
        "\ngate by gate        the figures of the report against the blocks, the same drawn pulses \
         for both: {alike} with typical delays"
    )?;
    let drawn = checks.first().map_or(0, |check| check.drawn);
    writeln!(
        out,
        "{:8} {:24} {:>8} {:>9} {:>9} {:>11} {:>10} {:>9}",
        "figure",
        "block",
        "pulses",
        "different",
        "of sets",
        "slowest ns",
        "violations",
        "swallowed"
    )?;
    for check in checks {
        let sets = format!("{} of {drawn}", check.drawn_different);
        writeln!(
            out,
            "{:8} {:24} {:>8} {:>9} {:>9} {:>11.1} {:>10} {:>9}",
            check.figure,
            check.block,
            check.pulses,
            check.different,
            sets,
            nanoseconds(check.slowest_ps),
            check.violations,
            check.swallowed
        )?;
    }
    Ok(())
}

/// All figures together, over the pass.
pub(crate) fn print_whole(whole: &WholeGates, out: &mut impl Write) -> anyhow::Result<()> {
    let WholeGates { open, closed, .. } = whole;
    let kept = if whole.holds() { "kept" } else { "NOT kept" };
    writeln!(
        out,
        "\nthe whole original  {} gates and flip-flops, {} changes; bound, a clock and the ripple of \
         the decades, {:.1} ns: {kept}",
        whole.parts,
        whole.events,
        1e9 * whole.bound_s
    )?;
    writeln!(
        out,
        "loop open           {} comparisons, at most {:.1} ns apart; {:.1} ns where both pulses \
         overlap, bound {:.1} ns",
        open.comparisons,
        1e9 * open.largest_s,
        1e9 * open.largest_at_ends_s,
        1e9 * whole.bound_at_ends_s
    )?;
    super::text::print_other_decisions(open, out)?;
    writeln!(
        out,
        "loop closed         {} comparisons and {} steps; tables at most {} steps apart, bound {}",
        closed.comparisons, closed.steps_taken, closed.largest_steps, closed.bound_steps
    )?;
    writeln!(
        out,
        "tables alike        in {} comparisons, the widths then at most {:.1} ns apart",
        closed.alike,
        1e9 * closed.alike_largest_s
    )?;
    writeln!(out, "reset counter       {} steps off what the motor did", whole.miscounted)?;
    writeln!(
        out,
        "data sheets         {} pulses too short, {} swallowed by a gate",
        whole.violations, whole.swallowed
    )?;
    Ok(())
}

/// What is drawn at the gates' meter.
pub(crate) fn trace(drawn: &Drawn) -> Table {
    Table::new(vec![
        trace_column("time_s", &drawn.time_s),
        trace_column("position_mm", &drawn.position_mm),
        trace_column("error_um", &drawn.error_um),
    ])
}

/// Where the gates can go wrong.
pub(crate) fn print_hazards(hazards: &[Hazard], out: &mut impl Write) -> anyhow::Result<()> {
    writeln!(out, "\nhazards             found by turning one number until it happens")?;
    hazards.iter().try_for_each(|hazard| print_hazard(hazard, out))
}

fn print_hazard(hazard: &Hazard, out: &mut impl Write) -> anyhow::Result<()> {
    writeln!(out, "fig. {}: {}", hazard.figure, hazard.what)?;
    let begins = begins(hazard);
    let given_ns = nanoseconds(hazard.given_ps);
    writeln!(out, "    {}: {begins}; a device has {given_ns:.1} ns", hazard.turned)?;
    let verdict = if hazard.is_kept_away() { "kept away by" } else { "POSSIBLE; against it:" };
    writeln!(out, "    {verdict} {}", hazard.kept_away_by)?;
    Ok(())
}

/// Where it happens.
pub(super) fn begins(hazard: &Hazard) -> String {
    match (hazard.begins_ps.map(nanoseconds), hazard.above) {
        (None, _) => "never in what was tried".to_owned(),
        (Some(begins_ns), true) => format!("from {begins_ns:.1} ns up"),
        (Some(begins_ns), false) => format!("below {begins_ns:.1} ns"),
    }
}

#[expect(clippy::cast_precision_loss, reason = "at most seconds, to the picosecond")]
pub(super) fn nanoseconds(ps: u64) -> f64 {
    ps as f64 / 1e3
}
