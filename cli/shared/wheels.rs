//! What wheels and switches stand at, for the JSON of every command that sets them.

use std::fmt;

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

impl fmt::Display for Wheels {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "A {}, B {}, range x{}, initial phase {}, compensation {:+.3} µm/m, step every {} \
             clocks ({:.3} Hz)",
            self.divide_a,
            self.divide_b,
            self.range,
            self.initial_phase,
            self.compensation_um_per_m,
            self.step_period_clocks,
            self.step_frequency_hz,
        )
    }
}
