//! Page of `helixlock faults`: what the flips amount to, and block by block.

use helixlock_report::{Axis, Band, Colour, Page, Part, Series, Style, Table};
use helixlock_sim::faults::{Outcome, Verdict};

use super::blocks::{HEADER, by_block, safeguards};
use super::rows::{Faults, VERDICTS};
use crate::shared::page_pieces::{panel, picture};

/// The page.
pub(super) fn page(title: &str, faults: &Faults) -> Page {
    let mut table = Table::new(HEADER);
    for (name, block) in by_block(faults) {
        table.row(block.cells(name));
    }
    let mut parts = vec![
        Part::Numbers(VERDICTS.map(|(verdict, name)| counted(faults, verdict, name)).into()),
        worst(faults),
        Part::Heading("By block".into()),
        Part::Table(table),
        Part::Heading("Safeguards".into()),
    ];
    parts.extend(safeguards(faults).map(Part::Text));
    Page {
        title: format!("{title}: every flip-flop flipped"),
        summary: format!(
            "{} flip-flops at {} instants, followed for {:.2} s; on course is within {:.4} µm.",
            faults.flip_flops.len(),
            faults.instants_s.len(),
            faults.window_s,
            faults.band_um
        ),
        parts,
    }
}

fn counted(faults: &Faults, verdict: Verdict, name: &str) -> (String, String) {
    let count = faults.outcomes.iter().filter(|flip| flip.verdict == verdict).count();
    (format!("{count} of {}", faults.outcomes.len()), name.to_owned())
}

/// How far each flip takes the table off its course.
fn worst(faults: &Faults) -> Part {
    let colours = [Colour::Grey, Colour::Blue, Colour::Orange, Colour::Red];
    let series = VERDICTS.iter().zip(colours).map(|((verdict, name), colour)| {
        let flips = faults.outcomes.iter().filter(|flip| flip.verdict == *verdict);
        Series::new(*name, colour, Style::Dots, flips.map(point))
    });
    let mut panel = panel("Worst error of each flip", "", "off its course in µm", series.collect());
    panel.x = Axis::counts("flip-flop, in the order of the device");
    panel.bands = vec![Band::Y { range: [0.0, faults.band_um], colour: Colour::Green }];
    picture(vec![panel], "The green band is on course. What stays is ground into the thread.")
}

#[expect(clippy::cast_precision_loss, reason = "a device has some hundred flip-flops")]
fn point(flip: &Outcome) -> [f64; 2] {
    [flip.flip_flop as f64, flip.worst_um]
}
