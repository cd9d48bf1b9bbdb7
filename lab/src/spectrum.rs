//! Lines over a cyclic coordinate: in an uneven record, under coloured noise, with their names.
//!
//! Also how far a problem may be thinned without losing its fastest line.

mod amplitude_spectrum;
mod bands;
mod combs;
mod lines;
mod order_spectrum;
mod thinning;

pub use amplitude_spectrum::amplitude_spectrum;
pub(crate) use lines::{LineSearch, gear_orders, lines, wave};
pub use lines::{NamedLine, lines_left};
pub use order_spectrum::Line;
pub(crate) use order_spectrum::{POINTS_A_CELL, Point, Scan, arc, strongest_first};
