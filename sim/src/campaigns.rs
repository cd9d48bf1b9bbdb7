//! Many runs: everything varied, every flip-flop flipped, every instant compared with the print.

#[cfg(test)]
mod adversary;
mod certify;
pub mod faults;
mod parallel;
pub mod sweep;

pub use certify::{
    BothClosed, Certificate, DelaySet, Drawn, FLIP_FLOP, FlipFlop, GateWaves, OpenLoop, WholeGates,
    blocks, certify, certify_gates, gate_waves, mtbf_log10_years,
};
pub use parallel::parallel;
