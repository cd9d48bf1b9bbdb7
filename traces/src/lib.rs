//! Samples and waveforms in files.
//!
//! - [`table`]: named columns of numbers; [`read_table()`] takes CSV and Parquet
//! - [`csv`], [`parquet`]: the two formats, read and written
//! - [`dump`]: a waveform written change by change, whatever the format
//! - [`vcd`]: value change dumps, written and read
//! - [`fst`]: the packed form of GTKWave, written
//! - [`capture`]: the edges of every one-bit signal of a dump
//! - [`error`]: what was wrong with a file, and where

pub mod capture;
pub mod csv;
pub mod dump;
pub mod error;
mod file;
pub mod fst;
mod number;
pub mod parquet;
pub mod table;
pub mod vcd;

pub use capture::{Capture, CapturedSignal, read_capture};
pub use dump::{Dump, Variable};
pub use error::{At, TraceError};
pub use file::{LONGEST_BYTES, read_bytes, read_table, table_of, unpacked};
pub use fst::FstWriter;
pub use number::{LARGEST, in_range};
pub use table::{Column, Table, TextColumn};
pub use vcd::{Tick, VcdReader, VcdWriter};
