//! Report of `helixlock transmission`.

use helixlock_metrology::transmission::Method;
use helixlock_report::{Axis, Colour, Figure, Label, Page, Panel, Part, Series, Style, Table};

use super::evaluation::{ARCSEC, Evaluation, Found, MethodResult};
use super::text;
use crate::shared::page_pieces::{self, panel};

const COLOURS: [Colour; 5] =
    [Colour::Orange, Colour::Purple, Colour::Green, Colour::Grey, Colour::Blue];

/// The page: all methods in one picture, the spectrum, and what each can do.
pub(crate) fn page(evaluation: &Evaluation) -> Page {
    let mut parts = Vec::new();
    if let Some(best) = evaluation.best() {
        parts.push(Part::Numbers(vec![(
            format!("{:.2} ″", best.reading.peak_to_peak_rad() * ARCSEC),
            format!("peak to peak by {}", best.reading.method.name()),
        )]));
    }
    parts.extend(evaluation.notes().into_iter().map(Part::Note));
    parts.push(Part::Picture {
        svg: figure(evaluation).svg(),
        caption: "The error by every method, each with its own limits, and the order spectrum of the best.".into(),
    });
    parts.push(Part::Heading("Which method".into()));
    parts.push(Part::Table(methods(evaluation)));
    for result in &evaluation.results {
        if let Err(why) = &result.found {
            parts.push(Part::Note(format!("{}: {why}", result.method.name())));
        }
    }
    if let Some(table) = evaluation.best().map(orders) {
        parts.push(Part::Heading("Orders".into()));
        parts.push(Part::Table(table));
    }
    Page {
        title: "Transmission error".into(),
        summary: format!(
            "{}: {} input pulses, {} output pulses. Positive: the output is ahead.",
            evaluation.path.display(),
            evaluation.pulses.input_s().len(),
            evaluation.pulses.output_s().len()
        ),
        parts,
    }
}

/// The figure of the page: all methods; those that see fractions of a pulse, larger; the spectrum.
pub(crate) fn figure(evaluation: &Evaluation) -> Figure {
    let by_pulses = |result: &MethodResult| result.method == Method::DirectCounting;
    let drawn: Vec<(&MethodResult, Colour)> = evaluation.results.iter().zip(COLOURS).collect();
    // Counting, which jumps by whole pulses, lies behind the others.
    let (counted, fine): (Vec<_>, Vec<_>) = drawn.into_iter().partition(|(r, _)| by_pulses(r));
    let all = counted.iter().chain(&fine).filter_map(series).collect();
    let errors = |title, all| panel(title, "turns of the output", "δ in arcsec", all);
    let mut panels = vec![errors("transmission error", all)];
    if !counted.is_empty() && !fine.is_empty() {
        panels.push(errors("without direct counting", fine.iter().filter_map(series).collect()));
    }
    panels.extend(evaluation.best().and_then(spectrum));
    let higher = |panel| Panel { height_px: 280, ..panel };
    page_pieces::figure(panels.into_iter().map(higher).collect())
}

fn series((result, colour): &(&MethodResult, Colour)) -> Option<Series> {
    let found = result.found.as_ref().ok()?;
    let points = found.reading.samples.iter().map(|s| [s.output_turns, s.error_rad * ARCSEC]);
    Some(Series::new(result.method.name(), *colour, Style::Line, points))
}

fn spectrum(found: &Found) -> Option<Panel> {
    let lines = &found.spectrum.as_ref()?.lines;
    if lines.is_empty() {
        return None;
    }
    let points = lines.iter().map(|line| [line.order, line.amplitude_rad * ARCSEC]);
    let named = found.peaks.iter().filter(|peak| !peak.shafts.is_empty());
    let label = |peak: &helixlock_metrology::transmission::Peak| Label {
        at: [peak.line.order, peak.line.amplitude_rad * ARCSEC],
        text: peak.shafts.join(", "),
    };
    let stems = vec![Series::new("", Colour::Blue, Style::Stems, points)];
    Some(Panel {
        x: Axis::log("periods a turn of the output"),
        labels: named.map(label).collect(),
        ..panel("order spectrum", "", "amplitude in arcsec", stems)
    })
}

fn methods(evaluation: &Evaluation) -> Table {
    let mut table = Table::new([
        "method",
        "samples a turn",
        "resolution ″",
        "range ″",
        "bound ″",
        "from truth ″ rms",
        "counters",
        "products",
        "what it needs and loses",
    ]);
    for result in &evaluation.results {
        let Ok(found) = &result.found else { continue };
        let limits = &found.reading.limits;
        let number = |rad: f64| format!("{:.4}", rad * ARCSEC);
        table.row([
            result.method.name().to_owned(),
            format!("{:.1}", limits.samples_per_turn),
            number(limits.resolution_rad),
            limits.range_rad.map_or("none".into(), number),
            number(limits.bound_rad),
            found.against_truth.map_or(String::new(), |(_, rms)| number(rms)),
            found.reading.cost.counters.to_string(),
            found.reading.cost.multiplications.to_string(),
            limits.in_words.into(),
        ]);
    }
    table
}

fn orders(found: &Found) -> Table {
    let mut table = Table::new(["order", "amplitude ″", "shafts"]);
    for (order, amplitude_rad, names) in text::orders(found) {
        let amplitude = format!("{:.4}", amplitude_rad * ARCSEC);
        table.row([format!("{order:.3}"), amplitude, names.join(", ")]);
    }
    table
}
