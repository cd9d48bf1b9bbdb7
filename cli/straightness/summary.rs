//! What `helixlock straightness` says, as JSON and for people.

use std::io::Write;

use helixlock_metrology::straightness::{Plan, StraightnessLines};
use serde_json::{Value, json};

use super::{By, Evaluation, Outcome};

/// The result as JSON; the arrays go by `position_mm`.
pub(crate) fn json_of(evaluation: &Evaluation, limit_um: Option<f64>) -> Value {
    let combined = &evaluation.combined;
    let step_mm = combined.step_mm;
    let position = |sample: usize| evaluation.fourier.separated.position_mm[sample];
    let rejected = combined.rejected.iter().map(|one| {
        json!({ "repeat": one.repeat, "position_mm": position(one.sample), "distance_um": one.distance_um })
    });
    let chosen = evaluation.chosen();
    json!({
        "samples": combined.z_um.len(),
        "repeats": evaluation.repeats,
        "step_mm": step_mm,
        "spacing_mm": [length(combined.spacing.first, step_mm), length(combined.spacing.second, step_mm)],
        "sigma_um": combined.sigma_um,
        "three_sigma_um": combined.sigma_um.map(|sigma| 3.0 * sigma),
        "sigma_probe_um": combined.sigma_um.map(|sigma| sigma / combined.spacing.combination_noise()),
        "mean_of_z_um": combined.offset_um,
        "rejected": rejected.collect::<Vec<_>>(),
        "method": method_name(evaluation.method),
        "straightness_um": lines_json(&chosen.workpiece),
        "carriage_straightness_um": lines_json(&chosen.carriage),
        "limit_um": limit_um,
        "holds": limit_um.map(|limit| chosen.workpiece.minimum_zone.error_um <= limit),
        "position_mm": chosen.separated.position_mm,
        "fourier": outcome_json(&evaluation.fourier),
        "least_squares": outcome_json(&evaluation.least_squares),
        "rms_difference_um": rms_difference(evaluation),
        "plan": one_plan_json(&evaluation.plan, step_mm),
        "correction": evaluation.correction.iter().map(|point| json!({ "position_mm": point.position_mm, "correction_um": point.correction_um })).collect::<Vec<_>>(),
        "compensation": compensation_json(evaluation),
    })
}

fn method_name(method: By) -> &'static str {
    match method {
        By::Fourier => "fourier",
        By::LeastSquares => "least-squares",
    }
}

fn lines_json(lines: &StraightnessLines) -> Value {
    json!({
        "least_squares": lines.least_squares.error_um,
        "end_points": lines.end_points.error_um,
        "minimum_zone": lines.minimum_zone.error_um,
    })
}

fn outcome_json(outcome: &Outcome) -> Value {
    let found = &outcome.separated;
    json!({
        "straightness_um": lines_json(&outcome.workpiece),
        "carriage_straightness_um": lines_json(&outcome.carriage),
        "workpiece_um": found.workpiece_um,
        "carriage_um": found.carriage_um,
        "tilt_urad": found.tilt_urad,
        "uncertainty_um": found.uncertainty_um,
    })
}

/// How far the two methods are apart, µm.
pub(crate) fn rms_difference(evaluation: &Evaluation) -> f64 {
    let (a, b) = (&evaluation.fourier.separated, &evaluation.least_squares.separated);
    let squares: Vec<f64> =
        a.workpiece_um.iter().zip(&b.workpiece_um).map(|(a, b)| (a - b) * (a - b)).collect();
    #[expect(clippy::cast_precision_loss, reason = "samples of a stroke are few")]
    let count = squares.len() as f64;
    (squares.iter().sum::<f64>() / count).sqrt()
}

fn compensation_json(evaluation: &Evaluation) -> Value {
    let Some((model, outcome)) = &evaluation.compensation else { return Value::Null };
    json!({
        "before_um": outcome.before_um,
        "after_um": outcome.after_um,
        "improvement_pct": outcome.improvement_pct,
        "after_if_repeatable_um": outcome.after_if_repeatable_um,
        "after_if_measured_exactly_um": outcome.after_if_measured_exactly_um,
        "after_if_stepless_um": outcome.after_if_stepless_um,
        "parameters": {
            "unrepeatable_um": model.unrepeatable_um,
            "correlation_mm": model.correlation_mm,
            "measurement_um": model.measurement_um,
            "corrector_step_um": model.corrector_step_um,
            "table_step_mm": model.table_step_mm,
            "passes": model.passes,
            "seed": model.seed,
        },
    })
}

/// A plan and proposals as JSON.
pub(crate) fn plan_json(
    samples: usize,
    step_mm: f64,
    asked: Option<&Plan>,
    proposals: &[Plan],
) -> Value {
    json!({
        "samples": samples,
        "step_mm": step_mm,
        "plan": asked.map(|plan| one_plan_json(plan, step_mm)),
        "proposals": proposals.iter().map(|plan| one_plan_json(plan, step_mm)).collect::<Vec<_>>(),
    })
}

fn one_plan_json(plan: &Plan, step_mm: f64) -> Value {
    let harmonics = plan.harmonics.iter().map(|harmonic| {
        json!({ "number": harmonic.number, "gain": harmonic.gain, "phase_deg": harmonic.phase_rad.to_degrees() })
    });
    json!({
        "spacing_mm": [length(plan.spacing.first, step_mm), length(plan.spacing.second, step_mm)],
        "spacing_samples": [plan.spacing.first, plan.spacing.second],
        "lost": plan.lost,
        // Infinite when a harmonic is lost; JSON has no infinity.
        "noise_gain": Some(plan.noise_gain).filter(|gain| gain.is_finite()),
        "combination_noise": plan.combination_noise,
        "probe_noise_gain": Some(plan.probe_noise_gain).filter(|gain| gain.is_finite()),
        "zero_offset_gain": plan.zero_offset_gain,
        "harmonics": harmonics.collect::<Vec<_>>(),
        "warnings": plan.warnings,
    })
}

#[expect(clippy::cast_precision_loss, reason = "spacings are small")]
fn length(samples: usize, step_mm: f64) -> f64 {
    samples as f64 * step_mm
}

/// The result for people.
pub(crate) fn print(
    out: &mut impl Write,
    evaluation: &Evaluation,
    limit_um: Option<f64>,
) -> anyhow::Result<()> {
    let combined = &evaluation.combined;
    let (samples, repeats) = (combined.z_um.len(), evaluation.repeats);
    writeln!(out, "{}: {samples} samples, {repeats} runs", evaluation.path.display())?;
    if let Some(sigma) = combined.sigma_um {
        let probe = sigma / combined.spacing.combination_noise();
        writeln!(
            out,
            "noise of the combined signal ±3σ = {:.3} µm (one probe: σ = {probe:.4} µm)",
            3.0 * sigma
        )?;
    }
    for one in &combined.rejected {
        writeln!(
            out,
            "left out: run {}, sample {}, {:+.3} µm from the mean",
            one.repeat + 1,
            one.sample + 1,
            one.distance_um
        )?;
    }
    writeln!(out, "\nstraightness in µm        least squares   end points   minimum zone")?;
    for (name, outcome) in
        [("Fourier series", &evaluation.fourier), ("least squares", &evaluation.least_squares)]
    {
        print_lines(out, &format!("bar, {name}"), &outcome.workpiece)?;
        print_lines(out, &format!("carriage, {name}"), &outcome.carriage)?;
    }
    writeln!(out, "the two methods differ by {:.3} µm rms", rms_difference(evaluation))?;
    print_compensation(out, evaluation)?;
    if let Some(limit) = limit_um {
        let found = evaluation.chosen().workpiece.minimum_zone.error_um;
        let verdict = if found <= limit { "holds" } else { "is exceeded" };
        writeln!(
            out,
            "limit {limit} µm {verdict}: minimum zone {found:.3} µm by {}",
            method_name(evaluation.method)
        )?;
    }
    for warning in &evaluation.plan.warnings {
        writeln!(out, "note: {warning}")?;
    }
    Ok(())
}

fn print_lines(out: &mut impl Write, name: &str, lines: &StraightnessLines) -> std::io::Result<()> {
    let [squares, ends, zone] =
        [lines.least_squares, lines.end_points, lines.minimum_zone].map(|line| line.error_um);
    writeln!(out, "{name:<26}{squares:13.3}{ends:13.3}{zone:15.3}")
}

fn print_compensation(out: &mut impl Write, evaluation: &Evaluation) -> anyhow::Result<()> {
    let Some((model, outcome)) = &evaluation.compensation else { return Ok(()) };
    writeln!(
        out,
        "\nsimulated compensation: {:.3} µm → {:.3} µm, {:.0} % better",
        outcome.before_um, outcome.after_um, outcome.improvement_pct
    )?;
    writeln!(
        out,
        "  with σ = {:.3} µm over {} mm that does not repeat, {:.4} µm of measurement, steps of {} µm",
        model.unrepeatable_um, model.correlation_mm, model.measurement_um, model.corrector_step_um
    )?;
    writeln!(
        out,
        "  a carriage that repeats: {:.3} µm; an exact measurement: {:.3} µm; no steps: {:.3} µm",
        outcome.after_if_repeatable_um,
        outcome.after_if_measured_exactly_um,
        outcome.after_if_stepless_um
    )?;
    Ok(())
}

/// A plan for people.
pub(crate) fn print_plan(
    out: &mut impl Write,
    step_mm: f64,
    asked: Option<&Plan>,
    proposals: &[Plan],
) -> anyhow::Result<()> {
    if let Some(plan) = asked {
        print_one_plan(out, plan, step_mm)?;
    }
    writeln!(out, "proposals, the quietest first:")?;
    for plan in proposals {
        writeln!(
            out,
            "  L1 {:6.1} mm   L2 {:6.1} mm   noise × {:.2} of a probe, × {:.2} of z   zero offset × {:.1}",
            length(plan.spacing.first, step_mm),
            length(plan.spacing.second, step_mm),
            plan.probe_noise_gain,
            plan.noise_gain,
            plan.zero_offset_gain
        )?;
    }
    Ok(())
}

fn print_one_plan(out: &mut impl Write, plan: &Plan, step_mm: f64) -> anyhow::Result<()> {
    let [first, second] =
        [plan.spacing.first, plan.spacing.second].map(|samples| length(samples, step_mm));
    writeln!(out, "L1 {first} mm, L2 {second} mm, {} samples of {step_mm} mm", plan.samples)?;
    writeln!(out, "harmonic      gain    1/gain")?;
    for harmonic in &plan.harmonics {
        if plan.lost.contains(&harmonic.number) {
            writeln!(out, "{:8}  lost", harmonic.number)?;
        } else {
            writeln!(
                out,
                "{:8}  {:8.4}  {:8.3}",
                harmonic.number,
                harmonic.gain,
                1.0 / harmonic.gain
            )?;
        }
    }
    if plan.lost.is_empty() {
        writeln!(out, "noise × {:.2} (bar for combined signal, per harmonic)", plan.noise_gain)?;
    } else {
        writeln!(out, "lost harmonics: {:?}", plan.lost)?;
    }
    writeln!(out, "combined signal: {:.2} times the noise of one probe", plan.combination_noise)?;
    writeln!(
        out,
        "a zero offset of 1 µm makes a parabola of {:.1} µm at half the stroke",
        plan.zero_offset_gain
    )?;
    for warning in &plan.warnings {
        writeln!(out, "note: {warning}")?;
    }
    writeln!(out)?;
    Ok(())
}
