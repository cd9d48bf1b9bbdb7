//! The device as it was built: gates and flip-flops with delays, no clock.
//!
//! [`circuit`] says what is joined to what, out of the parts in [`library`]; [`figures`] has a
//! circuit for each logic drawing of document 1, and [`device`] joins them. Everything else is made from that one
//! description: [`Simulator`] runs it, [`verilog()`] prints it for another simulator, [`dump()`]
//! writes its waveforms.

pub mod circuit;
pub mod device;
pub mod figures;
pub mod hazards;
pub mod library;

mod bench;
mod delays;
mod dump;
mod error;
mod pulses;
mod simulator;
mod verilog;

pub use bench::{Bench, bench};
pub use circuit::{Circuit, Element, Function, Net};
pub use delays::{Corner, Delays};
pub use dump::dump;
pub use error::Error;
pub use hazards::{Hazard, Wave, Waves, hazards};
pub use pulses::{Change, Train, at_every_pin};
pub use simulator::{Check, Edge, Finding, Simulator};
pub use verilog::verilog;
