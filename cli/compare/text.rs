//! A comparison in words.

use std::io::Write;

use helixlock_lab::{Comparison, Measurement, NamedLine, sensor_column};

use crate::shared::diagnosis_text::{print_doubts, print_notes};
use crate::shared::words::{left_over, with_error, with_p};

/// Sizes, where it fails, and the lines.
pub(crate) fn print(
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
    let says = left_over(comparison);
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
        writeln!(out, "\nlines, clearest first, ten at most:")?;
    }
    for line in &comparison.lines {
        print_line(out, line, unit)?;
    }
    print_doubts(out, &comparison.doubts)?;
    print_notes(out, measurement, comparison.far_readings.as_ref(), &comparison.loud_passes)
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
