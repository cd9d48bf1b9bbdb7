//! A machine, a measurement and some effects as one least-squares problem with correlated noise.
//!
//! A problem stacks all sensors; a component gives it columns; a fit settles coefficients and
//! noise; a state is a model so far. Held-out data and standard errors say what it is worth.

mod columns;
mod component;
mod designs;
mod finer;
mod fit;
mod holdout;
mod judged;
mod left_out;
mod problem;
mod shafts;
mod stage;
mod starts;
mod state;
mod targets;
mod uncertainty;
mod unsure;
mod waves;
mod weights;

pub(crate) use columns::Columns;
pub(crate) use component::{Component, price_of_starts};
pub(crate) use designs::GridColumns;
pub(crate) use fit::{Fit, noises_of, plain_noises, settle, settle_beside, with_noise};
pub(crate) use holdout::{helps_unseen, holdout_rms, holdout_rms_where};
pub(crate) use judged::Judged;
pub use problem::Problem;
pub(crate) use shafts::Shaft;
pub(crate) use stage::{Gain, Stage};
pub(crate) use state::{State, pattern};
pub(crate) use targets::distinct;
pub(crate) use uncertainty::{JointCovariance, joint_covariance, slopes, told_covariances};
