//! Names and axes of order spectra.

use helixlock_lab::NamedLine;
use helixlock_report::{Axis, Label, Panel};

/// A name farther from a drawn peak than this share of its order is not drawn.
const NEAR: f64 = 0.02;

/// Most lines that are named in a picture; the table has all.
const MOST: usize = 6;

/// The panel over orders, with the largest lines of one sensor by their names.
///
/// A rotary chain has slow and very fast shafts, and a logarithmic axis.
pub(crate) fn named(panel: Panel, lines: &[NamedLine], sensor: usize, rotary: bool) -> Panel {
    let label = "cycles a spindle turn";
    let x = if rotary { Axis::log(label) } else { Axis::linear(label) };
    let drawn = panel.series.first().map_or(&[][..], |series| &series.points);
    let labels = labels(lines, drawn, sensor, rotary);
    Panel { x, labels, ..panel }
}

/// Order, or period of a rotary chain, and a question mark where the machine file has no name; none
/// where nothing is drawn that it could stand at.
fn labels(lines: &[NamedLine], drawn: &[[f64; 2]], sensor: usize, rotary: bool) -> Vec<Label> {
    let mut lines: Vec<_> = lines.iter().filter(|line| line.sensor == sensor).collect();
    lines.sort_by(|a, b| b.line.amplitude.total_cmp(&a.line.amplitude));
    let unnamed = |line: &NamedLine| {
        if rotary {
            format!("{:.1} s ?", line.period_s)
        } else {
            format!("{:.3} ?", line.line.frequency)
        }
    };
    let label = |line: &NamedLine| {
        let at = top_near(drawn, line.line.frequency)?;
        Some(Label { at, text: line.name.clone().unwrap_or_else(|| unnamed(line)) })
    };
    lines.into_iter().filter_map(label).take(MOST).collect()
}

/// What to say of lines of one sensor beyond the orders drawn, which peaks may be aliases of.
pub(crate) fn aliased(lines: &[NamedLine], drawn: &[[f64; 2]], sensor: usize) -> Option<String> {
    let of: Vec<_> = beyond(lines, drawn, sensor)
        .map(|line| {
            let name = line.name.as_deref().unwrap_or("a line");
            format!("{name} at order {:.3}", line.line.frequency)
        })
        .collect();
    let said = || format!("Peaks may be aliases of {}, beyond the orders drawn.", of.join(", "));
    (!of.is_empty()).then(said)
}

/// Lines of one sensor at orders beyond those drawn.
pub(crate) fn beyond<'a>(
    lines: &'a [NamedLine],
    drawn: &[[f64; 2]],
    sensor: usize,
) -> impl Iterator<Item = &'a NamedLine> {
    let last = drawn.last().map_or(f64::INFINITY, |point| point[0]);
    lines.iter().filter(move |line| line.sensor == sensor && last < line.line.frequency)
}

/// The highest local maximum near an order.
pub(crate) fn top_near(points: &[[f64; 2]], order: f64) -> Option<[f64; 2]> {
    let tops =
        points.windows(3).filter(|three| three[0][1] < three[1][1] && three[2][1] <= three[1][1]);
    let near = tops.map(|three| three[1]).filter(|top| (top[0] - order).abs() <= NEAR * order);
    near.max_by(|one, other| one[1].total_cmp(&other[1]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_stands_at_a_top_or_nowhere() {
        let points = [[1.0, 0.1], [1.01, 0.5], [1.02, 0.2], [2.0, 0.1], [3.0, 0.3]];
        assert_eq!(top_near(&points, 1.0), Some([1.01, 0.5]));
        assert_eq!(top_near(&points, 2.0), None);
        assert_eq!(top_near(&points, 3.0), None);
    }
}
