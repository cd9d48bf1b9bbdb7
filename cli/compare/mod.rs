//! `helixlock compare`: how large the residual is, whether it is noise, and where it fails.

mod page;

use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use helixlock_lab::{Comparison, Measurement, NamedLine, compare, sensor_column};
use serde_json::{Value, json};

use crate::shared::diagnosis_json;
use crate::shared::measured::Files;
use crate::shared::output::Batch;
use crate::shared::words::{with_error, with_p};

/// Show where a machine file and a measurement part
#[derive(Debug, Args)]
pub(crate) struct Compare {
    #[command(flatten)]
    files: Files,
    /// Folder for `report.html`
    #[arg(short, long)]
    output: Option<PathBuf>,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl Compare {
    /// Prints the comparison; exit status 0 whatever it says.
    pub(crate) fn run(self, out: &mut impl Write) -> anyhow::Result<ExitCode> {
        let (_, problem) = self.files.read()?;
        let comparison = compare(&problem);
        if let Some(folder) = &self.output {
            let page = page::page(&problem, &comparison).html();
            let mut files = Batch::new(folder)?;
            files.write_content("report.html", page)?;
            files.keep()?;
        }
        if self.json {
            let value = as_json(&comparison, &problem.measurement);
            writeln!(out, "{}", serde_json::to_string_pretty(&value)?)?;
        } else {
            print(out, &comparison, &problem.measurement)?;
        }
        Ok(ExitCode::SUCCESS)
    }
}

fn print(
    out: &mut impl Write,
    comparison: &Comparison,
    measurement: &Measurement,
) -> anyhow::Result<()> {
    let unit = measurement.unit();
    for sensor in &comparison.sensors {
        writeln!(
            out,
            "{}: residual {:.4} {unit} rms, {:.4} {unit} peak to peak, {} samples worth {:.0}",
            sensor_column(sensor.sensor, measurement.rotary),
            sensor.rms_um,
            sensor.peak_to_peak_um,
            sensor.samples,
            sensor.effective_samples
        )?;
    }
    let says = if comparison.noise_only { "nothing but noise" } else { "more than noise" };
    writeln!(out, "left: {says} ({})\n", with_p(comparison.noise_p_value))?;
    writeln!(out, "where it fails:")?;
    for one in comparison.along.iter().take(10) {
        let at = one.at.map_or(String::new(), |at| format!(" at {at:.4}"));
        writeln!(
            out,
            "  {:<24} {:<44} {:>9.4} {unit} rms  {}{at}",
            one.along,
            one.shape,
            one.rms_um,
            with_p(one.p_value)
        )?;
    }
    if !comparison.lines.is_empty() {
        writeln!(out, "\nlines:")?;
    }
    for line in &comparison.lines {
        print_line(out, line, unit)?;
    }
    for note in &measurement.notes {
        writeln!(out, "note: {note}")?;
    }
    Ok(())
}

fn print_line(out: &mut impl Write, line: &NamedLine, unit: &str) -> anyhow::Result<()> {
    let name = line.name.as_deref().unwrap_or("unexplained");
    let of = line.harmonic_of.map_or(String::new(), |(n, order)| format!(", {n} × {order:.4}"));
    writeln!(
        out,
        "  order {}  period {} s  {} {unit}  {name}{of}",
        with_error(line.line.frequency, line.line.frequency_stderr),
        with_error(line.period_s, line.period_stderr_s),
        with_error(line.line.amplitude, line.line.amplitude_stderr)
    )?;
    Ok(())
}

fn as_json(comparison: &Comparison, measurement: &Measurement) -> Value {
    let column = |sensor| sensor_column(sensor, measurement.rotary);
    json!({
        "unit": measurement.unit_word(),
        "noise_only": comparison.noise_only,
        "noise_p_value": comparison.noise_p_value,
        "sensors": comparison.sensors.iter().map(|sensor| json!({
            "sensor": column(sensor.sensor),
            "samples": sensor.samples,
            "effective_samples": sensor.effective_samples,
            "samples_looked_at": sensor.looked_at,
            "rms_um": sensor.rms_um,
            "peak_to_peak_um": sensor.peak_to_peak_um,
            "outliers": sensor.outliers,
            "noise": json!({
                "white_um": sensor.noise.white.sqrt(),
                "slow": sensor.noise.slow.iter().map(|part| json!({
                    "rms_um": part.variance.sqrt(),
                    "correlation_s": part.length * sensor.interval_s,
                })).collect::<Vec<_>>(),
            }),
            "passes": sensor.passes.iter().map(|pass| json!({
                "pass": pass.pass,
                "samples": pass.samples,
                "rms_um": pass.rms_um,
                "peak_to_peak_um": pass.peak_to_peak_um,
            })).collect::<Vec<_>>(),
        })).collect::<Vec<_>>(),
        "along": comparison.along.iter().map(diagnosis_json::structure).collect::<Vec<_>>(),
        "lines": comparison.lines.iter().map(|line| line_json(line, comparison, measurement)).collect::<Vec<_>>(),
        "notes": measurement.notes,
    })
}

fn line_json(line: &NamedLine, comparison: &Comparison, measurement: &Measurement) -> Value {
    json!({
        "sensor": sensor_column(comparison.sensors[line.sensor].sensor, measurement.rotary),
        "order": line.line.frequency,
        "order_stderr": line.line.frequency_stderr,
        "period_s": line.period_s,
        "period_stderr_s": line.period_stderr_s,
        "period_mm": line.period_mm,
        "amplitude_um": line.line.amplitude,
        "amplitude_stderr_um": line.line.amplitude_stderr,
        "p_value": line.line.p_value,
        "name": line.name,
        "harmonic": line.harmonic_of.map(|(number, _)| number),
        "of_order": line.harmonic_of.map(|(_, order)| order),
    })
}
