//! Page of `helixlock sweep`: the lead error over each value that was varied, and the cases.

use helixlock_report::{Colour, Page, Part, Series, Style, Table as Rows};
use helixlock_traces::Table;

use crate::shared::cases::Row;
use crate::shared::page_pieces::{panel, picture};

/// Most cases that the page lists.
const MOST_ROWS: usize = 200;
/// Figures that the page lists, with their names there.
const LISTED: [(&str, &str); 7] = [
    ("open_total_um", "without correction in µm"),
    ("closed_total_um", "with correction in µm"),
    ("closed_periodic_um", "periodic in µm"),
    ("closed_cumulative_um", "cumulative in µm"),
    ("hunting_swing_um", "swing in µm"),
    ("slew_limited", "slew limit"),
    ("fault", "fault"),
];

/// The page of a table with these `varied` columns.
pub(super) fn page(title: &str, table: &Table, varied: &[String], rows: &[Row]) -> Page {
    let mut parts = vec![Part::Numbers(numbers(table))];
    parts.extend(varied.iter().map(|name| over(table, name)));
    parts.extend(rows.iter().filter_map(|row| {
        Some(Part::Note(format!("case {}: {}", row.case, row.failure.as_ref()?)))
    }));
    parts.push(Part::Heading("Cases".into()));
    if MOST_ROWS < rows.len() {
        parts.push(Part::Text(format!("The first {MOST_ROWS} of {}.", rows.len())));
    }
    parts.push(Part::Table(cases(table, varied)));
    Page {
        title: format!("{title}: a sweep"),
        summary: format!("{} cases over {}.", rows.len(), varied.join(", ")),
        parts,
    }
}

fn column<'a>(table: &'a Table, name: &str) -> &'a [f64] {
    table.column(name).unwrap_or_default()
}

/// The least and the greatest of what is left.
fn numbers(table: &Table) -> Vec<(String, String)> {
    let of = |name, begin: f64, better: fn(f64, f64) -> f64| {
        let values = column(table, name).iter().copied().filter(|value| value.is_finite());
        format!("{:.2} µm", values.fold(begin, better))
    };
    let (low, high) = (f64::INFINITY, f64::NEG_INFINITY);
    if !column(table, "closed_total_um").iter().any(|value| value.is_finite()) {
        return Vec::new();
    }
    vec![
        (of("closed_total_um", low, f64::min), "lead error with correction, least".into()),
        (of("closed_total_um", high, f64::max), "lead error with correction, greatest".into()),
        (of("open_total_um", high, f64::max), "without correction, greatest".into()),
    ]
}

/// Lead errors over one value; other values scatter them.
fn over(table: &Table, name: &str) -> Part {
    let dots = |figure, words, colour| {
        let pairs = column(table, name).iter().zip(column(table, figure));
        Series::new(words, colour, Style::Dots, pairs.map(|(x, y)| [*x, *y]))
    };
    let with = dots("closed_total_um", "with correction", Colour::Blue);
    let without = dots("open_total_um", "without correction", Colour::Orange);
    let alone = Series { name: String::new(), ..with.clone() };
    let drawn = |title, series| {
        let mut panel = panel(title, name, "peak to peak in µm", series);
        panel.x.range = roomy(column(table, name));
        panel
    };
    let panels = vec![
        drawn("Lead error in all", vec![without, with]),
        drawn("With correction alone", vec![alone]),
    ];
    picture(panels, "A dot a case. What else was varied scatters the dots.")
}

/// All values with room at both ends, so that no dot stands on the frame.
fn roomy(values: &[f64]) -> Option<[f64; 2]> {
    let low = values.iter().copied().reduce(f64::min)?;
    let high = values.iter().copied().reduce(f64::max)?;
    let room = 0.03 * (high - low);
    (0.0 < room).then_some([low - room, high + room])
}

fn cases(table: &Table, varied: &[String]) -> Rows {
    let header = ["case"].into_iter().chain(varied.iter().map(String::as_str));
    let mut listed = Rows::new(header.chain(LISTED.map(|(_, words)| words)));
    let varied: Vec<&[f64]> = varied.iter().map(|name| column(table, name)).collect();
    let figures = LISTED.map(|(name, _)| (column(table, name), name.ends_with("_um")));
    for (row, case) in column(table, "case").iter().take(MOST_ROWS).enumerate() {
        let mut cells = vec![case.to_string()];
        cells.extend(varied.iter().map(|values| shortened(values[row])));
        cells.extend(figures.map(|(values, in_um)| figure(values[row], in_um)));
        listed.row(cells);
    }
    listed
}

/// A number that was set or drawn, to six digits.
fn shortened(value: f64) -> String {
    format!("{value:.5e}")
        .parse::<f64>()
        .map_or_else(|_| value.to_string(), |short| short.to_string())
}

/// A length to a nanometre, or whether something was so; nothing of a case that could not be run.
fn figure(value: f64, in_um: bool) -> String {
    match (value.is_finite(), in_um) {
        (false, _) => String::new(),
        (true, true) => format!("{value:.3}"),
        (true, false) => if value == 0.0 { "no" } else { "yes" }.into(),
    }
}
