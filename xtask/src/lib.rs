//! Work on the project itself: proofs of the emitted Verilog, the output before and after a change,
//! the tools that the checks need, what the command is made of; nothing a user needs.

pub mod prove;
pub mod python;
pub mod same_output;
pub mod sbom;
pub mod setup;
mod tools;
