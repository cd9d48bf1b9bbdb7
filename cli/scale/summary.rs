//! What `helixlock scale` says, as JSON and for people.

use std::io::Write;
use std::path::{Path, PathBuf};

use helixlock_metrology::iso230::{AxisResult, Vdi3441};
use helixlock_metrology::scale::{Corrected, CorrectionTable, IMAGE_BYTES, Joint, Spread};
use helixlock_metrology::{Conformity, conformity};
use serde_json::{Value, json};

use super::samples::axis_result;
use super::spread_json;

/// Errors before and after compensation.
pub(crate) struct Comparison {
    /// The file.
    pub(crate) path: PathBuf,
    /// Every sample.
    pub(crate) corrected: Vec<Corrected>,
    /// Spread before.
    pub(crate) before: Spread,
    /// Spread after.
    pub(crate) after: Spread,
    /// ISO 230-2 before and after, or why not.
    pub(crate) axis: Result<[AxisResult; 2], String>,
}

/// An ISO 230-2 test with its limit.
pub(crate) struct AxisTest {
    /// Largest accuracy A allowed, µm.
    pub(crate) limit_um: Option<f64>,
    /// Expanded uncertainty of A (k = 2), µm.
    pub(crate) expanded_um: Option<f64>,
    /// What was found.
    pub(crate) found: AxisResult,
}

impl Comparison {
    /// Compares what was measured with what is left.
    pub(crate) fn new(path: &Path, corrected: Vec<Corrected>) -> Self {
        let spread = |error: fn(&Corrected) -> f64| {
            Spread::of(&corrected.iter().map(error).collect::<Vec<_>>())
        };
        let (before, after) = (spread(|one| one.sample.error_um), spread(|one| one.left_um));
        let axis = |error: fn(&Corrected) -> f64| {
            axis_result(corrected.iter().map(|one| (one.sample, error(one))))
        };
        let both = axis(|one| one.sample.error_um)
            .and_then(|before| axis(|one| one.left_um).map(|after| [before, after]));
        let axis = both.map_err(|error| error.to_string());
        Self { path: path.to_owned(), before, after, axis, corrected }
    }

    /// Samples the table does not reach.
    fn outside(&self) -> usize {
        self.corrected.iter().filter(|one| one.correction_um.is_none()).count()
    }
}

impl AxisTest {
    /// True when there is no limit or it is kept; proven so where the uncertainty is known.
    pub(crate) fn holds(&self) -> bool {
        let kept = self.limit_um.is_none_or(|limit| self.found.accuracy_um <= limit);
        self.conformity().map_or(kept, |found| found == Conformity::Proven)
    }

    /// The decision by ISO 14253-1; absent without a limit or an uncertainty.
    fn conformity(&self) -> Option<Conformity> {
        let (limit_um, expanded_um) = self.limit_um.zip(self.expanded_um)?;
        Some(conformity(self.found.accuracy_um, limit_um, expanded_um))
    }
}

/// A built table as JSON.
pub(crate) fn built_json(table: &CorrectionTable, joints: &[Joint], samples: usize) -> Value {
    let joints: Vec<Value> =
        joints.iter().map(|j| json!({ "at_mm": j.at_mm, "step_um": j.step_um })).collect();
    json!({
        "samples": samples,
        "start_mm": table.start_mm,
        "step_mm": table.step_mm,
        "lsb_um": table.lsb_um,
        "places": table.forward.len(),
        "directions": if table.backward.is_empty() { 1 } else { 2 },
        "image_bytes": IMAGE_BYTES,
        "joints": joints,
        "forward_um": in_um(table, &table.forward),
        "backward_um": in_um(table, &table.backward),
    })
}

fn in_um(table: &CorrectionTable, codes: &[i8]) -> Vec<f64> {
    // To the nanometre, as the image stores the LSB.
    let um = |code: &i8| (f64::from(*code) * table.lsb_um * 1000.0).round() / 1000.0;
    codes.iter().map(um).collect()
}

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

/// A comparison as JSON.
pub(crate) fn applied_json(comparison: &Comparison, limit_um: Option<f64>) -> Value {
    let axis = comparison.axis.as_ref();
    json!({
        "samples": comparison.corrected.len(),
        "outside_table": comparison.outside(),
        "before": spread_json(&comparison.before),
        "after": spread_json(&comparison.after),
        "limit_um": limit_um,
        "holds": limit_um.map(|limit| comparison.after.largest_um <= limit),
        "iso230_before": axis.ok().map(|[before, _]| axis_values(before)),
        "iso230_after": axis.ok().map(|[_, after]| axis_values(after)),
        "iso230_missing": axis.err(),
    })
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
        let verdict = if comparison.after.largest_um <= limit { "holds" } else { "is exceeded" };
        writeln!(out, "limit {limit} µm {verdict}")?;
    }
    Ok(())
}

/// An ISO 230-2 test as JSON.
pub(crate) fn axis_json(test: &AxisTest) -> Value {
    let targets = test.found.targets.iter().map(|target| {
        json!({
            "at_mm": target.at_mm,
            "mean_forward_um": target.mean_forward_um,
            "mean_backward_um": target.mean_backward_um,
            "s_forward_um": target.s_forward_um,
            "s_backward_um": target.s_backward_um,
            "reversal_um": target.reversal_um,
            "repeatability_um": target.repeatability_um,
        })
    });
    let mut value = axis_values(&test.found);
    value["limit_um"] = json!(test.limit_um);
    value["expanded_uncertainty_um"] = json!(test.expanded_um);
    value["conformity"] = json!(test.conformity().map(Conformity::name));
    value["holds"] = json!(test.limit_um.map(|_| test.holds()));
    value["targets"] = targets.collect();
    value
}

fn axis_values(found: &AxisResult) -> Value {
    json!({
        "accuracy_um": found.accuracy_um,
        "accuracy_forward_um": found.accuracy_unidirectional_um[0],
        "accuracy_backward_um": found.accuracy_unidirectional_um[1],
        "systematic_um": found.systematic_um,
        "systematic_forward_um": found.systematic_unidirectional_um[0],
        "systematic_backward_um": found.systematic_unidirectional_um[1],
        "mean_range_um": found.mean_range_um,
        "reversal_um": found.reversal_um,
        "mean_reversal_um": found.mean_reversal_um,
        "repeatability_um": found.repeatability_um,
        "repeatability_forward_um": found.repeatability_unidirectional_um[0],
        "repeatability_backward_um": found.repeatability_unidirectional_um[1],
        "vdi3441": found.vdi3441.map(|vdi| json!({
            "p_um": vdi.uncertainty_um,
            "pa_um": vdi.deviation_um,
            "u_max_um": vdi.reversal_um[0],
            "u_mean_um": vdi.reversal_um[1],
            "ps_max_um": vdi.scatter_um[0],
            "ps_mean_um": vdi.scatter_um[1],
        })),
    })
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
            None if test.holds() => "holds".into(),
            None => "is exceeded".into(),
        };
        writeln!(out, "limit {limit} µm {verdict}")?;
    }
    Ok(())
}
