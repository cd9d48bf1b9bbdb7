//! The tools that the checks need, and the checks themselves. It stands on little, so that it is
//! compiled in seconds and can say at once which tool is missing.

pub mod python;
pub mod setup;
