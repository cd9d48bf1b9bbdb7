//! Transmission error from two pulse trains, by the five methods of document 4.
//!
//! An input shaft gives `λ1` pulses a turn, an output shaft `λ2`; the input turns `i` times for one
//! turn of the output. The error is what the output has turned less what it should have:
//!
//! ```text
//! δ = θ2 − θ1/i                         rad at the output; positive when the output is ahead
//! ```
//!
//! At the `j`-th output pulse, with `n1` input pulses (and their fraction) so far,
//! `δ = (j·R − n1)·2π/(i·λ1)` with `R = i·λ1/λ2`. The methods differ in how they find `n1`.
//! (The document's counting formulas give `−i·δ`, the same error seen at the input.)

mod analog;
mod capture_tick;
mod counting;
mod digital;
mod divided;
mod gearing;
mod method;
mod missing_pulses;
mod order_spectrum;
mod peaks;
mod pulses;
mod subdivided;
mod synthesis;
mod unevenness;

pub use digital::digital_word;
pub use gearing::Gearing;
pub use method::{Cost, Limits, Method, Reading, Sample, Setup, error_against, measure};
pub use order_spectrum::{OrderLine, OrderSpectrum, Shaft, ShaftLine, order_spectrum};
pub use peaks::{Peak, peaks};
pub use pulses::Pulses;
pub use subdivided::subdivided_word;
pub use synthesis::{Synthesis, synthesise};
