//! The shapes that waveforms are made of.

use std::fmt::Write;

use crate::Colour;

/// A stretch of a lane; without a value it changes too often to be seen.
pub(super) struct Segment<'v, V> {
    pub(super) begin_px: f64,
    pub(super) end_px: f64,
    pub(super) value: Option<&'v V>,
}

pub(super) fn push_run(path: &mut String, run: &[[f64; 2]], held: bool) {
    for (index, [x, y]) in run.iter().enumerate() {
        let _ = match (index, held) {
            (0, _) => write!(path, "M{x:.1},{y:.1} "),
            (_, true) => write!(path, "H{x:.1} V{y:.1} "),
            (_, false) => write!(path, "L{x:.1},{y:.1} "),
        };
    }
}

pub(super) fn push_path(svg: &mut String, path: &str, colour: Colour) {
    let (path, colour) = (path.trim_end(), colour.hex());
    push(
        svg,
        &format!("<path d=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.4\"/>"),
    );
}

pub(super) fn push_box(
    svg: &mut String,
    [left, right]: [f64; 2],
    [low, high]: [f64; 2],
    fill: &str,
) {
    let (width, height) = (right - left, low - high);
    push(
        svg,
        &format!(
            "<rect x=\"{left:.1}\" y=\"{high:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" fill=\"{fill}\"/>"
        ),
    );
}

pub(super) fn push(svg: &mut String, element: &str) {
    svg.push_str(element);
    svg.push('\n');
}

#[expect(clippy::cast_precision_loss, reason = "words in a picture are short")]
pub(super) fn characters(word: &str) -> f64 {
    word.chars().count() as f64
}
