//! Machines with something hidden, to see whether the diagnosis finds it.

mod error;
mod experiment;
mod outside;
mod recipe;
mod scene;
mod score;
mod scored;
mod task;

pub use error::ChallengeError;
pub use experiment::{Experimented, experiment};
pub use score::{Figure, Score, Share};
pub use scored::Scored;
pub use task::{Challenge, Hidden, Outcome, challenge, judge};
