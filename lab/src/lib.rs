//! Model against measurement.

pub mod acceptance;
pub mod adding;
pub mod amplitude_spectrum;
pub mod analysis;
pub mod calibration;
pub mod candidates;
pub mod challenge;
pub mod compare;
pub mod component;
pub mod designs;
pub mod diagnosis;
pub mod error;
pub mod experiment;
pub mod final_check;
pub mod finer;
pub mod fit;
pub mod fourier;
pub mod holdout;
pub mod jumps;
pub mod layout;
pub mod learn;
pub mod least_squares;
pub mod likeness;
pub mod lines;
pub mod measurement;
pub mod noise;
pub mod noise_fit;
pub mod order_spectrum;
pub mod plain_shapes;
pub mod polish;
pub mod probes;
pub mod problem;
pub mod pruning;
pub mod pulse_trains;
pub mod quasi_newton;
pub mod repeatability;
pub mod rivals;
pub mod sampling;
pub mod setting_trial;
pub mod settings;
pub mod simplex;
pub mod stage;
pub mod tails;
mod thinning;
pub mod trial;
pub mod uncertainty;

/// A count as a number to calculate with; exact up to 2⁵³.
#[expect(clippy::cast_precision_loss, reason = "no file has 2⁵³ rows")]
pub(crate) fn count(count: usize) -> f64 {
    count as f64
}
