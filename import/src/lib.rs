//! Tables of measured data from what instruments write.
//!
//! A file is read by a [`Recipe`]: every decision with its reason. [`propose`] finds out what a recipe
//! leaves open and asks what it cannot find out; [`apply`] reads a file by a recipe, and gives the
//! same bytes again.
//!
//! - [`recipe`]: decisions, as TOML
//! - [`question`]: what a file leaves open
//! - [`error`]: what was wrong, and where

mod build;
mod data;
mod decide;
mod delimited;
mod encoding;
pub mod error;
mod formats;
mod fringes;
mod grid;
mod header;
mod instant;
mod layout;
mod limits;
mod marks;
mod number;
mod outline;
mod place;
mod propose;
pub mod question;
pub mod recipe;
mod rules;
mod runs;
mod samples;
mod statistic;
mod steps;
mod stopwatch;
mod text;
mod upright;

pub use error::ImportError;
pub use place::Place;
pub use propose::{Proposal, Source, apply, propose};
pub use question::{Answer, Question};
pub use recipe::{ColumnRule, Recipe, Setting, Value};
