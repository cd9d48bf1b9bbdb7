//! Drives a block, runs the command, runs a tool.

pub(crate) mod bench;
pub(crate) mod command;
