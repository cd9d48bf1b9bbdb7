//! Panels of lines, points, steps and spectra, as SVG.
//!
//! However many points a series has, no more are drawn than can be seen: of each pixel column
//! the first, lowest, highest and last.

pub(crate) mod axis;
mod draw;
mod series;
pub(crate) mod thin;

use crate::Colour;

/// A picture of one panel or several, one below the other.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Width in pixels; a page scales it to its own.
    pub width_px: u32,
    /// The panels from top to bottom.
    pub panels: Vec<Panel>,
}

/// One pair of axes and what is drawn in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// What it shows.
    pub title: String,
    /// Height in pixels, axes included.
    pub height_px: u32,
    /// The axis to the right.
    pub x: Axis,
    /// The axis upwards.
    pub y: Axis,
    /// Shaded ranges, behind everything.
    pub bands: Vec<Band>,
    /// The data, the first at the back.
    pub series: Vec<Series>,
    /// Words at points, such as names of peaks.
    pub labels: Vec<Label>,
}

/// An axis with its unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// What it counts, and the unit: `position in mm`.
    pub label: String,
    /// Linear or logarithmic.
    pub scale: Scale,
    /// From and to; the data decide when it is `None`.
    pub range: Option<[f64; 2]>,
}

impl Axis {
    /// A linear axis that takes in all data.
    pub fn linear(label: impl Into<String>) -> Self {
        Self { label: label.into(), scale: Scale::Linear, range: None }
    }

    /// A logarithmic axis that takes in all positive data.
    pub fn log(label: impl Into<String>) -> Self {
        Self { label: label.into(), scale: Scale::Log, range: None }
    }

    /// A linear axis of whole numbers, such as rounds.
    pub fn counts(label: impl Into<String>) -> Self {
        Self { label: label.into(), scale: Scale::Counts, range: None }
    }

    /// The same axis from `low` to `high`.
    #[must_use]
    pub fn between(mut self, low: f64, high: f64) -> Self {
        self.range = Some([low, high]);
        self
    }
}

/// How numbers turn into lengths.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Equal differences are equal lengths.
    Linear,
    /// As linear, with whole numbers on it only.
    Counts,
    /// Equal ratios are equal lengths; what is not positive is left out.
    Log,
}

/// Points drawn in one way.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Name for the legend; empty for none.
    pub name: String,
    /// Colour.
    pub colour: Colour,
    /// How the points are drawn.
    pub style: Style,
    /// Pairs of x and y; a pair that is not finite interrupts a line.
    pub points: Vec<[f64; 2]>,
}

impl Series {
    /// A series in one style; `x` and `y` are paired, the longer one is cut.
    pub fn new(
        name: impl Into<String>,
        colour: Colour,
        style: Style,
        points: impl IntoIterator<Item = [f64; 2]>,
    ) -> Self {
        Self { name: name.into(), colour, style, points: points.into_iter().collect() }
    }
}

/// How points are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// Joined by straight lines.
    Line,
    /// Joined by dashed straight lines, such as limits.
    Dashes,
    /// Each holds until the next.
    Step,
    /// Dots.
    Dots,
    /// Upright lines from the bottom or zero, as in a spectrum.
    Stems,
}

/// A shaded range of one axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Band {
    /// From left to right, all heights.
    X {
        /// Left and right end.
        range: [f64; 2],
        /// Colour, drawn faintly.
        colour: Colour,
    },
    /// From bottom to top, all widths: a tolerance.
    Y {
        /// Lower and upper end.
        range: [f64; 2],
        /// Colour, drawn faintly.
        colour: Colour,
    },
}

/// Words above a point.
#[derive(Clone, Debug, PartialEq)]
pub struct Label {
    /// The point.
    pub at: [f64; 2],
    /// The words.
    pub text: String,
}

impl Figure {
    /// The figure as SVG text; the same figure gives the same bytes.
    #[must_use]
    pub fn svg(&self) -> String {
        draw::svg(self)
    }
}
