//! Lead screws, straightness, scales and transmission error: numbers in, numbers out.

#![cfg_attr(test, allow(clippy::float_cmp, reason = "tests say where equality is meant"))]

mod banded;
mod chance;
mod conformity;
mod drawn;
mod error;
pub mod iso230;
mod number;
pub mod scale;
pub mod screw;
pub mod straightness;
pub mod transmission;
pub mod uncertainty;

pub use conformity::{Conformity, conformity};
pub use error::Error;
