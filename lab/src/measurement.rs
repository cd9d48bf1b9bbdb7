//! What was measured: a table of columns, or two captured pulse trains, as samples in order.
//!
//! Headers are understood, coordinates completed from each other, rows split into passes, rounded
//! logs bridged, and impossible readings refused with their place.

mod clock_ticks;
mod coordinates;
mod direction;
mod error;
mod headers;
mod held;
mod measurand;
mod passes;
mod plausible;
mod pulse_trains;
mod quantised;
mod samples;
mod thinning;
mod zeros;

pub use error::LabError;
pub(crate) use measurand::{ARCSEC_A_TURN, UM_A_MM};
pub(crate) use passes::Restart;
pub use pulse_trains::{PulseTrains, Steps};
pub(crate) use quantised::spacing;
pub use samples::{Measurement, Nominal, Told, sensor_column};
pub(crate) use thinning::means;
