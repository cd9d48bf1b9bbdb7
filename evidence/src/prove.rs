//! Proofs of the emitted Verilog, and how good the proofs are.

pub mod alike;
mod computer;
pub mod consequence;
pub mod covers;
pub mod document;
pub mod exhaustive;
pub mod forgets;
pub mod lockstep;
pub mod mutants;
pub mod properties;
pub mod rows;
mod sniffer;
mod sources;
pub mod synthesis;
pub mod table;
pub mod tally;
pub mod vacuity;
mod workshop;

pub use sources::Sources;
