//! Machines with something hidden, to see whether the diagnosis finds it.

mod error;
mod outside;
mod recipe;
mod scene;
mod task;

pub use error::ChallengeError;
pub use task::{Challenge, Hidden, Outcome, challenge, judge};
