//! Proofs of the emitted Verilog, and how good the proofs are.

pub mod consequence;
pub mod covers;
pub mod document;
pub mod exhaustive;
pub mod forgets;
pub mod lockstep;
pub mod mutants;
pub mod properties;
pub mod rows;
pub mod synthesis;
pub mod table;
mod tools;
pub mod vacuity;

pub use tools::Sources;
