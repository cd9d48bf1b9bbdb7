//! Reports as pages: pictures first.

pub(crate) mod compare;
pub(crate) mod learn;
mod learn_pictures;
pub(crate) mod scale;
pub(crate) mod screw;
pub(crate) mod sim;
mod spectrum;
pub(crate) mod straightness;
pub(crate) mod transmission;
pub(crate) mod undone;
mod waveforms;
