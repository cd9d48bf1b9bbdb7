//! The keys of `straightness --json`; they do not change.

use helixlock_metrology::straightness::{
    CompensationModel, CompensationOutcome, CorrectionPoint, Harmonic, Plan, Rejected,
    StraightnessLines,
};

use super::evaluation::{Evaluation, Outcome};
use super::text::{method_name, spacing_mm};
use crate::shared::keys::keys;
use crate::shared::sheet::SheetJson;

keys! {
    /// A whole evaluation; the arrays go by `position_mm`.
    StraightnessJson<'a>(found: &'a Evaluation, limit_um: Option<f64>) {
        samples: usize = found.combined.z_um.len(),
        repeats: usize = found.repeats,
        step_mm: f64 = found.combined.step_mm,
        spacing_mm: [f64; 2] = spacing_mm(&found.plan, found.combined.step_mm),
        sigma_um: Option<f64> = found.combined.sigma_um,
        three_sigma_um: Option<f64> = found.combined.sigma_um.map(|sigma| 3.0 * sigma),
        sigma_probe_um: Option<f64> = found.combined.sigma_probe_um(),
        mean_of_z_um: f64 = found.combined.offset_um,
        rejected: Vec<RejectedJson> = found
            .combined
            .rejected
            .iter()
            .map(|one| RejectedJson::new(one, &found.fourier.separated.position_mm))
            .collect(),
        method: &'static str = method_name(found.method),
        straightness_um: LinesJson = LinesJson::new(&found.chosen().workpiece),
        carriage_straightness_um: LinesJson = LinesJson::new(&found.chosen().carriage),
        limit_um: Option<f64> = limit_um,
        holds: Option<bool> = limit_um.map(|_| found.holds(limit_um)),
        #[serde(skip_serializing_if = "Option::is_none")]
        sheet: Option<SheetJson<'a>> = found.sheet.as_ref().map(SheetJson::new),
        position_mm: &'a [f64] = &found.chosen().separated.position_mm,
        fourier: OutcomeJson<'a> = OutcomeJson::new(&found.fourier),
        least_squares: OutcomeJson<'a> = OutcomeJson::new(&found.least_squares),
        rms_difference_um: f64 = found.rms_difference_um,
        plan: PlanJson<'a> = PlanJson::new(&found.plan, found.combined.step_mm),
        correction: Vec<PointJson> = found.correction.iter().map(PointJson::new).collect(),
        compensation: Option<CompensationJson> =
            found.compensation.as_ref().map(CompensationJson::new),
    }

    RejectedJson(one: &Rejected, position_mm: &[f64]) {
        repeat: usize = one.repeat + 1,
        position_mm: f64 = position_mm[one.sample],
        distance_um: f64 = one.distance_um,
    }

    LinesJson(lines: &StraightnessLines) {
        least_squares: f64 = lines.least_squares.error_um,
        end_points: f64 = lines.end_points.error_um,
        minimum_zone: f64 = lines.minimum_zone.error_um,
    }

    OutcomeJson<'a>(outcome: &'a Outcome) {
        straightness_um: LinesJson = LinesJson::new(&outcome.workpiece),
        carriage_straightness_um: LinesJson = LinesJson::new(&outcome.carriage),
        workpiece_um: &'a [f64] = &outcome.separated.workpiece_um,
        carriage_um: &'a [f64] = &outcome.separated.carriage_um,
        tilt_urad: &'a [f64] = &outcome.separated.tilt_urad,
        uncertainty_um: Option<&'a [f64]> = outcome.separated.uncertainty_um.as_deref(),
    }

    PointJson(point: &CorrectionPoint) {
        position_mm: f64 = point.position_mm,
        correction_um: f64 = point.correction_um,
    }

    CompensationJson(found: &(CompensationModel, CompensationOutcome)) {
        before_um: f64 = found.1.before_um,
        after_um: f64 = found.1.after_um,
        improvement_pct: f64 = found.1.improvement_pct,
        after_if_repeatable_um: f64 = found.1.after_if_repeatable_um,
        after_if_measured_exactly_um: f64 = found.1.after_if_measured_exactly_um,
        after_if_stepless_um: f64 = found.1.after_if_stepless_um,
        parameters: ModelJson = ModelJson::new(&found.0),
    }

    ModelJson(model: &CompensationModel) {
        unrepeatable_um: f64 = model.unrepeatable_um,
        correlation_mm: f64 = model.correlation_mm,
        measurement_um: f64 = model.measurement_um,
        corrector_step_um: f64 = model.corrector_step_um,
        table_step_mm: f64 = model.table_step_mm,
        passes: u32 = model.passes,
        seed: u64 = model.seed,
    }

    /// A plan and proposals.
    PlansJson<'a>(samples: usize, step_mm: f64, asked: Option<&'a Plan>, proposals: &'a [Plan]) {
        samples: usize = samples,
        step_mm: f64 = step_mm,
        plan: Option<PlanJson<'a>> = asked.map(|plan| PlanJson::new(plan, step_mm)),
        proposals: Vec<PlanJson<'a>> =
            proposals.iter().map(|plan| PlanJson::new(plan, step_mm)).collect(),
    }

    /// A plan; gains are infinite, and so null, when a harmonic is lost.
    PlanJson<'a>(plan: &'a Plan, step_mm: f64) {
        spacing_mm: [f64; 2] = spacing_mm(plan, step_mm),
        spacing_samples: [usize; 2] = [plan.spacing.first, plan.spacing.second],
        lost: &'a [usize] = &plan.lost,
        noise_gain: f64 = plan.noise_gain,
        combination_noise: f64 = plan.combination_noise,
        probe_noise_gain: f64 = plan.probe_noise_gain,
        zero_offset_gain: f64 = plan.zero_offset_gain,
        harmonics: Vec<HarmonicJson> = plan.harmonics.iter().map(HarmonicJson::new).collect(),
        warnings: &'a [String] = &plan.warnings,
    }

    HarmonicJson(one: &Harmonic) {
        number: usize = one.number,
        gain: f64 = one.gain,
        phase_deg: f64 = one.phase_rad.to_degrees(),
    }
}
