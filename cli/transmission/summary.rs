//! What `helixlock transmission` says, as JSON and for people.

use std::io::Write;

use helixlock_metrology::transmission::Sample;
use serde_json::{Value, json};

use super::{ARCSEC, Evaluation, Found, MethodResult};

/// The result as JSON; the samples are in it when one method was asked for.
pub(crate) fn json_of(evaluation: &Evaluation) -> Value {
    let setup = &evaluation.setup;
    let (over, under) = setup.gearing.pulses_per_pulse();
    let mut value = json!({
        "input_pulses": evaluation.pulses.input_s().len(),
        "output_pulses": evaluation.pulses.output_s().len(),
        "input_lines": setup.gearing.input_lines,
        "output_lines": setup.gearing.output_lines,
        "ratio": [setup.gearing.ratio.0, setup.gearing.ratio.1],
        "input_pulses_per_output_pulse": [over, under],
        "clock_hz": setup.clock_hz,
        "range_divider": setup.range_divider,
        "recorder_s": setup.recorder_s,
        "limit_arcsec": evaluation.limit_arcsec,
        "holds": evaluation.limit_arcsec.map(|_| evaluation.holds()),
        "methods": evaluation.results.iter().map(method_json).collect::<Vec<_>>(),
    });
    if let [MethodResult { found: Ok(found), .. }] = evaluation.results.as_slice() {
        value["samples"] = samples_json(&found.reading.samples);
    }
    value
}

fn samples_json(samples: &[Sample]) -> Value {
    let column = |value: fn(&Sample) -> f64| samples.iter().map(value).collect::<Vec<_>>();
    json!({
        "time_s": column(|one| one.time_s),
        "output_turns": column(|one| one.output_turns),
        "delta_arcsec": column(|one| one.error_rad * ARCSEC),
    })
}

fn method_json(result: &MethodResult) -> Value {
    let name = result.method.name();
    let found = match &result.found {
        Ok(found) => found,
        Err(why) => return json!({ "method": name, "cannot": why }),
    };
    let limits = &found.reading.limits;
    let spectrum = found.spectrum.as_ref();
    let shafts = spectrum.map_or(&[][..], |spectrum| &spectrum.shafts);
    let peaks = found.peaks.iter().map(|peak| {
        json!({ "order": peak.line.order, "amplitude_arcsec": peak.line.amplitude_rad * ARCSEC, "shafts": peak.shafts })
    });
    let shafts = shafts.iter().map(|line| {
        json!({
            "name": line.shaft.name,
            "order": line.shaft.order,
            "amplitude_arcsec": line.amplitude_rad * ARCSEC,
            "phase_deg": line.phase_rad.to_degrees(),
        })
    });
    json!({
        "method": name,
        "samples": found.reading.samples.len(),
        "peak_to_peak_arcsec": found.peak_to_peak_rad() * ARCSEC,
        "slope_arcsec_per_turn": spectrum.map(|spectrum| spectrum.slope_rad_per_turn * ARCSEC),
        "limits": {
            "resolution_arcsec": limits.resolution_rad * ARCSEC,
            "range_arcsec": limits.range_rad.map(|range| range * ARCSEC),
            "step_arcsec": limits.step_rad.map(|step| step * ARCSEC),
            "samples_per_turn": limits.samples_per_turn,
            "bound_arcsec": limits.bound_rad * ARCSEC,
            "in_words": limits.in_words,
        },
        "cost_per_sample": {
            "counters": found.reading.cost.counters,
            "multiplications": found.reading.cost.multiplications,
            "analog_part": found.reading.cost.analog,
        },
        "against_truth": found.against_truth.map(|(largest, rms)| {
            json!({ "largest_arcsec": largest * ARCSEC, "rms_arcsec": rms * ARCSEC })
        }),
        "peaks": peaks.collect::<Vec<_>>(),
        "shafts": shafts.collect::<Vec<_>>(),
    })
}

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
        let verdict = if evaluation.holds() { "holds" } else { "is exceeded" };
        writeln!(
            out,
            "limit {limit} ″ {verdict}: {:.3} ″ peak to peak",
            best.peak_to_peak_rad() * ARCSEC
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
        found.peak_to_peak_rad() * ARCSEC,
        limits.resolution_rad * ARCSEC,
        cost.counters,
        cost.multiplications,
    )?;
    Ok(())
}
