//! Report of `helixlock scale apply`.

use helixlock_metrology::scale::{Corrected, Direction};
use helixlock_report::{Colour, Figure, Page, Part, Series, Style, Table};

use super::comparison::Comparison;
use crate::shared::page_pieces::{self, panel};

/// The page: before and after, ISO 230-2.
pub(crate) fn page(comparison: &Comparison) -> Page {
    let number = |um: f64| format!("±{um:.2} µm");
    let mut parts = vec![
        Part::Numbers(vec![
            (number(comparison.before.largest_um), "before".into()),
            (number(comparison.after.largest_um), "after".into()),
        ]),
        Part::Picture {
            svg: figure(comparison).svg(),
            caption: "Error of the scale before and after compensation, both ways.".into(),
        },
    ];
    match &comparison.axis {
        Ok([before, after]) => {
            let mut table = Table::new(["ISO 230-2 in µm", "before", "after"]);
            let mut row = |name: &str, a: f64, b: f64| {
                table.row([name.to_owned(), format!("{a:.3}"), format!("{b:.3}")]);
            };
            row("accuracy A", before.accuracy_um, after.accuracy_um);
            row("systematic error E", before.systematic_um, after.systematic_um);
            row("range of means M", before.mean_range_um, after.mean_range_um);
            row("repeatability R", before.repeatability_um, after.repeatability_um);
            parts.push(Part::Table(table));
        }
        Err(why) => parts.push(Part::Note(format!("ISO 230-2 was not evaluated: {why}"))),
    }
    Page {
        title: "Compensation of a scale".into(),
        summary: format!("{}: {} samples.", comparison.path.display(), comparison.corrected.len()),
        parts,
    }
}

/// The figure of the page.
pub(crate) fn figure(comparison: &Comparison) -> Figure {
    let series = |name: &str, colour, direction, error: fn(&Corrected) -> f64| {
        let chosen = comparison.corrected.iter().filter(|one| one.sample.direction == direction);
        let mut points: Vec<[f64; 2]> =
            chosen.map(|one| [one.sample.position_mm, error(one)]).collect();
        points.sort_by(|a, b| a[0].total_cmp(&b[0]));
        Series::new(name, colour, Style::Line, points)
    };
    let panel = |title: &str, direction| {
        let both = vec![
            series("before", Colour::Orange, direction, |one| one.sample.error_um),
            series("after", Colour::Blue, direction, |one| one.left_um),
        ];
        panel(title, "position in mm", "error in µm", both)
    };
    let backward = comparison.corrected.iter().any(|o| o.sample.direction == Direction::Backward);
    let mut panels = vec![panel("forward", Direction::Forward)];
    if backward {
        panels.push(panel("backward", Direction::Backward));
    }
    page_pieces::figure(panels)
}
