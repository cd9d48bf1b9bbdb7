//! Page of `helixlock discover`: the residual before and after, and each formula with its rivals.

use helixlock_lab::{Comparison, Discovery, Problem, Proposal, RunnerUp, sensor_column};
use helixlock_report::{Colour, Page, Part, Series, Style, Table};

use crate::shared::far_readings::notes;
use crate::shared::page_pieces::{panel, picture};
use crate::shared::residual_picture::{points, x_axis};
use crate::shared::words::{doubted, why_left, with_error, with_p};

/// The page; `before` and `after` compare the data with the model as it is and with the proposals.
pub(super) fn page(
    problem: &Problem,
    found: &Discovery,
    before: &Comparison,
    after: Option<&Comparison>,
) -> Page {
    let unit = problem.measurement.unit();
    let mut parts = vec![Part::Numbers(numbers(found, unit))];
    parts.extend(found.doubts.iter().map(|doubt| Part::Note(doubted(doubt))));
    let sensors = 0..problem.sensors.len();
    parts.extend(sensors.map(|sensor| residual(problem, sensor, before, after)));
    parts.extend(found.proposals.iter().flat_map(proposal));
    if !found.effects.is_empty() {
        let names: Vec<_> = found.effects.iter().map(|effect| effect.name.as_str()).collect();
        parts.push(Part::Text(format!("Beside it, by name: {}.", names.join(", "))));
    }
    for left in &found.residual {
        let (shape, along) = (&left.shape, &left.along);
        let size = format!("{:.4} {unit} rms, {}", left.rms_um, why_left(left));
        parts.push(Part::Note(format!("Left: {shape} along {along}, {size}.")));
    }
    if !found.experiments.is_empty() {
        parts.push(Part::Heading("What would tell it from the others".into()));
        parts.push(Part::Table(experiments(found)));
    }
    let notes = notes(&problem.measurement, found.far_readings.as_ref(), &found.loud_passes);
    parts.extend(notes.into_iter().map(Part::Text));
    Page {
        title: format!("{}: a formula where no name fits", problem.model.title),
        summary: summary(found),
        parts,
    }
}

fn summary(found: &Discovery) -> String {
    match found.proposals.as_slice() {
        [] => "No formula is proposed.".into(),
        all => {
            let shapes: Vec<_> =
                all.iter().map(|one| format!("{} along {}", one.shape, one.along)).collect();
            format!("Proposed: {}.", shapes.join("; "))
        }
    }
}

fn numbers(found: &Discovery, unit: &str) -> Vec<(String, String)> {
    let size = |value: f64, words: &str| (format!("{value:.4} {unit}"), words.to_owned());
    vec![
        size(found.rms_um[0], "error before, rms"),
        size(found.rms_um[1], "error after, rms"),
        size(found.holdout_rms_um[0], "held-out data before, rms"),
        size(found.holdout_rms_um[1], "held-out data after, rms"),
    ]
}

fn residual(
    problem: &Problem,
    sensor: usize,
    before: &Comparison,
    after: Option<&Comparison>,
) -> Part {
    let line = |name, colour, values: &[f64]| {
        Series::new(name, colour, Style::Line, points(problem, sensor, values))
    };
    let mut series = vec![line("before", Colour::Orange, &before.residual)];
    series.extend(after.map(|after| line("after", Colour::Blue, &after.residual)));
    let column = sensor_column(problem.sensors[sensor], problem.measurement.rotary);
    let title = format!("{column}: residual");
    picture(
        vec![panel(&title, x_axis(problem), problem.measurement.unit(), series)],
        "What the model leaves, each pass about its own zero.",
    )
}

fn proposal(one: &Proposal) -> Vec<Part> {
    let mut parts = vec![
        Part::Heading(format!("{} along {}", one.shape, one.along)),
        Part::Listing(format!("δ = {}", one.formula)),
        Part::Table(parameters(one)),
        Part::Text(format!("Physics of this shape: {}.", one.physics)),
        Part::Text(format!("Evidence {:.0}, {}.", one.evidence, with_p(one.p_value))),
    ];
    if !one.runners_up.is_empty() {
        parts.push(Part::Text("What else could stand there:".into()));
        parts.push(Part::Table(runners_up(&one.runners_up)));
    }
    parts
}

fn parameters(one: &Proposal) -> Table {
    let mut table = Table::new(["parameter", "value", "unit"]);
    for what in &one.parameters {
        let value = match what.stderr {
            Some(stderr) => with_error(what.value, stderr),
            None => format!("{} (the data do not hold it)", what.value),
        };
        table.row([what.name.clone(), value, what.unit.clone()]);
    }
    table
}

fn runners_up(all: &[RunnerUp]) -> Table {
    let mut table = Table::new(["shape", "along", "formula δ", "evidence behind", ""]);
    for one in all {
        let alike = if one.alike { "the data cannot tell it" } else { one.refused.unwrap_or("") };
        table.row([
            one.shape.to_owned(),
            one.along.clone(),
            one.formula.clone(),
            format!("{:.0}", one.behind),
            alike.to_owned(),
        ]);
    }
    table.without_empty_columns()
}

fn experiments(found: &Discovery) -> Table {
    let mut table = Table::new(["experiment", "tells it from", "evidence expected"]);
    for one in found.experiments.iter().take(5) {
        let expected = if one.is_a_run() { format!("{:.0}", one.evidence) } else { String::new() };
        table.row([one.action.clone(), one.between.1.clone(), expected]);
    }
    table
}
