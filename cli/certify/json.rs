//! The keys of `certify --json`; they do not change.

use helixlock_sim::{Certificate, FlipFlop};

use crate::shared::keys::keys;

keys! {
    /// A whole certificate.
    CertificateJson(all: &Certificate, flip_flop: FlipFlop, mtbf_log10_years: f64) {
        holds: bool = all.holds(),
        comparisons: usize = all.open.comparisons,
        largest_difference_s: f64 = all.open.largest_s,
        largest_difference_um: f64 = all.open.largest_s * all.speed_um_per_s,
        rms_difference_s: f64 = all.open.rms_s,
        bound_s: f64 = all.bound_s,
        bound_um: f64 = all.bound_s * all.speed_um_per_s,
        other_decisions: usize = all.open.other_decisions,
        other_decision_from_coincidence_s: f64 = all.open.other_decision_s,
        coincidences: usize = all.open.coincidences,
        short_clock_pulses: u64 = all.open.runts,
        bound_at_ends_s: f64 = all.bound_at_ends_s(),
        provoked_comparisons: [usize; 2] = all.provoked.each_ref().map(|run| run.comparisons),
        provoked_coincidences: [usize; 2] = all.provoked.each_ref().map(|run| run.coincidences),
        provoked_largest_difference_s: [f64; 2] = all.provoked.each_ref().map(|run| run.largest_s),
        provoked_largest_difference_at_ends_s: [f64; 2] =
            all.provoked.each_ref().map(|run| run.largest_at_ends_s),
        provoked_other_decisions: [usize; 2] =
            all.provoked.each_ref().map(|run| run.other_decisions),
        closed_comparisons: usize = all.closed.comparisons,
        closed_steps: usize = all.closed.steps_taken,
        closed_largest_difference_steps: u64 = all.closed.largest_steps,
        closed_largest_difference_um: f64 = all.closed.largest_um,
        closed_bound_um: f64 = all.closed.bound_um,
        closed_alike: usize = all.closed.alike,
        closed_alike_largest_difference_s: f64 = all.closed.alike_largest_s,
        closed_largest_difference_s: f64 = all.closed.largest_s,
        mtbf_log10_years: f64 = mtbf_log10_years,
        flip_flop_tau_s: f64 = flip_flop.tau_s,
        flip_flop_window_s: f64 = flip_flop.window_s,
        flip_flop_overhead_s: f64 = flip_flop.overhead_s,
    }
}
