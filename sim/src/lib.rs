//! Cycle-accurate simulation of the device in closed loop with the machine.

mod engine;
mod interpreter;
mod state;

pub use engine::{Engine, Stop};
pub use interpreter::Interpreter;
pub use state::{FlipFlops, Snapshot, SnapshotError, differences};
