//! What the project says of itself, and how it is known: proofs of the emitted Verilog, the
//! original's gates in Icarus, the output before and after a change, what the command is made of.

pub mod icarus;
pub mod prove;
pub mod same_output;
pub mod sbom;
mod tools;
