//! Straightness in words.

use std::io::Write;

use helixlock_metrology::straightness::{Plan, StraightnessLines};

use super::evaluation::{By, Evaluation};
use crate::shared::words;

/// The result for people.
pub(crate) fn print(
    out: &mut impl Write,
    evaluation: &Evaluation,
    limit_um: Option<f64>,
) -> anyhow::Result<()> {
    let combined = &evaluation.combined;
    let (samples, repeats) = (combined.z_um.len(), evaluation.repeats);
    writeln!(out, "{}: {samples} samples, {repeats} runs", evaluation.path.display())?;
    if let Some((sigma, probe)) = combined.sigma_um.zip(combined.sigma_probe_um()) {
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
    writeln!(out, "the two methods differ by {:.3} µm rms", evaluation.rms_difference_um)?;
    print_compensation(out, evaluation)?;
    if let Some(limit) = limit_um {
        let found = evaluation.chosen().workpiece.minimum_zone.error_um;
        let verdict = words::held(evaluation.keeps(limit));
        writeln!(
            out,
            "limit {limit} µm {verdict}: minimum zone {found:.3} µm by {}",
            method_name(evaluation.method)
        )?;
    }
    if let Some(sheet) = &evaluation.sheet {
        for line in sheet.words() {
            writeln!(out, "{line}")?;
        }
        if let Some(why) = sheet.why_without() {
            writeln!(out, "note: {why}")?;
        }
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
        let [first, second] = spacing_mm(plan, step_mm);
        writeln!(
            out,
            "  L1 {first:6.1} mm   L2 {second:6.1} mm   noise × {:.2} of a probe, × {:.2} of z   zero offset × {:.1}",
            plan.probe_noise_gain, plan.noise_gain, plan.zero_offset_gain
        )?;
    }
    Ok(())
}

fn print_one_plan(out: &mut impl Write, plan: &Plan, step_mm: f64) -> anyhow::Result<()> {
    let [first, second] = spacing_mm(plan, step_mm);
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

/// A method as it is asked for.
pub(crate) fn method_name(method: By) -> &'static str {
    match method {
        By::Fourier => "fourier",
        By::LeastSquares => "least-squares",
    }
}

/// Both spacings of a plan, mm.
#[expect(clippy::cast_precision_loss, reason = "spacings are small")]
pub(crate) fn spacing_mm(plan: &Plan, step_mm: f64) -> [f64; 2] {
    [plan.spacing.first, plan.spacing.second].map(|samples| samples as f64 * step_mm)
}
