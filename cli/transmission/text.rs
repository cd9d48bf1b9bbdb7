//! A transmission error in words.

use std::io::Write;

use super::evaluation::{ARCSEC, Evaluation, Found};
use crate::shared::words;

/// The result for people.
pub(crate) fn print(out: &mut impl Write, evaluation: &Evaluation) -> anyhow::Result<()> {
    let (input, output) = (evaluation.pulses.input_s().len(), evaluation.pulses.output_s().len());
    let (over, under) = evaluation.setup.gearing.pulses_per_pulse();
    writeln!(
        out,
        "{}: {input} input pulses, {output} output pulses, {over}/{under} input pulses for each",
        evaluation.path.display()
    )?;
    writeln!(
        out,
        "\nmethod               samples    p-p ″   resolution ″      range ″   counters  products   from truth ″ (rms, largest)"
    )?;
    for result in &evaluation.results {
        match &result.found {
            Ok(found) => print_method(out, result.method.name(), found)?,
            Err(why) => writeln!(out, "{:<20} {why}", result.method.name())?,
        }
    }
    let Some(best) = evaluation.best() else { return Ok(()) };
    if let Some(spectrum) = &best.spectrum {
        writeln!(
            out,
            "\nby {}: slope {:+.3} ″ a turn",
            best.reading.method.name(),
            spectrum.slope_rad_per_turn * ARCSEC
        )?;
    }
    for peak in &best.peaks {
        let names =
            if peak.shafts.is_empty() { "no shaft named".into() } else { peak.shafts.join(", ") };
        writeln!(
            out,
            "order {:10.3}  {:9.4} ″  {names}",
            peak.line.order,
            peak.line.amplitude_rad * ARCSEC
        )?;
    }
    if let Some(limit) = evaluation.limit_arcsec {
        let verdict = words::held(evaluation.holds());
        writeln!(
            out,
            "limit {limit} ″ {verdict}: {:.3} ″ peak to peak",
            best.reading.peak_to_peak_rad() * ARCSEC
        )?;
    }
    Ok(())
}

fn print_method(out: &mut impl Write, name: &str, found: &Found) -> anyhow::Result<()> {
    let limits = &found.reading.limits;
    let range = limits.range_rad.map_or("none".into(), |range| format!("{:.2}", range * ARCSEC));
    let truth = found.against_truth.map_or(String::new(), |(largest, rms)| {
        format!("{:.4}, {:.4}", rms * ARCSEC, largest * ARCSEC)
    });
    let cost = found.reading.cost;
    let recorder = if cost.analog { "  and a recorder" } else { "" };
    writeln!(
        out,
        "{name:<20} {:7} {:8.3} {:14.5} {range:>12} {:10} {:9}   {truth}{recorder}",
        found.reading.samples.len(),
        found.reading.peak_to_peak_rad() * ARCSEC,
        limits.resolution_rad * ARCSEC,
        cost.counters,
        cost.multiplications,
    )?;
    Ok(())
}
