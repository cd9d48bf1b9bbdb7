//! Every number that decides, once, with its origin.
//!
//! A number stands here when another value of it gives another answer on the same data. A number
//! that only says how closely or how quickly the same answer is reached (a tolerance, a batch, the
//! points of a grid, a bound on memory) stands beside its method; laws of probability and the
//! Bayesian information criterion are formulas, not numbers, and stand where they are used.
//!
//! Every number says where it comes from:
//!
//! - *derived* from other numbers or from a law;
//! - from a *source*;
//! - *measured*, in the campaign that is named; challenges are those of `challenge --score`, and
//!   what they come to as a whole is in `docs/guide.md`;
//! - *chosen*, and then what moves if it is doubled.
//!
//! Evidence is twice the logarithm of the odds.
//!
//! What a doubling moves is worked out where nothing else is said. Tried on the challenges of the
//! seeds 4000 to 4039, doubling `SIGNIFICANCE`, `STANDARD_ERRORS` or `MARGIN` moves no
//! verdict, no name and no rival: what these decide lies far on one side of them there.

pub(crate) mod chance;
pub(crate) mod evidence;
pub(crate) mod extent;
pub(crate) mod mistakes;
pub(crate) mod reading;
pub(crate) mod size;
