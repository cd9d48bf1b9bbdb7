//! Report of `helixlock screw`.

use helixlock_metrology::screw::Estimate;
use helixlock_report::{Band, Colour, Figure, Page, Panel, Part, Series, Style, Table};

use super::evaluation::Evaluation;
use crate::shared::page_pieces::{self, panel};
use crate::shared::sheet;

/// The page: grade, curve, figures, limits.
pub(crate) fn page(evaluation: &Evaluation) -> Page {
    let grading = &evaluation.grading;
    let grade = grading.grade.as_deref().map_or("none".into(), |grade| format!("grade {grade}"));
    let mut sheet = evaluation.sheet.as_ref().map_or_else(Vec::new, sheet::parts);
    let signatures = sheet.pop();
    let mut parts = vec![Part::Numbers(numbers(evaluation, &grade))];
    parts.extend(sheet);
    parts.extend(evaluation.notes().into_iter().map(Part::Note));
    parts.push(Part::Picture {
        svg: figure(evaluation).svg(),
        caption: "Travel deviation with its mean line, and what is left of it; shaded is where the widest variation over 300 mm is reached.".into(),
    });
    parts.push(Part::Heading("Characteristics".into()));
    parts.push(Part::Table(characteristics(evaluation)));
    parts.push(Part::Heading("Limits".into()));
    parts.push(Part::Table(limits(evaluation)));
    parts.extend(signatures);
    Page {
        title: format!("Lead screw by {}", evaluation.standard),
        summary: format!(
            "{}: {} samples over {:.3} mm of useful travel, lead {} mm. Verdict: {grade}, limits {}.",
            evaluation.path.display(),
            evaluation.curve.travel_mm().len(),
            evaluation.curve.length_mm(),
            evaluation.lead_mm,
            grading.status.name(),
        ),
        parts,
    }
}

fn numbers(evaluation: &Evaluation, grade: &str) -> Vec<(String, String)> {
    let value = |one: &helixlock_metrology::screw::Characteristic| {
        let reached = one.reached.as_ref().ok()?;
        Some((format!("{:.2} µm", reached.value_um), one.symbol.to_owned()))
    };
    let mut numbers = vec![(grade.to_owned(), evaluation.standard.clone())];
    numbers.extend(evaluation.characteristics.iter().filter_map(value).take(5));
    numbers
}

/// The figure: the curve with its mean line, and what is left of it.
pub(crate) fn figure(evaluation: &Evaluation) -> Figure {
    let curve = &evaluation.curve;
    let line = &evaluation.mean_line;
    let points = || curve.travel_mm().iter().zip(curve.deviation_um());
    let ends = [curve.first_mm(), curve.last_mm()].map(|x| [x, line.at(x)]);
    let measured = points().map(|(x, y)| [*x, *y]);
    let left = points().map(|(x, y)| [*x, y - line.at(*x)]);
    let panel = |title, series| panel(title, "travel in mm", "deviation in µm", series);
    let both = vec![
        Series::new("measured", Colour::Blue, Style::Line, measured),
        Series::new("mean line", Colour::Orange, Style::Dashes, ends),
    ];
    let left = vec![Series::new("", Colour::Blue, Style::Line, left)];
    page_pieces::figure(vec![
        Panel { height_px: 300, ..panel("travel deviation", both) },
        Panel { bands: widest(evaluation), ..panel("parallel to the mean line", left) },
    ])
}

/// Where the widest variation over 300 mm is reached.
fn widest(evaluation: &Evaluation) -> Vec<Band> {
    let over_300 = ["V300", "ΔL300"];
    let mut found = evaluation.characteristics.iter().filter(|one| over_300.contains(&one.symbol));
    let reached = found.next().and_then(|one| one.reached.as_ref().ok());
    let band = |reached: &helixlock_metrology::screw::Reached| Band::X {
        range: reached.stretch_mm(),
        colour: Colour::Orange,
    };
    reached.map(band).into_iter().collect()
}

fn characteristics(evaluation: &Evaluation) -> Table {
    let mut table =
        Table::new(["symbol", "value in µm", "without noise", "from mm", "to mm", "meaning"]);
    for (one, without_noise) in evaluation.without_noise() {
        match &one.reached {
            Ok(reached) => {
                let [from, to] = reached.stretch_mm();
                let value = format!("{:.3}", reached.value_um);
                table.row([
                    one.symbol.to_owned(),
                    value,
                    without_noise.map_or(String::new(), in_words),
                    format!("{from:.3}"),
                    format!("{to:.3}"),
                    one.meaning.into(),
                ])
            }
            Err(why) => table.row([one.symbol, "", "", "", "", &why.to_string()]),
        };
    }
    table
}

/// As in `4.75 ± 0.82`, k = 2.
fn in_words(size: Estimate) -> String {
    format!("{:.3} ± {:.3} (k = 2)", size.size_um, 2.0 * size.uncertainty_um)
}

fn limits(evaluation: &Evaluation) -> Table {
    let mut table = Table::new([
        "grade",
        "symbol",
        "limit in µm",
        "value in µm",
        "holds",
        "probability",
        "status",
        "source",
    ]);
    for verdict in &evaluation.grading.verdicts {
        for one in &verdict.judgements {
            table.row([
                verdict.grade.clone(),
                one.symbol.to_owned(),
                format!("{:.2}", one.limit_um),
                format!("{:.2}", one.value_um),
                if one.holds { "yes".into() } else { "no".into() },
                one.probability.map_or(String::new(), |p| format!("{p:.4}")),
                one.status.name().into(),
                one.source.clone(),
            ]);
        }
    }
    table
}
