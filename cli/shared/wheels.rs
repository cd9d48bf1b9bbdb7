//! What wheels and switches stand at, for the JSON of every command that sets them.

use helixlock_sim::Dialled;
use serde::Serialize;

/// Settings in plain numbers.
#[derive(Debug, Serialize)]
pub(crate) struct Wheels {
    pub(crate) divide_a: u32,
    pub(crate) divide_b: u32,
    pub(crate) range: u32,
    pub(crate) initial_phase: u32,
    pub(crate) compensation_f: u32,
    pub(crate) compensation_insert: bool,
    pub(crate) compensation_um_per_m: f64,
    pub(crate) step_period_clocks: u32,
    pub(crate) step_frequency_hz: f64,
}

impl From<&Dialled> for Wheels {
    fn from(dialled: &Dialled) -> Self {
        let settings = &dialled.settings;
        Self {
            divide_a: settings.a,
            divide_b: settings.b,
            range: settings.range.factor(),
            initial_phase: settings.initial_phase,
            compensation_f: settings.compensation_f,
            compensation_insert: settings.insert,
            compensation_um_per_m: dialled.compensation_um_per_m,
            step_period_clocks: settings.step_period,
            step_frequency_hz: dialled.step_frequency_hz,
        }
    }
}
