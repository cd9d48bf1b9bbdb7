//! Names in order spectra.

use helixlock_lab::lines::NamedLine;
use helixlock_report::Label;

/// The lines of one sensor by their names; a question mark where the machine file has none.
pub(crate) fn labels(lines: &[NamedLine], sensor: usize) -> Vec<Label> {
    let of_sensor = lines.iter().filter(|line| line.sensor == sensor);
    let label = |line: &NamedLine| Label {
        at: [line.line.frequency, line.line.amplitude],
        text: line.name.clone().unwrap_or_else(|| format!("{:.3} ?", line.line.frequency)),
    };
    of_sensor.map(label).collect()
}
