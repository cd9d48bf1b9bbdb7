//! Cycle-accurate simulation of the device in closed loop with the machine.

mod circuit;
mod compiled;
mod device;
mod engine;
mod interpreted_pieces;
mod interpreter;
mod leap;
mod moment;
#[cfg(test)]
mod random_design;
mod state;
#[allow(dead_code, reason = "a design may do without shifts")]
mod words;

pub use circuit::Circuit;
pub use compiled::{Compiled, DenseKernel};
pub use device::{DeviceEngine, DeviceKernel, device, device_engine, stepped_device};
pub use engine::{Engine, Stop};
pub use interpreted_pieces::InterpretedPieces;
pub use interpreter::Interpreter;
pub use leap::Leap;
pub use moment::{Coasting, Kernel, Moment};
pub use state::{FlipFlops, Snapshot, SnapshotError, differences};
