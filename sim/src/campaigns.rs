//! Many runs: everything varied, every flip-flop flipped, every instant compared with the print.

#[cfg(test)]
mod adversary;
mod certify;
pub mod faults;
mod parallel;
pub mod sweep;

pub use certify::{
    BlockCheck, BothClosed, Certificate, FLIP_FLOP, FlipFlop, OpenLoop, Spread, WholeGates,
    certify, certify_gates, check_blocks, mtbf_log10_years,
};
pub use parallel::parallel;
