//! Names and axes of order spectra.

use helixlock_lab::NamedLine;
use helixlock_report::{Axis, Label, Panel};

/// Most lines that are named in a picture; the table has all.
const MOST: usize = 6;

/// The panel over orders, with the largest lines of one sensor by their names.
///
/// A rotary chain has slow and very fast shafts, and a logarithmic axis.
pub(crate) fn named(panel: Panel, lines: &[NamedLine], sensor: usize, rotary: bool) -> Panel {
    let label = "cycles a spindle turn";
    let x = if rotary { Axis::log(label) } else { Axis::linear(label) };
    Panel { x, labels: labels(lines, sensor, rotary), ..panel }
}

/// Order, or period of a rotary chain, and a question mark where the machine file has no name.
fn labels(lines: &[NamedLine], sensor: usize, rotary: bool) -> Vec<Label> {
    let mut lines: Vec<_> = lines.iter().filter(|line| line.sensor == sensor).collect();
    lines.sort_by(|a, b| b.line.amplitude.total_cmp(&a.line.amplitude));
    let unnamed = |line: &NamedLine| {
        if rotary {
            format!("{:.1} s ?", line.period_s)
        } else {
            format!("{:.3} ?", line.line.frequency)
        }
    };
    let label = |line: &NamedLine| Label {
        at: [line.line.frequency, line.line.amplitude],
        text: line.name.clone().unwrap_or_else(|| unnamed(line)),
    };
    lines.into_iter().take(MOST).map(label).collect()
}
