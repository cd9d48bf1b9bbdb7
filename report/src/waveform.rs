//! Digital waveforms, buses and micrometres over one axis of time, with arrows from cause to
//! effect, as SVG.

mod draw;
mod shapes;

use crate::Colour;

/// A picture of signals over time.
#[derive(Clone, Debug, PartialEq)]
pub struct Waveform {
    /// Width in pixels; a page scales it to its own.
    pub width_px: u32,
    /// What the axis counts, and the unit: `time in ms`.
    pub time_label: String,
    /// First and last instant shown.
    pub range: [f64; 2],
    /// The signals from top to bottom.
    pub lanes: Vec<Lane>,
    /// From cause to effect.
    pub arrows: Vec<Arrow>,
    /// Upright lines through all lanes, each with a word.
    pub marks: Vec<(f64, String)>,
}

/// One signal over time. Values from before the range may be given: the last one still holds.
#[derive(Clone, Debug, PartialEq)]
pub enum Lane {
    /// One bit.
    Bit {
        /// Name at the left.
        name: String,
        /// Instants and levels, in order; `None` while unknown.
        changes: Vec<(f64, Option<bool>)>,
    },
    /// A number or a word that changes now and then.
    Bus {
        /// Name at the left.
        name: String,
        /// Instants and what is shown from then on, in order.
        changes: Vec<(f64, String)>,
    },
    /// A quantity, drawn as a curve with its own scale at the left.
    Analogue {
        /// Name at the left, with the unit.
        name: String,
        /// Colour of the curve.
        colour: Colour,
        /// Each value holds until the next, instead of a straight line.
        held: bool,
        /// Instants and values, in order.
        points: Vec<[f64; 2]>,
    },
}

/// An arrow from an event in one lane to what it causes in another.
#[derive(Clone, Debug, PartialEq)]
pub struct Arrow {
    /// Lane, from 0 at the top, and instant of the cause.
    pub from: (usize, f64),
    /// Lane and instant of the effect.
    pub to: (usize, f64),
}

impl Waveform {
    /// The waveform as SVG text; the same waveform gives the same bytes.
    ///
    /// Edges closer than can be seen are drawn as a grey block.
    #[must_use]
    pub fn svg(&self) -> String {
        draw::svg(self)
    }
}
