//! The synchronous device against the asynchronous one of the print, over a whole pass.
//!
//! Loop open, both get the same instants of lines and fringes, and for each comparison the two
//! widths of the meter pulse and the two decisions are compared; first on the machine, then on
//! lines and fringes that are made to coincide. Loop closed, each drives a machine of its own.
//!
//! # The bound
//!
//! A synchroniser takes an edge at the next clock, late by u < 1 clock. The meter shows its duty
//! cycle, w of the period P. With the start of the period late by `u0`, the laser's edge by `u1`
//! and the end by `u2`, the reading is off by `u1 − (1 − w/P)·u0 − (w/P)·u2`, less than a clock
//! either way:
//!
//! ```text
//! |Δt| < 1/f        |Δx| < v/f
//!
//! f clock of the FPGA, Hz    v speed of the table, µm/s
//! ```
//!
//! At the ends of the period the old flip-flop swallows a pulse, high or low, that is shorter than
//! its delay, where the synchronous one shows whole clocks: there its delay comes on top.
//!
//! 1.5 mm/s at 12 MHz: 0.125 nm. The decision falls three to four clocks after the edge. Where the
//! widths differ from half a period by less than a clock, or by less than the old flip-flop's
//! shortest clock, the two may decide differently, and no difference is measurable.

pub mod blocks;
mod closed;
mod coincidence;
mod metastability;
mod open;
mod seen;
mod whole;

use helixlock_plant::Model;

use crate::Error;
use crate::closed_loop::{Course, Grinder, Options};
use crate::historic::TTL;

pub use closed::BothClosed;
pub use metastability::{FLIP_FLOP, FlipFlop, mtbf_log10_years};
pub use open::OpenLoop;
pub use whole::{DelaySet, Drawn, GateWaves, WholeGates, certify_gates, gate_waves};

use coincidence::{Beat, Meeting};

/// Clocks from a laser pulse at the selector to the open gate, and those of the synchronisers.
const GATE_CLOCKS: f64 = 2.0;

/// What came out.
#[derive(Clone, Debug, PartialEq)]
pub struct Certificate {
    /// Loop open, on the machine.
    pub open: OpenLoop,
    /// Loop open, on edges made to coincide with the middle of the period, and with its ends.
    pub provoked: [OpenLoop; 2],
    /// Loop closed, each device on a machine of its own.
    pub closed: BothClosed,
    /// One clock, s: no difference of widths may reach it.
    pub bound_s: f64,
    /// Speed of the table, µm/s: what a second is worth.
    pub speed_um_per_s: f64,
    /// FPGA clock, Hz.
    pub clock_hz: f64,
    /// Fringes a second: how often a synchroniser may be upset.
    pub fringe_hz: f64,
}

impl Certificate {
    /// What no difference may reach where the laser's edge is at the ends of the period, s.
    #[must_use]
    pub fn bound_at_ends_s(&self) -> f64 {
        self.bound_s + TTL.flip_flop_s
    }

    /// True when every difference is below its bound, and decisions differ at coincidences only.
    #[must_use]
    pub fn holds(&self) -> bool {
        let unnoticed_s = self.bound_s.max(TTL.shortest_clock_s + 2.0 * TTL.gate_s);
        let mut runs = self.provoked.iter().chain([&self.open]);
        runs.all(|run| {
            run.largest_s < self.bound_s
                && run.largest_at_ends_s < self.bound_at_ends_s()
                && run.other_decision_s <= unnoticed_s
        }) && self.closed.alike_largest_s < self.bound_s
            && self.closed.largest_steps <= self.closed.bound_steps
    }
}

/// Runs a pass through both, loop open and loop closed.
///
/// `progress` is told how many clocks are done of [`Course::clocks`].
///
/// # Errors
///
/// [`Error`] when the device cannot serve the machine.
pub fn certify(
    model: &Model,
    length_mm: Option<f64>,
    progress: &mut dyn FnMut(u64),
) -> Result<Certificate, Error> {
    let course = Course::new(model, &Options { length_mm })?;
    let (settings, clock_hz) = (course.dialled.settings, course.clock_hz());
    let grinder = Grinder::new(model, course.length_mm)?;
    let open = open::run_open(&settings, grinder, clock_hz, course.duration_s, progress)?;
    let a_pass = course.clocks() / 2;
    let closed = closed::run_closed(model, &course, &mut |clocks| progress(a_pass + clocks))?;
    if open.comparisons == 0 || closed.comparisons == 0 {
        return Err(Error::NoComparison { length_mm: course.length_mm });
    }
    let lines_per_s = f64::from(model.grating.lines) * model.spindle.speed_rpm / 60.0;
    let provoke = |meeting| {
        let Beat { settings, trains, duration_s } =
            Beat::new(settings, meeting, 1.0 / lines_per_s, clock_hz);
        open::run_open(&settings, trains, clock_hz, duration_s, &mut |_| {})
    };
    Ok(Certificate {
        open,
        provoked: [provoke(Meeting::Middle)?, provoke(Meeting::Ends)?],
        closed,
        bound_s: 1.0 / clock_hz,
        speed_um_per_s: 1000.0 * model.travel_mm_per_s(),
        clock_hz,
        fringe_hz: 1000.0 * model.travel_mm_per_s() / model.fringe_um(),
    })
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    /// A grating with the lines that these dividers want for a lead of 6 mm.
    fn machine(a: u32, b: u32, range: u32, m: u32, compensation: &str) -> Model {
        let lines = (6000.0 / 0.316_409_915 * f64::from(a) / f64::from(b)).round();
        let text = format!(
            "[workpiece]\nlead = \"6 mm\"\nlength = \"8 mm\"\n[spindle]\nspeed = \"60 rpm\"\n\
             [grating]\nlines = {lines}\ndiameter = \"200 mm\"\n\
             [laser]\nwavelength = \"0.63281983 um\"\n\
             [dividers]\na = {a}\nb = {b}\nrange = {range}\ninitial_phase = {m}\n\
             compensation = \"{compensation}\"\n\
             [drive]\nstep = \"0.0125 um\"\nfrequency = \"800 Hz\"\n\
             [[effect]]\nkind = \"screw-progressive\"\nlinear = \"300 um/m\"\n"
        );
        Model::parse(&text, Path::new("machine.toml")).unwrap()
    }

    /// Both ranges, an odd A, and a compensation that acts hundreds of times on the way.
    #[test]
    fn differences_stay_below_a_clock() {
        for (a, b, range, m, compensation) in [
            (110, 150, 2, 150, "0 um/m"),
            (11, 15, 1, 7, "0 um/m"),
            (22, 30, 1, 11, "900 um/m"),
            (22, 30, 2, 45, "-900 um/m"),
        ] {
            let machine = machine(a, b, range, m, compensation);
            let certificate = certify(&machine, None, &mut |_| {}).unwrap();
            assert!(80 < certificate.open.comparisons, "{certificate:?}");
            assert!(certificate.holds(), "A = {a}, B = {b}: {certificate:?}");
            assert!(
                0.3 * certificate.bound_s < certificate.open.largest_s,
                "the bound is not idle"
            );
        }
    }

    /// A sixty-fourth of a clock from one comparison to the next: 128 of the 512 comparisons have
    /// their laser edge within a clock of the middle, or of the ends.
    #[test]
    fn edges_made_to_coincide_do() {
        for (a, b) in [(110, 150), (11, 15), (3, 999)] {
            let certificate = certify(&machine(a, b, 2, 1, "0 um/m"), None, &mut |_| {}).unwrap();
            for run in &certificate.provoked {
                assert!((500..=512).contains(&run.comparisons), "A = {a}, B = {b}: {run:?}");
                assert!((120..=136).contains(&run.coincidences), "A = {a}, B = {b}: {run:?}");
                assert!(run.other_decisions > 0, "A = {a}, B = {b}: {run:?}");
            }
            assert!(certificate.holds(), "A = {a}, B = {b}: {certificate:?}");
            let [_, ends] = &certificate.provoked;
            assert!(
                certificate.bound_s <= ends.largest_at_ends_s,
                "a pulse is swallowed: {ends:?}"
            );
        }
    }

    /// Both loops hunt about the same helix, and mostly stand alike.
    #[test]
    fn tables_of_closed_loops_stay_together() {
        let machine = machine(11, 15, 2, 15, "0 um/m");
        let BothClosed { comparisons, steps_taken, alike, largest_steps, bound_steps, .. } =
            certify(&machine, None, &mut |_| {}).unwrap().closed;
        assert!(800 < comparisons && comparisons < steps_taken, "{comparisons}, {steps_taken}");
        assert!(comparisons / 2 < alike, "{alike} of {comparisons}");
        assert!(largest_steps <= bound_steps, "{largest_steps} steps, at most {bound_steps}");
    }
}
