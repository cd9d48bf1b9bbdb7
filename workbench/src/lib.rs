//! Pages of the workbench, and the guarded server that shows them.
//!
//! What the pages ask for is answered by a [`Desk`] that the command brings; this crate knows neither
//! grinders nor files nor JSON.
//!
//! - [`server`]: HTTP on the loopback interface
//! - [`words`]: every text of the pages, English and Chinese

mod guard;
mod pages;
pub mod server;
pub mod words;

pub use server::{Answer, Ask, Desk, Kind, ServeError, serve};
