//! What wheels and switches stand at, for the JSON of every command that sets them.

use helixlock_sim::Dialled;

use super::keys::keys;

keys! {
    /// Settings in plain numbers.
    Wheels(dialled: &Dialled) {
        divide_a: u32 = dialled.settings.a,
        divide_b: u32 = dialled.settings.b,
        range: u32 = dialled.settings.range.factor(),
        initial_phase: u32 = dialled.settings.initial_phase,
        compensation_f: u32 = dialled.settings.compensation_f,
        compensation_insert: bool = dialled.settings.insert,
        compensation_um_per_m: f64 = dialled.compensation_um_per_m,
        step_period_clocks: u32 = dialled.settings.step_period,
        step_frequency_hz: f64 = dialled.step_frequency_hz,
    }
}
