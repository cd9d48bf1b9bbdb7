//! The noise of a sensor: white plus slow parts, at O(n) a column and for any sampling.
//!
//! Which rows share a zero and a noise is their layout; a noise is fitted to what a model leaves,
//! and whitens columns so that plain least squares is right.

mod factor;
mod kernel;
mod layout;
mod loudness;
mod noise_fit;
mod plausible;
mod prediction;
mod smooth;
mod sweep;
#[cfg(test)]
mod tests;
mod whitener;
mod worth;

pub use kernel::{Noise, SlowPart};
pub use layout::{Block, Layout};
pub(crate) use layout::{about_means, rms, swift_rms, weighed_rms};
pub(crate) use loudness::Loudness;
pub(crate) use noise_fit::{
    NoiseFit, departures, fit_noise, is_far, is_surely_slow, outlier_inflation, scaled_to,
    without_outliers,
};
pub(crate) use plausible::plausible;
pub(crate) use prediction::Prediction;
pub(crate) use smooth::smooth_fit;
pub(crate) use whitener::Whitener;
pub(crate) use worth::effective_samples;
