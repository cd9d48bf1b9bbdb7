//! The keys of `scale … --json`; they do not change.

use helixlock_metrology::Conformity;
use helixlock_metrology::iso230::{AxisResult, TargetResult, Vdi3441};
use helixlock_metrology::scale::{CorrectionTable, IMAGE_BYTES, Joint, Residual, Spread};

use super::axis_test::AxisTest;
use super::comparison::Comparison;
use crate::shared::keys::keys;
use crate::shared::sheet::SheetJson;

keys! {
    /// A built table.
    BuiltJson(table: &CorrectionTable, joints: &[Joint], samples: usize) {
        samples: usize = samples,
        start_mm: f64 = table.start_mm,
        step_mm: f64 = table.step_mm,
        lsb_um: f64 = table.lsb_um,
        places: usize = table.forward.len(),
        directions: u32 = if table.backward.is_empty() { 1 } else { 2 },
        image_bytes: usize = IMAGE_BYTES,
        joints: Vec<JointJson> = joints.iter().map(JointJson::new).collect(),
        forward_um: Vec<f64> = in_um(table, &table.forward),
        backward_um: Vec<f64> = in_um(table, &table.backward),
    }

    JointJson(joint: &Joint) {
        at_mm: f64 = joint.at_mm,
        step_um: f64 = joint.step_um,
    }

    /// Errors before and after compensation.
    AppliedJson<'a>(found: &'a Comparison, limit_um: Option<f64>) {
        samples: usize = found.corrected.len(),
        outside_table: usize = found.outside(),
        before: SpreadJson = SpreadJson::new(&found.before),
        after: SpreadJson = SpreadJson::new(&found.after),
        limit_um: Option<f64> = limit_um,
        holds: Option<bool> = limit_um.map(|limit| found.keeps(limit)),
        iso230_before: Option<AxisJson> = found.axis.as_ref().ok().map(|[one, _]| AxisJson::new(one)),
        iso230_after: Option<AxisJson> = found.axis.as_ref().ok().map(|[_, one]| AxisJson::new(one)),
        iso230_missing: Option<&'a str> = found.axis.as_ref().err().map(String::as_str),
    }

    SpreadJson(spread: &Spread) {
        largest_um: f64 = spread.largest_um,
        half_range_um: f64 = spread.half_range_um,
        rms_um: f64 = spread.rms_um,
    }

    /// An ISO 230-2 test.
    AxisTestJson<'a>(test: &'a AxisTest) {
        #[serde(flatten)]
        values: AxisJson = AxisJson::new(&test.found),
        limit_um: Option<f64> = test.limit_um(),
        expanded_uncertainty_um: Option<f64> = test.expanded_um(),
        conformity: Option<&'static str> = test.conformity().map(Conformity::name),
        holds: Option<bool> = test.sheet.decides().then(|| test.holds()),
        #[serde(skip_serializing_if = "Option::is_none")]
        sheet: Option<SheetJson<'a>> = test.told.then(|| SheetJson::new(&test.sheet)),
        targets: Vec<TargetJson> = test.found.targets.iter().map(TargetJson::new).collect(),
        #[serde(skip_serializing_if = "<[String]>::is_empty")]
        notes: &'a [String] = &test.notes,
    }

    AxisJson(found: &AxisResult) {
        accuracy_um: f64 = found.accuracy_um,
        accuracy_forward_um: Option<f64> = found.accuracy_unidirectional_um[0],
        accuracy_backward_um: Option<f64> = found.accuracy_unidirectional_um[1],
        systematic_um: f64 = found.systematic_um,
        systematic_forward_um: Option<f64> = found.systematic_unidirectional_um[0],
        systematic_backward_um: Option<f64> = found.systematic_unidirectional_um[1],
        mean_range_um: f64 = found.mean_range_um,
        reversal_um: Option<f64> = found.reversal_um,
        mean_reversal_um: Option<f64> = found.mean_reversal_um,
        repeatability_um: f64 = found.repeatability_um,
        repeatability_forward_um: Option<f64> = found.repeatability_unidirectional_um[0],
        repeatability_backward_um: Option<f64> = found.repeatability_unidirectional_um[1],
        vdi3441: Option<Vdi3441Json> = found.vdi3441.as_ref().map(Vdi3441Json::new),
    }

    Vdi3441Json(vdi: &Vdi3441) {
        p_um: f64 = vdi.uncertainty_um,
        pa_um: f64 = vdi.deviation_um,
        u_max_um: f64 = vdi.reversal_um[0],
        u_mean_um: f64 = vdi.reversal_um[1],
        ps_max_um: f64 = vdi.scatter_um[0],
        ps_mean_um: f64 = vdi.scatter_um[1],
    }

    TargetJson(target: &TargetResult) {
        at_mm: f64 = target.at_mm,
        mean_forward_um: f64 = target.mean_forward_um,
        mean_backward_um: Option<f64> = target.mean_backward_um,
        s_forward_um: f64 = target.s_forward_um,
        s_backward_um: Option<f64> = target.s_backward_um,
        reversal_um: Option<f64> = target.reversal_um,
        repeatability_um: f64 = target.repeatability_um,
    }

    /// A modelled scale, and what limits its compensation.
    ModelJson(before: &Spread, budget: &[Residual]) {
        before: SpreadJson = SpreadJson::new(before),
        after: Option<SpreadJson> = budget.first().map(|whole| SpreadJson::new(&whole.left)),
        budget: Vec<ResidualJson> = budget.iter().map(ResidualJson::new).collect(),
    }

    ResidualJson(one: &Residual) {
        without: &'static str = one.without,
        left: SpreadJson = SpreadJson::new(&one.left),
    }
}

/// To the nanometre, as the image stores the LSB.
fn in_um(table: &CorrectionTable, codes: &[i8]) -> Vec<f64> {
    let um = |code: &i8| (f64::from(*code) * table.lsb_um * 1000.0).round() / 1000.0;
    codes.iter().map(um).collect()
}
