//! Report of `helixlock straightness`.

use helixlock_metrology::straightness::Separated;
use helixlock_report::{Axis, Colour, Figure, Page, Panel, Part, Series, Style, Table};

use super::evaluation::{Evaluation, Outcome};
use crate::shared::page_pieces::{self, panel, points};
use crate::shared::sheet;

/// The page: bar, carriage, gain of the harmonics, figures.
pub(crate) fn page(evaluation: &Evaluation) -> Page {
    let chosen = evaluation.chosen();
    let zone = |outcome: &Outcome| format!("{:.3} µm", outcome.workpiece.minimum_zone.error_um);
    let mut numbers = vec![
        (zone(chosen), "straightness of the bar, minimum zone".to_owned()),
        (
            format!("{:.3} µm", chosen.carriage.minimum_zone.error_um),
            "of the carriage motion".into(),
        ),
        (format!("{:.3} µm", evaluation.rms_difference_um), "between the two methods, rms".into()),
    ];
    if let Some(sigma) = evaluation.combined.sigma_um {
        numbers.push((format!("{:.3} µm", 3.0 * sigma), "±3σ of the combined signal".into()));
    }
    let mut sheet = evaluation.sheet.as_ref().map_or_else(Vec::new, sheet::parts);
    let signatures = sheet.pop();
    let mut parts = vec![Part::Numbers(numbers)];
    parts.extend(sheet);
    parts.push(Part::Picture {
        svg: figure(evaluation).svg(),
        caption:
            "Bar and carriage by both methods, and what the probes let through of each harmonic."
                .into(),
    });
    parts.push(Part::Table(lines(evaluation)));
    parts.extend(evaluation.plan.warnings.iter().cloned().map(Part::Note));
    if let Some((model, outcome)) = &evaluation.compensation {
        parts.push(Part::Heading("Simulated compensation".into()));
        parts.push(Part::Text(format!(
            "{:.3} µm before, {:.3} µm after: {:.0} % better. What does not repeat ({:.3} µm) limits it: with a carriage that repeats, {:.3} µm would be left; with an exact measurement {:.3} µm; without steps {:.3} µm.",
            outcome.before_um,
            outcome.after_um,
            outcome.improvement_pct,
            model.unrepeatable_um,
            outcome.after_if_repeatable_um,
            outcome.after_if_measured_exactly_um,
            outcome.after_if_stepless_um
        )));
    }
    parts.extend(signatures);
    Page {
        title: "Straightness by three probes".into(),
        summary: format!(
            "{}: {} samples, {} runs.",
            evaluation.path.display(),
            evaluation.combined.z_um.len(),
            evaluation.repeats
        ),
        parts,
    }
}

/// The figure of the page.
pub(crate) fn figure(evaluation: &Evaluation) -> Figure {
    let positions = &evaluation.fourier.separated.position_mm;
    let (fourier, squares) = (&evaluation.fourier.separated, &evaluation.least_squares.separated);
    let both = |title, y, values: fn(&Separated) -> &Vec<f64>| {
        let line = |name, colour, found| {
            Series::new(name, colour, Style::Line, points(positions, values(found)))
        };
        let lines = vec![
            line("Fourier series", Colour::Orange, fourier),
            line("least squares", Colour::Blue, squares),
        ];
        panel(title, "position in mm", y, lines)
    };
    #[expect(clippy::cast_precision_loss, reason = "harmonics are few")]
    let number = |count: usize| count as f64;
    let harmonics = &evaluation.plan.harmonics;
    let stems = harmonics.iter().map(|harmonic| [number(harmonic.number), harmonic.gain]);
    let gains = vec![Series::new("", Colour::Blue, Style::Stems, stems)];
    // Room beside the last stem.
    let beyond = number(harmonics.len() + 1);
    let panels = [
        both("bar", "height in µm", |found| &found.workpiece_um),
        both("carriage motion", "δ in µm", |found| &found.carriage_um),
        both("tilt of the carriage", "β in µrad", |found| &found.tilt_urad),
        Panel {
            x: Axis::linear("harmonic of the stroke").between(0.0, beyond),
            ..panel("gain of the probes", "", "gain", gains)
        },
    ];
    page_pieces::figure(panels.map(|panel| Panel { height_px: 230, ..panel }).into())
}

fn lines(evaluation: &Evaluation) -> Table {
    let mut table =
        Table::new(["straightness in µm", "least-squares line", "end-point line", "minimum zone"]);
    for (name, outcome) in
        [("Fourier series", &evaluation.fourier), ("least squares", &evaluation.least_squares)]
    {
        for (what, lines) in [("bar", &outcome.workpiece), ("carriage", &outcome.carriage)] {
            let cell = |um: f64| format!("{um:.3}");
            table.row([
                format!("{what}, {name}"),
                cell(lines.least_squares.error_um),
                cell(lines.end_points.error_um),
                cell(lines.minimum_zone.error_um),
            ]);
        }
    }
    table
}
