//! What is said of a scale.

use std::io::Write;
use std::path::Path;

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

/// An ISO 230-2 test for people.
pub(crate) fn print_axis(out: &mut impl Write, test: &AxisTest) -> anyhow::Result<()> {
    writeln!(out, "ISO 230-2, {} targets", test.found.targets.len())?;
    for line in test.sheet.words() {
        writeln!(out, "{line}")?;
    }
    if test.told
        && let Some(why) = test.sheet.why_without()
    {
        writeln!(out, "note: {why}")?;
    }
    for note in &test.notes {
        writeln!(out, "note: {note}")?;
    }
    Ok(())
}
