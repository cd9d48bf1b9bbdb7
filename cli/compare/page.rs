//! Report of `helixlock compare`: the residual, its spectrum, and where it fails.

use helixlock_lab::{Comparison, Problem, SensorResidual, sensor_column};
use helixlock_report::{Colour, Page, Part, Series, Style, Table};

use crate::shared::far_readings::notes;
use crate::shared::page_pieces::{panel, picture};
use crate::shared::residual_picture::{points, x_axis};
use crate::shared::spectrum;
use crate::shared::words::{chance, doubted, left_over, with_error};

/// The page.
pub(crate) fn page(problem: &Problem, comparison: &Comparison) -> Page {
    let unit = problem.measurement.unit();
    let mut parts = vec![Part::Numbers(numbers(comparison, problem))];
    parts.extend(comparison.doubts.iter().map(|doubt| Part::Note(doubted(doubt))));
    for (index, sensor) in comparison.sensors.iter().enumerate() {
        let residual = panel(
            &format!("{}: residual", sensor_column(sensor.sensor, problem.measurement.rotary)),
            x_axis(problem),
            unit,
            vec![Series::new(
                "measured less model",
                Colour::Orange,
                Style::Line,
                points(problem, index, &comparison.residual),
            )],
        );
        let spectrum = panel(
            "Order spectrum",
            "",
            &format!("amplitude in {unit}"),
            vec![Series::new(
                "residual",
                Colour::Blue,
                Style::Line,
                sensor.spectrum.iter().copied(),
            )],
        );
        let spectrum = spectrum::named(spectrum, &comparison.lines, index, problem.model.rotary);
        parts.push(picture(
            vec![residual, spectrum],
            "Above, what the model leaves, each pass about its own zero. Below, its spectrum; \
             lines that the machine file cannot name carry a question mark.",
        ));
        let aliased = spectrum::aliased(&comparison.lines, &sensor.spectrum, index);
        parts.extend(aliased.map(Part::Text));
    }
    parts.push(Part::Heading("Where it fails".into()));
    parts.push(Part::Table(along(comparison, unit)));
    parts.push(Part::Heading("Lines".into()));
    parts.push(Part::Table(lines(comparison, unit)));
    let notes =
        notes(&problem.measurement, comparison.far_readings.as_ref(), &comparison.loud_passes);
    parts.extend(notes.into_iter().map(Part::Text));
    let says = left_over(comparison);
    Page {
        title: format!("{}: model against measurement", problem.model.title),
        summary: format!(
            "What the model leaves is {says} (chance of noise alone: {}).",
            chance(comparison.noise_p_value)
        ),
        parts,
    }
}

fn numbers(comparison: &Comparison, problem: &Problem) -> Vec<(String, String)> {
    let unit = problem.measurement.unit();
    let column = |sensor: &SensorResidual| sensor_column(sensor.sensor, problem.measurement.rotary);
    comparison
        .sensors
        .iter()
        .flat_map(|sensor| {
            [
                (
                    format!("{:.3} {unit}", sensor.rms_um),
                    format!("{}, residual, rms", column(sensor)),
                ),
                (
                    format!("{:.3} {unit}", sensor.peak_to_peak_um),
                    format!("{}, peak to peak", column(sensor)),
                ),
            ]
        })
        .collect()
}

fn along(comparison: &Comparison, unit: &str) -> Table {
    let size = format!("rms in {unit}");
    let mut table = Table::new(["along", "shape", size.as_str(), "chance", "at"]);
    for one in &comparison.along {
        table.row([
            one.along.clone(),
            one.shape.clone(),
            format!("{:.4}", one.rms_um),
            chance(one.p_value),
            one.at.map_or(String::new(), |at| format!("{at:.4}")),
        ]);
    }
    table
}

fn lines(comparison: &Comparison, unit: &str) -> Table {
    let size = format!("amplitude in {unit}");
    let mut table = Table::new(["order", "period in s", size.as_str(), "name"]);
    for line in &comparison.lines {
        table.row([
            with_error(line.line.frequency, line.line.frequency_stderr),
            with_error(line.period_s, line.period_stderr_s),
            with_error(line.line.amplitude, line.line.amplitude_stderr),
            line.name.clone().unwrap_or_else(|| "unexplained".into()),
        ]);
    }
    table
}
