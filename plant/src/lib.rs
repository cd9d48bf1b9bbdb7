//! The machine and its physics; no flip-flops.

mod actuator;
pub mod air;
mod compensation;
mod custom;
pub mod dividers;
pub mod edges;
mod effect;
pub mod effects;
mod error;
mod filter;
mod lead;
pub mod machine;
mod measured_curve;
pub mod motion;
mod piece;
pub mod prediction;
mod record;
mod refined;
mod samples;
mod smoothness;
mod term;
pub mod units;

pub use actuator::{Actuator, Play};
pub use custom::Custom;
pub use effect::{Basis, Card, Context, Effect, Entry, Parameter, Role, Search, Smoothness};
pub use effects::CATALOGUE;
pub use error::{EffectError, MachineError};
pub use filter::LowPass;
pub use helixlock_traces::At;
pub use lead::{Lead, LeadError, LeadUnit};
pub use machine::{Machine, MachineFile, Range};
pub use measured_curve::MeasuredCurve;
pub use motion::Motion;
pub use record::{COVARIATES, Columns, Covariate, Instant, Record, Samples};
pub use term::{Estimate, Formula, Sum, Term};
