//! Names and axes of order spectra.

use helixlock_lab::NamedLine;
use helixlock_report::{Axis, Label};

/// Most lines that are named in a picture; the table has all.
const MOST: usize = 6;

/// Orders to the right; a rotary chain has slow and very fast shafts, and a logarithmic axis.
pub(crate) fn axis(rotary: bool) -> Axis {
    let label = "cycles a spindle turn";
    if rotary { Axis::log(label) } else { Axis::linear(label) }
}

/// The largest lines of one sensor by their names; order, or period of a rotary chain, and a
/// question mark where the machine file has none.
pub(crate) fn labels(lines: &[NamedLine], sensor: usize, rotary: bool) -> Vec<Label> {
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
