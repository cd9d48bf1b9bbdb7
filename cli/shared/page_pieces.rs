//! Pieces of pages that all reports are made of.

use helixlock_report::{Axis, Figure, Panel, Part, Series};

/// A figure of these panels, as wide as the page.
pub(crate) fn figure(panels: Vec<Panel>) -> Figure {
    Figure { width_px: 900, panels }
}

/// The same as a part of the page, with its caption.
pub(crate) fn picture(panels: Vec<Panel>, caption: &str) -> Part {
    Part::Picture { svg: figure(panels).svg(), caption: caption.into() }
}

/// A panel of the usual height with linear axes.
pub(crate) fn panel(title: &str, x: &str, y: &str, series: Vec<Series>) -> Panel {
    Panel {
        title: title.to_owned(),
        height_px: 260,
        x: Axis::linear(x),
        y: Axis::linear(y),
        bands: Vec::new(),
        series,
        labels: Vec::new(),
    }
}

/// Points of two columns.
pub(crate) fn points(x: &[f64], y: &[f64]) -> Vec<[f64; 2]> {
    x.iter().zip(y).map(|(x, y)| [*x, *y]).collect()
}
