//! Work on the project itself: proofs of the emitted Verilog, and the output before and after a
//! change; nothing a user needs.

pub mod prove;
pub mod same_output;
mod tools;
