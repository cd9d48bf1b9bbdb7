//! Work on the project itself: proofs of the emitted Verilog; nothing a user needs.

pub mod prove;
