//! A transmission error in words.

use std::io::Write;

use helixlock_metrology::transmission::{Peak, ShaftLine};

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
        let name = best.reading.method.name();
        match spectrum.slope_rad_per_turn {
            Some(slope) => writeln!(out, "\nby {name}: slope {:+.3} ″ a turn", slope * ARCSEC)?,
            None => writeln!(out, "\nby {name}: no slope without samples a whole turn apart")?,
        }
    }
    for (order, amplitude_rad, names) in orders(best) {
        let names = if names.is_empty() { "no shaft named".into() } else { names.join(", ") };
        writeln!(out, "order {order:10.3}  {:9.4} ″  {names}", amplitude_rad * ARCSEC)?;
    }
    if let Some(limit) = evaluation.limit_arcsec {
        let verdict = words::held(evaluation.holds());
        writeln!(
            out,
            "limit {limit} ″ {verdict}: {:.3} ″ peak to peak",
            best.reading.peak_to_peak_rad() * ARCSEC
        )?;
    }
    for note in evaluation.notes() {
        writeln!(out, "note: {note}")?;
    }
    Ok(())
}

/// Tall lines, or where there are none for want of a whole turn, the named shafts: order, amplitude in
/// rad, names.
pub(super) fn orders(found: &Found) -> Vec<(f64, f64, Vec<String>)> {
    let Some(spectrum) = found.spectrum.as_ref().filter(|one| one.lines.is_empty()) else {
        let peak = |peak: &Peak| (peak.line.order, peak.line.amplitude_rad, peak.shafts.clone());
        return found.peaks.iter().map(peak).collect();
    };
    let shaft =
        |one: &ShaftLine| (one.shaft.order, one.amplitude_rad, vec![one.shaft.name.clone()]);
    spectrum.shafts.iter().map(shaft).collect()
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
