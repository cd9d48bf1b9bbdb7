//! The keys of `certify --json`; they do not change.

use helixlock_original::{Corner, Hazard};
use helixlock_sim::blocks::BlockCheck;
use helixlock_sim::{Certificate, DelaySet, FlipFlop, WholeGates};
use serde::Serialize;

use crate::shared::keys::keys;

/// A certificate, and the figures gate by gate.
#[derive(Serialize)]
pub(crate) struct WholeJson {
    #[serde(flatten)]
    pub(crate) certificate: CertificateJson,
    pub(crate) blocks: Vec<BlockJson>,
    pub(crate) hazards: Vec<HazardJson>,
    /// `None` unless asked for.
    pub(crate) whole_original: Option<GatesJson>,
    /// The same with other delays, those that were asked for.
    pub(crate) whole_original_sets: Vec<SetJson>,
}

/// The whole original with one set of delays.
#[derive(Serialize)]
pub(crate) struct SetJson {
    /// `shortest`, `longest` or `drawn`.
    delays: &'static str,
    seed: Option<u64>,
    #[serde(flatten)]
    gates: GatesJson,
}

impl SetJson {
    pub(crate) fn new((set, gates): &(DelaySet, WholeGates)) -> Self {
        let (delays, seed) = match set {
            DelaySet::Corner(Corner::Shortest) => ("shortest", None),
            DelaySet::Corner(Corner::Typical) => ("typical", None),
            DelaySet::Corner(Corner::Longest) => ("longest", None),
            DelaySet::Drawn(seed) => ("drawn", Some(*seed)),
        };
        Self { delays, seed, gates: GatesJson::new(gates) }
    }
}

keys! {
    /// A figure against its block.
    BlockJson(one: &BlockCheck) {
        figure: &'static str = one.figure,
        block: &'static str = one.block,
        pulses: u64 = one.pulses,
        different: u64 = one.different,
        delay_sets: u64 = one.drawn,
        delay_sets_different: u64 = one.drawn_different,
        first_different_seed: Option<u64> = one.first_seed,
        slowest_answer_ps: u64 = one.slowest_ps,
        data_sheet_violations: u64 = one.violations,
        swallowed_pulses: u64 = one.swallowed,
    }
    /// Where gates can go wrong.
    HazardJson(one: &Hazard) {
        figure: &'static str = one.figure,
        what: &'static str = one.what,
        turned: &'static str = one.turned,
        begins_ps: Option<u64> = one.begins_ps,
        given_ps: u64 = one.given_ps,
        kept_away: bool = one.is_kept_away(),
        kept_away_by: &'static str = one.kept_away_by,
    }
    /// The whole original, gate by gate.
    GatesJson(one: &WholeGates) {
        holds: bool = one.holds(),
        parts: usize = one.parts,
        changes: u64 = one.events,
        comparisons: usize = one.open.comparisons,
        largest_difference_s: f64 = one.open.largest_s,
        largest_difference_at_ends_s: f64 = one.open.largest_at_ends_s,
        bound_s: f64 = one.bound_s,
        bound_at_ends_s: f64 = one.bound_at_ends_s,
        other_decisions: usize = one.open.other_decisions,
        other_decision_from_coincidence_s: f64 = one.open.other_decision_s,
        closed_comparisons: usize = one.closed.comparisons,
        closed_steps: usize = one.closed.steps_taken,
        closed_largest_difference_steps: u64 = one.closed.largest_steps,
        closed_bound_steps: u64 = one.closed.bound_steps,
        closed_alike: usize = one.closed.alike,
        closed_alike_largest_difference_s: f64 = one.closed.alike_largest_s,
        data_sheet_violations: u64 = one.violations,
        swallowed_pulses: u64 = one.swallowed,
        reset_counter_off_by_steps: u64 = one.miscounted,
    }
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
