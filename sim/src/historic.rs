//! The device as document 1 printed it: asynchronous, its gates with their delays.

mod cell;
mod closed_loop;
mod device;
mod gates;

pub use cell::{Delays, TTL};
pub(crate) use closed_loop::{HistoricLoop, Ticks};
pub(crate) use device::{HistoricComparison, HistoricDevice};
pub(crate) use gates::{GateLoop, GateRun};
