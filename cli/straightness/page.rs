//! Report of `helixlock straightness`.

use helixlock_report::{Axis, Colour, Figure, Page, Panel, Part, Series, Style, Table};

use super::summary::rms_difference;
use super::{Evaluation, Outcome};

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
        (format!("{:.3} µm", rms_difference(evaluation)), "between the two methods, rms".into()),
    ];
    if let Some(sigma) = evaluation.combined.sigma_um {
        numbers.push((format!("{:.3} µm", 3.0 * sigma), "±3σ of the combined signal".into()));
    }
    let mut parts = vec![Part::Numbers(numbers)];
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
    let points = |values: &[f64]| -> Vec<[f64; 2]> {
        let positions = &evaluation.fourier.separated.position_mm;
        positions.iter().zip(values).map(|(x, y)| [*x, *y]).collect()
    };
    let (fourier, squares) = (&evaluation.fourier.separated, &evaluation.least_squares.separated);
    let both = |a: &[f64], b: &[f64]| {
        vec![
            Series::new("Fourier series", Colour::Orange, Style::Line, points(a)),
            Series::new("least squares", Colour::Blue, Style::Line, points(b)),
        ]
    };
    #[expect(clippy::cast_precision_loss, reason = "harmonics are few")]
    let number = |count: usize| count as f64;
    let harmonics = &evaluation.plan.harmonics;
    let stems = harmonics.iter().map(|harmonic| [number(harmonic.number), harmonic.gain]);
    let gains = vec![Series::new("", Colour::Blue, Style::Stems, stems)];
    // Room beside the last stem.
    let beyond = number(harmonics.len() + 1);
    Figure {
        width_px: 900,
        panels: vec![
            panel(
                "bar",
                "position in mm",
                "height in µm",
                both(&fourier.workpiece_um, &squares.workpiece_um),
            ),
            panel(
                "carriage motion",
                "position in mm",
                "δ in µm",
                both(&fourier.carriage_um, &squares.carriage_um),
            ),
            panel(
                "tilt of the carriage",
                "position in mm",
                "β in µrad",
                both(&fourier.tilt_urad, &squares.tilt_urad),
            ),
            Panel {
                x: Axis::linear("harmonic of the stroke").between(0.0, beyond),
                ..panel("gain of the probes", "", "gain", gains)
            },
        ],
    }
}

fn panel(title: &str, x: &str, y: &str, series: Vec<Series>) -> Panel {
    Panel {
        title: title.into(),
        height_px: 230,
        x: Axis::linear(x),
        y: Axis::linear(y),
        bands: Vec::new(),
        series,
        labels: Vec::new(),
    }
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
