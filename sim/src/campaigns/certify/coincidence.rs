//! Lines and fringes that are made to coincide: they beat slowly, a fraction of a clock from one
//! comparison to the next, so that the laser's edge comes before, at and behind the middle of the
//! period, or its ends, in steps far below a clock.

use helixlock_plant::EffectError;
use helixlock_rtl::settings::{Range, Settings};

use crate::closed_loop::{Place, Process};

/// Comparisons of a beat.
const COMPARISONS: u32 = 512;

/// Clocks that the laser's edge moves from one comparison to the next.
const DRIFT_CLOCKS: f64 = 1.0 / 64.0;

/// Which edges of a comparison the laser's edge meets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Meeting {
    /// The middle, where the decision changes.
    Middle,
    /// The ends, where a whole turn of phase is none.
    Ends,
}

/// Settings, the trains that make their edges meet, and for how long, s.
#[derive(Debug)]
pub(crate) struct Beat {
    pub(crate) settings: Settings,
    pub(crate) trains: Trains,
    pub(crate) duration_s: f64,
}

/// Two trains of pulses, each at equal intervals; no step moves them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Trains {
    line_s: f64,
    line_period_s: f64,
    lines: u32,
    fringe_period_s: f64,
    fringes: u32,
}

impl Beat {
    /// A beat of a device with these dividers, at x2, whose lines come every `line_period_s`.
    ///
    /// The gate opens with the m-th fringe, m being B for the middle and 2B for the ends. The
    /// line a few clocks before it is too early to pass; from there on 2A lines take as long as 2B
    /// fringes and the drift, so that the laser's edge begins late and ends early.
    pub(crate) fn new(
        wheels: Settings,
        meeting: Meeting,
        line_period_s: f64,
        clock_hz: f64,
    ) -> Self {
        // 2B has to fit on the three wheels of the phase selector.
        let b = if wheels.b < 500 { wheels.b } else { wheels.b / 2 };
        let m = if meeting == Meeting::Middle { b } else { 2 * b };
        let settings = Settings {
            b,
            range: Range::X2,
            initial_phase: m,
            compensation_f: 0,
            insert: false,
            ..wheels
        };
        let drift_s = DRIFT_CLOCKS / clock_hz;
        let period_s = 2.0 * f64::from(wheels.a) * line_period_s;
        let fringe_period_s = (period_s - drift_s) / (2.0 * f64::from(b));
        let opens_s = f64::from(m) * fringe_period_s;
        let last_line_s = opens_s - drift_s * f64::from(COMPARISONS / 2);
        let trains = Trains {
            line_s: libm::fmod(last_line_s, line_period_s),
            line_period_s,
            lines: 0,
            fringe_period_s,
            fringes: 0,
        };
        Self { settings, trains, duration_s: opens_s + f64::from(COMPARISONS) * period_s }
    }
}

impl Process for Trains {
    fn next_line_s(&mut self) -> f64 {
        self.line_s + f64::from(self.lines) * self.line_period_s
    }

    fn next_fringe_s(&mut self) -> f64 {
        f64::from(self.fringes + 1) * self.fringe_period_s
    }

    fn pass_line(&mut self) {
        self.lines += 1;
    }

    fn pass_fringe(&mut self) {
        self.fringes += 1;
    }

    fn step(&mut self, _: f64, _: bool) {}

    fn place(&mut self, _: f64) -> Place {
        Place::default()
    }

    fn failure(&self) -> Option<EffectError> {
        None
    }
}
