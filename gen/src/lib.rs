//! Files for a real FPGA, from a netlist; knows no grinder.
//!
//! [`verilog`] writes one module a block; [`project`] adds constraints, test bench and Makefile
//! for a [`Board`]; [`synthesise`] runs the tools on them.

mod adapt;
mod board;
mod bypass;
mod constraints;
mod error;
mod exchange;
mod family;
mod flow;
mod groups;
mod lines;
mod makefile;
mod memory;
mod names;
mod project;
mod synchronisers;
mod synthesis;
mod template;
mod test_bench;
mod tidy;
mod unused;
mod verilog;

pub use adapt::{leave_out, prefix};
pub use board::Board;
pub use bypass::bypass;
pub use constraints::Pin;
pub use error::{GenError, Origin};
pub use exchange::{Source, exchange};
pub use family::Family;
pub use memory::attach_memory;
pub use project::{Project, project};
pub use synthesis::{Synthesis, synthesise};
pub use test_bench::{Bench, Vector};
pub use verilog::verilog;
