//! What is said of a scale.

use std::io::Write;
use std::path::Path;

use helixlock_metrology::iso230::{AxisResult, Vdi3441};
use helixlock_metrology::scale::{CorrectionTable, Joint};

use super::axis_test::AxisTest;
use super::comparison::Comparison;
use crate::shared::words;

/// A built table for people.
pub(crate) fn print_built(
    out: &mut impl Write,
    path: &Path,
    table: &CorrectionTable,
    joints: &[Joint],
) -> anyhow::Result<()> {
    let ways = if table.backward.is_empty() { "one table for both ways" } else { "each way" };
    writeln!(
        out,
        "{}: {} places of {} mm from {} mm, {ways}, {} µm a bit",
        path.display(),
        table.forward.len(),
        table.step_mm,
        table.start_mm,
        table.lsb_um
    )?;
    for joint in joints {
        writeln!(out, "joint at {} mm: step {:+.2} µm", joint.at_mm, joint.step_um)?;
    }
    Ok(())
}

/// A comparison for people.
pub(crate) fn print_applied(
    out: &mut impl Write,
    comparison: &Comparison,
    limit_um: Option<f64>,
) -> anyhow::Result<()> {
    writeln!(out, "{}: {} samples", comparison.path.display(), comparison.corrected.len())?;
    for (name, spread) in [("before", &comparison.before), ("after", &comparison.after)] {
        writeln!(
            out,
            "{name:<7} ±{:.2} µm   (half range {:.2} µm, rms {:.3} µm)",
            spread.largest_um, spread.half_range_um, spread.rms_um
        )?;
    }
    match &comparison.axis {
        Ok([before, after]) => writeln!(
            out,
            "ISO 230-2: A {:.2} → {:.2} µm, R {:.2} → {:.2} µm, E {:.2} → {:.2} µm",
            before.accuracy_um,
            after.accuracy_um,
            before.repeatability_um,
            after.repeatability_um,
            before.systematic_um,
            after.systematic_um
        )?,
        Err(why) => writeln!(out, "ISO 230-2 not evaluated: {why}")?,
    }
    if 0 < comparison.outside() {
        writeln!(out, "note: {} samples lie outside the table", comparison.outside())?;
    }
    if let Some(limit) = limit_um {
        writeln!(out, "limit {limit} µm {}", words::held(comparison.keeps(limit)))?;
    }
    Ok(())
}

/// Symbol, meaning and value of every figure, ISO 230-2 first, then VDI/DGQ 3441.
fn axis_figures(found: &AxisResult) -> Vec<(&'static str, &'static str, Option<f64>)> {
    let vdi = |figure: fn(&Vdi3441) -> f64| found.vdi3441.as_ref().map(figure);
    vec![
        ("A", "accuracy", Some(found.accuracy_um)),
        ("A↑", "accuracy, forward", found.accuracy_unidirectional_um[0]),
        ("A↓", "accuracy, backward", found.accuracy_unidirectional_um[1]),
        ("E", "systematic error", Some(found.systematic_um)),
        ("E↑", "systematic error, forward", found.systematic_unidirectional_um[0]),
        ("E↓", "systematic error, backward", found.systematic_unidirectional_um[1]),
        ("M", "range of the means", Some(found.mean_range_um)),
        ("B", "largest reversal value", found.reversal_um),
        ("B̄", "mean reversal value", found.mean_reversal_um),
        ("R", "repeatability", Some(found.repeatability_um)),
        ("R↑", "repeatability, forward", found.repeatability_unidirectional_um[0]),
        ("R↓", "repeatability, backward", found.repeatability_unidirectional_um[1]),
        ("P", "VDI/DGQ 3441 positional uncertainty", vdi(|vdi| vdi.uncertainty_um)),
        ("Pa", "VDI/DGQ 3441 positional deviation", vdi(|vdi| vdi.deviation_um)),
        ("U", "VDI/DGQ 3441 largest reversal span", vdi(|vdi| vdi.reversal_um[0])),
        ("Ps", "VDI/DGQ 3441 largest scatter", vdi(|vdi| vdi.scatter_um[0])),
    ]
}

/// An ISO 230-2 test for people.
pub(crate) fn print_axis(out: &mut impl Write, test: &AxisTest) -> anyhow::Result<()> {
    let found = &test.found;
    writeln!(out, "ISO 230-2, {} targets", found.targets.len())?;
    for (symbol, meaning, value_um) in axis_figures(found) {
        if let Some(value_um) = value_um {
            writeln!(out, "{symbol:<6} {meaning:<38} {value_um:9.3} µm")?;
        }
    }
    if let Some(limit) = test.limit_um {
        let verdict = match test.conformity() {
            Some(decision) => format!("by ISO 14253-1: conformity {}", decision.name()),
            None => words::held(test.holds()).into(),
        };
        writeln!(out, "limit {limit} µm {verdict}")?;
    }
    Ok(())
}
