//! Value change dumps (IEEE 1364-2005, clause 18): written with bits and real numbers together,
//! read from any producer.

mod header;
mod plain;
mod reader;
mod tick;
mod writer;

pub use ::vcd::Value as Bit;

pub use reader::{Change, Signal, Value, VcdReader};
pub use tick::Tick;
pub use writer::VcdWriter;
