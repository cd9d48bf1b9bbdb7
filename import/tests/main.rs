//! Files of every kind against what they must become, and what they must not do.

mod broken;
mod properties;
mod samples;
