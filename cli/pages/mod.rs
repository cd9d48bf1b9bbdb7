//! Reports as pages: pictures first.

pub(crate) mod scale;
pub(crate) mod screw;
pub(crate) mod sim;
pub(crate) mod straightness;
pub(crate) mod transmission;
mod waveforms;
