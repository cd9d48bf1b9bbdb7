//! Drives a block, runs the command, runs a tool, makes measurements.

pub(crate) mod bench;
pub(crate) mod command;
pub(crate) mod diagnosed;
pub(crate) mod passes;
pub(crate) mod seeds;
