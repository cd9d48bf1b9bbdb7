//! A machine for pictures: its table swings slowly about the theoretical helix.
//!
//! A real error is a few thousandths of the range, which no eye sees in the width of a pulse. This
//! one swings by an eighth of it, so that figures 3 and 16 show pulses wide and narrow.
//!
//! ```text
//! x(t) = v·t − a·sin(2π·t/P) + correction      travel, µm
//! ```

use std::f64::consts::TAU;

use helixlock_plant::EffectError;

use super::process::{Place, Process};

/// Spindle at constant speed, table swinging.
#[derive(Clone, Copy, Debug)]
pub struct Swing {
    /// Table speed, µm/s.
    pub speed_um_per_s: f64,
    /// Nominal travel from line to line, µm.
    pub line_um: f64,
    /// Travel from fringe to fringe, µm.
    pub fringe_um: f64,
    /// Lag at its largest, µm; `2π·amplitude/period` stays below the speed.
    pub amplitude_um: f64,
    /// Of the swing, s.
    pub period_s: f64,
    /// Of one step, µm.
    pub step_um: f64,
    /// When the lag begins, s.
    pub begin_s: f64,
    /// Where the run stands.
    pub progress: Progress,
}

/// What has passed so far.
#[derive(Clone, Copy, Debug, Default)]
pub struct Progress {
    lines: f64,
    fringes: f64,
    correction_um: f64,
    last_s: f64,
}

impl Progress {
    /// Nothing has passed.
    pub const START: Self = Self { lines: 0.0, fringes: 0.0, correction_um: 0.0, last_s: 0.0 };
}

impl Swing {
    fn lag_um(&self, time_s: f64) -> f64 {
        let since_s = (time_s - self.begin_s).max(0.0);
        self.amplitude_um * libm::sin(TAU * since_s / self.period_s)
    }

    fn travel_um(&self, time_s: f64) -> f64 {
        self.speed_um_per_s * time_s - self.lag_um(time_s) + self.progress.correction_um
    }
}

impl Process for Swing {
    fn next_line_s(&mut self) -> f64 {
        (self.progress.lines + 1.0) * self.line_um / self.speed_um_per_s
    }

    /// By bisection: the travel rises, and the lag puts the instant off by no more than it can.
    fn next_fringe_s(&mut self) -> f64 {
        let travel_um = (self.progress.fringes + 1.0) * self.fringe_um;
        let middle_s = (travel_um - self.progress.correction_um) / self.speed_um_per_s;
        let margin_s = self.amplitude_um / self.speed_um_per_s;
        let (mut low_s, mut high_s) = (middle_s - margin_s, middle_s + margin_s);
        for _ in 0..60 {
            let time_s = f64::midpoint(low_s, high_s);
            if self.travel_um(time_s) < travel_um {
                low_s = time_s;
            } else {
                high_s = time_s;
            }
        }
        high_s.max(self.progress.last_s)
    }

    fn pass_line(&mut self) {
        self.progress.lines += 1.0;
    }

    fn pass_fringe(&mut self) {
        self.progress.fringes += 1.0;
    }

    fn step(&mut self, time_s: f64, forward: bool) {
        self.progress.correction_um += if forward { self.step_um } else { -self.step_um };
        self.progress.last_s = time_s;
    }

    fn place(&mut self, time_s: f64) -> Place {
        let nominal_um = self.speed_um_per_s * time_s;
        Place {
            position_mm: nominal_um / 1000.0,
            lead_error_um: self.travel_um(time_s) - nominal_um,
            correction_um: self.progress.correction_um,
        }
    }

    fn failure(&self) -> Option<EffectError> {
        None
    }
}
