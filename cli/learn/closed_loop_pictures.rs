//! Pictures of the learned machine in its closed loop.

use helixlock_lab::sensor_column;
use helixlock_report::{Colour, Part, Series, Style};

use super::closed_loop_check::Checked;
use crate::shared::page_pieces::{panel, picture};

/// Measured and simulated over each other, where the loop is closed.
pub(crate) fn closed_loop(check: &Checked) -> Vec<Part> {
    let mut parts: Vec<Part> = check.sentences().into_iter().map(Part::Text).collect();
    if !parts.is_empty() {
        parts.insert(0, Part::Heading("In the closed loop".into()));
    }
    let Checked::Done(check) = check else { return parts };
    for one in &check.sensors {
        let column = |index: usize| one.points.iter().map(move |p| [p[0], p[index]]);
        let series = vec![
            Series::new("measured", Colour::Orange, Style::Dots, column(1)),
            Series::new("simulated", Colour::Blue, Style::Line, column(2)),
        ];
        let title = format!("{}, pass {}", sensor_column(one.sensor, false), check.pass);
        let panel = panel(&title, "position in mm", "µm", series);
        parts.push(picture(
            vec![panel],
            "The learned machine run clock by clock with its loop closed, and what was measured.",
        ));
    }
    parts
}
