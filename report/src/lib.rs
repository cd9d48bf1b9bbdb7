//! Pages, plots, tables and waveforms; knows no grinder.
//!
//! - [`plot`]: panels of lines, points, steps and spectra, as SVG
//! - [`waveform`]: digital waveforms with micrometres below them, as SVG
//! - [`table`]: rows and columns, as HTML
//! - [`page`]: one self-contained HTML page of all these

mod colour;
mod markup;
pub mod page;
pub mod plot;
pub mod table;
pub mod waveform;

pub use colour::Colour;
pub use markup::translated;
pub use page::{Page, Part};
pub use plot::{Axis, Band, Figure, Label, Panel, Scale, Series, Style};
pub use table::Table;
pub use waveform::{Arrow, Lane, Waveform};
