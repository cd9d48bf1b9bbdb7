//! Reports as pages: pictures first.

pub(crate) mod sim;
mod waveforms;
