//! Files for a real FPGA, from a netlist; knows no grinder.

mod error;
mod groups;
mod lines;
mod names;
mod unused;
mod verilog;

pub use error::GenError;
pub use verilog::verilog;
