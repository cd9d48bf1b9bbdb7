//! What crosses crates; one module a subject.
mod golden_verilog;
