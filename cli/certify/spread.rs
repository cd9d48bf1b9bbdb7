//! The whole original with many sets of delays, in words.

use std::io::Write;

use helixlock_original::Corner;
use helixlock_sim::{DelaySet, WholeGates};

/// All sets together, and the first that does not keep its bounds.
pub(crate) fn print(sets: &[(DelaySet, WholeGates)], out: &mut impl Write) -> anyhow::Result<()> {
    let kept = sets.iter().filter(|(_, gates)| gates.holds()).count();
    writeln!(
        out,
        "\nsets of delays      all shortest, all longest, {} drawn; bounds kept in {kept} of {}",
        sets.len().saturating_sub(2),
        sets.len()
    )?;
    let most =
        |of: fn(&WholeGates) -> f64| sets.iter().map(|(_, gates)| of(gates)).fold(0.0, f64::max);
    writeln!(
        out,
        "loop open           at most {:.1} ns apart; {:.1} ns where both pulses overlap",
        1e9 * most(|gates| gates.open.largest_s),
        1e9 * most(|gates| gates.open.largest_at_ends_s)
    )?;
    writeln!(
        out,
        "other decisions     {}, the laser's edge at most {:.1} ns from a coincidence",
        sets.iter().map(|(_, gates)| gates.open.other_decisions).sum::<usize>(),
        1e9 * most(|gates| gates.open.other_decision_s)
    )?;
    writeln!(
        out,
        "loop closed         tables at most {} steps = {:.4} um apart; alike, the widths at most \
         {:.1} ns",
        sets.iter().map(|(_, gates)| gates.closed.largest_steps).max().unwrap_or(0),
        most(|gates| gates.closed.largest_um),
        1e9 * most(|gates| gates.closed.alike_largest_s)
    )?;
    writeln!(
        out,
        "reset counter       off in {} sets, by at most {} steps",
        sets.iter().filter(|(_, gates)| 0 < gates.miscounted).count(),
        sets.iter().map(|(_, gates)| gates.miscounted).max().unwrap_or(0)
    )?;
    if let Some((set, _)) = sets.iter().find(|(_, gates)| !gates.holds()) {
        writeln!(out, "first not kept      {}", name(*set))?;
    }
    Ok(())
}

fn name(set: DelaySet) -> String {
    match set {
        DelaySet::Corner(Corner::Shortest) => "all shortest".into(),
        DelaySet::Corner(Corner::Typical) => "all typical".into(),
        DelaySet::Corner(Corner::Longest) => "all longest".into(),
        DelaySet::Drawn(seed) => format!("`--gates={seed}`"),
    }
}
