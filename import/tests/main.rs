//! Files of every kind against what they must become, and what they must not do.

mod broken;
mod fringes;
mod properties;
mod samples;
mod stage;
