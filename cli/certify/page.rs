//! Page of `helixlock certify`: the runs against their bounds, the figures gate by gate, the hazards.

use helixlock_original::{Hazard, Wave};
use helixlock_report::{
    Axis, Colour, Label, Lane, Page, Panel, Part, Series, Style, Table, Waveform,
};
use helixlock_sim::blocks::BlockCheck;
use helixlock_sim::{Certificate, OpenLoop};

use super::gates::{begins, nanoseconds};
use crate::shared::page_pieces::{panel, picture};

/// The page.
pub(crate) fn page(
    title: &str,
    all: &Certificate,
    checks: &[BlockCheck],
    hazards: &[Hazard],
) -> Page {
    let holds = if all.holds() {
        "Every difference keeps its bound, and decisions differ at coincidences only."
    } else {
        "A difference does not keep its bound, or a decision differs away from a coincidence."
    };
    Page {
        title: format!("{title}: the clocked logic against the original"),
        summary: holds.into(),
        parts: [
            Part::Numbers(numbers(all)),
            Part::Heading("Runs with the loop open".into()),
            Part::Table(runs(all)),
            Part::Heading("Figures of the report, gate by gate".into()),
            Part::Table(blocks(checks)),
            Part::Heading("Where gates can go wrong".into()),
            picture(
                vec![margins(hazards)],
                "One number of each hazard was turned until it happened. A device's 0 ns, and what \
                 never happened, cannot be drawn.",
            ),
            Part::Table(hazards_table(hazards)),
        ]
        .into_iter()
        .chain(hazards.iter().map(waveform))
        .collect(),
    }
}

fn numbers(all: &Certificate) -> Vec<(String, String)> {
    let ns = |seconds: f64| format!("{:.1} ns", 1e9 * seconds);
    vec![
        (ns(all.open.largest_s), "largest difference, loop open".into()),
        (ns(all.bound_s), "bound: one clock".into()),
        (
            format!("{} of {}", all.closed.largest_steps, all.closed.bound_steps),
            "steps that the tables are apart, loop closed, of those allowed".into(),
        ),
        (all.closed.comparisons.to_string(), "comparisons".into()),
    ]
}

fn runs(all: &Certificate) -> Table {
    let mut table = Table::new([
        "edges",
        "comparisons",
        "largest difference in ns",
        "at the ends in ns",
        "within a clock",
        "other decisions",
    ]);
    let [middle, ends] = &all.provoked;
    for (name, run) in [
        ("of the machine", &all.open),
        ("made to coincide, middle", middle),
        ("made to coincide, ends", ends),
    ] {
        let OpenLoop { comparisons, largest_s, largest_at_ends_s, .. } = run;
        table.row([
            name.to_owned(),
            comparisons.to_string(),
            format!("{:.3}", 1e9 * largest_s),
            format!("{:.3}", 1e9 * largest_at_ends_s),
            run.coincidences.to_string(),
            run.other_decisions.to_string(),
        ]);
    }
    table
}

fn blocks(checks: &[BlockCheck]) -> Table {
    let mut table = Table::new([
        "figure",
        "block",
        "pulses",
        "different",
        "sets of delays that differ",
        "slowest answer in ns",
        "violations",
        "swallowed",
    ]);
    for check in checks {
        table.row([
            check.figure.to_owned(),
            check.block.to_owned(),
            check.pulses.to_string(),
            check.different.to_string(),
            format!("{} of {}", check.drawn_different, check.drawn),
            format!("{:.1}", nanoseconds(check.slowest_ps)),
            check.violations.to_string(),
            check.swallowed.to_string(),
        ]);
    }
    table
}

/// Where each hazard begins, and what a device has.
fn margins(hazards: &[Hazard]) -> Panel {
    let numbered = || (1_u32..).map(f64::from).zip(hazards);
    let limits = numbered().filter_map(|(n, one)| Some([n, nanoseconds(one.begins_ps?)]));
    let given = numbered().map(|(n, one)| [n, nanoseconds(one.given_ps)]);
    let series = vec![
        Series::new("limit of what happens", Colour::Red, Style::Dots, limits),
        Series::new("a device has", Colour::Blue, Style::Dots, given),
    ];
    let mut panel = panel("Margins", "", "ns", series);
    let last = numbered().last().map_or(1.0, |(n, _)| n);
    panel.x = Axis::counts("hazard, in the order of the table").between(0.5, last + 0.5);
    panel.y = Axis::log("ns");
    let label = |(n, one): (f64, &Hazard)| {
        let at = [n, 1.3 * nanoseconds(one.begins_ps?.max(one.given_ps))];
        Some(Label { at, text: format!("fig. {}", one.figure) })
    };
    panel.labels = numbered().filter_map(label).collect();
    panel
}

/// What wires do where a hazard begins.
fn waveform(hazard: &Hazard) -> Part {
    let lane = |wave: &Wave| {
        let changes = wave.changes.iter().map(|(ps, level)| (nanoseconds(*ps), Some(*level)));
        Lane::Bit {
            name: wave.wire.to_owned(),
            changes: [(0.0, Some(wave.level))].into_iter().chain(changes).collect(),
        }
    };
    let waveform = Waveform {
        width_px: 960,
        time_label: "time in ns".into(),
        range: [0.0, nanoseconds(hazard.waves.lasts_ps)],
        lanes: hazard.waves.wires.iter().map(lane).collect(),
        arrows: vec![],
        marks: vec![],
    };
    let caption = format!("fig. {}: {}", hazard.figure, hazard.what);
    Part::Picture { svg: waveform.svg(), caption }
}

fn hazards_table(hazards: &[Hazard]) -> Table {
    let mut table =
        Table::new(["figure", "hazard", "turned", "happens", "a device has, ns", "kept away by"]);
    for one in hazards {
        let against = if one.is_kept_away() { "" } else { "POSSIBLE; against it: " };
        table.row([
            one.figure.to_owned(),
            one.what.to_owned(),
            one.turned.to_owned(),
            begins(one),
            format!("{:.1}", nanoseconds(one.given_ps)),
            format!("{against}{}", one.kept_away_by),
        ]);
    }
    table
}
