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
mod model;
pub mod motion;
mod nature;
pub mod nearest;
mod piece;
mod play;
pub mod prediction;
mod rationalisation;
mod record;
mod smoothness;
mod term;
pub mod units;

pub use actuator::Actuator;
pub use custom::{Custom, lag, relay};
pub use dividers::Range;
pub use effect::{Basis, Card, Context, Effect, Entry, Parameter, Role, Search, Smoothness};
pub use effects::CATALOGUE;
pub use error::{EffectError, MachineError};
pub use filter::LowPass;
pub use helixlock_traces::At;
pub use lead::{Lead, LeadError, LeadUnit};
pub use machine::{Machine, Part};
pub use measured_curve::MeasuredCurve;
pub use model::{MachineFile, Model, reference};
pub use motion::Motion;
pub use nature::Nature;
pub use play::Play;
pub use rationalisation::rationalisation_um_per_m;
pub use record::{
    Bridging, COVARIATES, Column, Columns, Covariate, HeaderUnit, Instant, LOGGED_COLUMNS,
    LoggedColumn, Record, Samples, Setting,
};
pub use term::{Estimate, Formula, Sum, Term};
