//! Uncertainty of a measured figure: a budget by the GUM.
//!
//! The contributors are those ISO/TR 230-9 (2005) names for a positioning test: calibration of the
//! device, its misalignment, temperature and expansion of machine and device, variation of the
//! environment. How each acts on a figure is not taken from a table of factors but found by
//! adding the error to the readings and evaluating them again (JCGM 100:2008, 5.1.3), so that one
//! law serves every figure: for five runs it gives the known `U(R) = 2·U` of a reading and
//! `U(E) = √(2/5)·U`.

mod budget;
mod expanded;
mod source;

pub(crate) use budget::student;
pub use budget::{Budget, Contribution, budgets};
pub use source::{Acts, Added, Distribution, Noise, Readings, Source, Told, misalignment};
