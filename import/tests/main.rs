//! Files of every kind against what they must become, and what they must not do.

mod broken;
mod fringes;
mod guesses;
mod headers;
mod misread;
mod overload;
mod properties;
mod samples;
mod stage;
mod twincat;
mod workbooks;
