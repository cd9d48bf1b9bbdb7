//! Proofs of the emitted Verilog, and how good the proofs are.

pub mod covers;
pub mod forgets;
pub mod lockstep;
pub mod mutants;
pub mod properties;
pub mod table;
mod tools;

pub use tools::Sources;
