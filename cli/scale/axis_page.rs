//! The sheet of `helixlock scale iso230`.

use std::path::Path;

use helixlock_metrology::iso230::TargetResult;
use helixlock_report::{Colour, Figure, Page, Part, Series, Style, Table};

use super::axis_test::AxisTest;
use crate::shared::page_pieces::{self, panel};
use crate::shared::sheet;

/// The page: figures with their uncertainty, budgets, the axis, its targets.
pub(crate) fn page(data: &Path, test: &AxisTest) -> Page {
    let found = &test.found;
    let mut parts = sheet::parts(&test.sheet);
    let signatures = parts.pop();
    parts.extend(test.notes.iter().cloned().map(Part::Note));
    parts.push(Part::Picture {
        svg: figure(test).svg(),
        caption: "Means of the approaches from either side; thin lines are two standard \
                  uncertainties s beside them. Deviations are actual less target position."
            .into(),
    });
    parts.push(Part::Heading("Targets".into()));
    parts.push(Part::Table(targets(&found.targets).without_empty_columns()));
    parts.extend(signatures);
    Page {
        title: "Positioning accuracy by ISO 230-2".into(),
        summary: format!("{}: {} targets.", data.display(), found.targets.len()),
        parts,
    }
}

/// The figure of the page.
pub(crate) fn figure(test: &AxisTest) -> Figure {
    let targets = &test.found.targets;
    let line = |name: &str, colour, style, of: &dyn Fn(&TargetResult) -> Option<f64>| {
        let points = targets.iter().filter_map(|target| Some([target.at_mm, of(target)?]));
        Series::new(name, colour, style, points)
    };
    let forward = |k: f64| move |t: &TargetResult| Some(t.mean_forward_um + k * t.s_forward_um);
    let backward =
        |k: f64| move |t: &TargetResult| Some(t.mean_backward_um? + k * t.s_backward_um?);
    let mut series = vec![line("forward", Colour::Blue, Style::Line, &forward(0.0))];
    series.extend([2.0, -2.0].map(|k| line("", Colour::Blue, Style::Dashes, &forward(k))));
    if targets.iter().any(|target| target.mean_backward_um.is_some()) {
        series.push(line("backward", Colour::Orange, Style::Line, &backward(0.0)));
        series.extend([2.0, -2.0].map(|k| line("", Colour::Orange, Style::Dashes, &backward(k))));
    }
    page_pieces::figure(vec![panel("", "target in mm", "deviation in µm", series)])
}

fn targets(targets: &[TargetResult]) -> Table {
    let mut table = Table::new([
        "target in mm",
        "mean ↑ in µm",
        "mean ↓ in µm",
        "s ↑ in µm",
        "s ↓ in µm",
        "B in µm",
        "R in µm",
    ]);
    for target in targets {
        let cell = |um: Option<f64>| um.map_or(String::new(), |um| format!("{um:.3}"));
        table.row([
            format!("{:.3}", target.at_mm),
            cell(Some(target.mean_forward_um)),
            cell(target.mean_backward_um),
            cell(Some(target.s_forward_um)),
            cell(target.s_backward_um),
            cell(target.reversal_um),
            cell(Some(target.repeatability_um)),
        ]);
    }
    table
}
