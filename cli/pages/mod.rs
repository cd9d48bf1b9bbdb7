//! Reports as pages: pictures first.

pub(crate) mod compare;
pub(crate) mod learn;
pub(crate) mod scale;
pub(crate) mod screw;
pub(crate) mod sim;
pub(crate) mod straightness;
pub(crate) mod transmission;
mod waveforms;
