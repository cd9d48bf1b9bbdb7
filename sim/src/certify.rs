//! The synchronous device against the asynchronous one of the print, over a whole pass.
//!
//! Both get the same instants of lines and fringes, the loop open so that they stay the same. For
//! each comparison the two widths of the meter pulse and the two decisions are compared.
//!
//! # The bound
//!
//! A synchroniser takes an edge at the next clock: each edge of the meter pulse is late by less
//! than a clock, so the width is off by less than one clock either way,
//!
//! ```text
//! |Δt| < 1/f        |Δx| < v/f
//!
//! f clock of the FPGA, Hz    v speed of the table, µm/s
//! ```
//!
//! 1.5 mm/s at 12 MHz: 0.125 nm. The decision falls three to four clocks after the edge. Where the
//! widths differ from half a period by less than a clock, or by less than the old flip-flop's
//! shortest clock, the two may decide differently, and no difference is measurable.
//!
//! # Metastability
//!
//! `MTBF = exp(t/τ) / (T_w · f · f_in)`, where `t` is the settling time between the two flip-flops
//! of a synchroniser.

use std::cell::RefCell;
use std::rc::Rc;

use helixlock_plant::Machine;

use crate::closed_loop::{ClosedLoop, Place, Process};
use crate::historic_cell::TTL;
use crate::historic_device::{HistoricComparison, HistoricDevice};
use crate::pass::reset;
use crate::pins::{clock_of, time_of};
use crate::probe::{Probe, signals_of};
use crate::{Comparison, Course, Engine, Error, Grinder, Options, Waveform, device_engine};
use crate::{set_wheels, settings_for};

/// Clocks from a laser pulse at the selector to the open gate, and those of the synchronisers.
const GATE_CLOCKS: f64 = 2.0;

/// What is assumed of a flip-flop of the FPGA: the maker prints no figures, so these have no source,
/// and the result says that they are assumed.
pub const FLIP_FLOP: FlipFlop = FlipFlop { tau_s: 0.2e-9, window_s: 0.2e-9, overhead_s: 3e-9 };

/// Metastability parameters of a flip-flop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlipFlop {
    /// Time constant with which it settles, s.
    pub tau_s: f64,
    /// Window around the clock edge in which it is upset, s.
    pub window_s: f64,
    /// Clock to output, routing and set-up, lost to settling, s.
    pub overhead_s: f64,
}

/// What came out.
#[derive(Clone, Debug, PartialEq)]
pub struct Certificate {
    /// Comparisons compared.
    pub comparisons: usize,
    /// Largest difference of the meter's width, s.
    pub largest_s: f64,
    /// The same at the table, µm.
    pub largest_um: f64,
    /// Root mean square of the difference, s.
    pub rms_s: f64,
    /// One clock, s: no difference may reach it.
    pub bound_s: f64,
    /// The same at the table, µm.
    pub bound_um: f64,
    /// Comparisons with another decision.
    pub other_decisions: usize,
    /// Largest distance of the laser's edge from the middle among those, s.
    pub other_decision_s: f64,
    /// Comparisons whose laser edge is within a clock of the middle, or of the period's ends.
    pub coincidences: usize,
    /// Clock pulses of the old flip-flop that were too short for it.
    pub runts: u64,
    /// Logarithm to base 10 of the mean time between failures of one synchroniser, years.
    pub mtbf_log10_years: f64,
}

impl Certificate {
    /// True when every difference is below the bound, and decisions differ at coincidences only.
    #[must_use]
    pub fn holds(&self) -> bool {
        let unnoticed_s = self.bound_s.max(TTL.shortest_clock_s + 2.0 * TTL.gate_s);
        self.largest_s < self.bound_s && self.other_decision_s <= unnoticed_s
    }
}

/// Runs a pass, open loop, through both.
///
/// `progress` is told how many clocks are done of [`Course::clocks`], which counts two passes.
///
/// # Errors
///
/// [`Error`] when the device cannot serve the machine.
pub fn certify(
    machine: &Machine,
    length_mm: Option<f64>,
    progress: &mut dyn FnMut(u64),
) -> Result<Certificate, Error> {
    let course = Course::new(machine, &Options { length_mm, ..Options::default() })?;
    let settings = settings_for(machine)?.settings;
    let clock_hz = course.clock_hz();
    let historic = HistoricDevice::new(settings, GATE_CLOCKS / clock_hz);
    let historic = Rc::new(RefCell::new(historic));
    let grinder = Grinder::new(machine, course.length_mm)?;
    let both = Both { grinder, historic: Rc::clone(&historic) };
    let mut engine = device_engine();
    set_wheels(&mut engine, &settings)?;
    let mut device = ClosedLoop::new(engine, both, clock_hz, course.full_scale_um)?;
    let end = clock_of(course.duration_s, clock_hz);
    let signals = signals_of(device.engine().netlist(), &["q".to_owned()])?;
    reset(&mut device)?;
    device.begin_recording(Probe { signals, window: 0..end });
    device.set_moving()?;
    let mut clock = 0;
    while clock < end {
        clock = (clock + end.div_ceil(100)).min(end);
        device.run_until(clock, |_| false)?;
        progress(2 * clock);
    }
    let q = device.end_recording().unwrap_or_default();
    let synchronous: Vec<_> = device.samples.iter().map(|sample| sample.comparison).collect();
    let (old, runts) = historic.borrow().comparisons(TTL);
    let speed_um_per_s = 1000.0 * machine.travel_mm_per_s();
    let differences: Vec<_> = synchronous
        .iter()
        .zip(decisions(&synchronous, &q))
        .zip(&old)
        .map(|((new, forward), old)| Difference::of(*new, forward, old, clock_hz))
        .collect();
    let mut certificate = summary(&differences, 1.0 / clock_hz, speed_um_per_s);
    certificate.runts = runts;
    certificate.mtbf_log10_years = mtbf_log10_years(FLIP_FLOP, clock_hz, fringe_hz(machine));
    Ok(certificate)
}

/// Fringes a second.
fn fringe_hz(machine: &Machine) -> f64 {
    1000.0 * machine.travel_mm_per_s() / machine.fringe_um()
}

/// Logarithm to base 10 of the mean time between failures, years: it overflows as a number.
#[must_use]
pub fn mtbf_log10_years(flip_flop: FlipFlop, clock_hz: f64, input_hz: f64) -> f64 {
    let settling_s = 1.0 / clock_hz - flip_flop.overhead_s;
    let seconds_a_year = 365.25 * 86_400.0;
    settling_s / flip_flop.tau_s * std::f64::consts::LOG10_E
        - libm::log10(flip_flop.window_s * clock_hz * input_hz * seconds_a_year)
}

/// Q of the synchronous device at the end of each comparison.
fn decisions(comparisons: &[Comparison], q: &Waveform) -> Vec<bool> {
    let mut changes = q.changes.iter().peekable();
    let mut level = false;
    let mut decisions = Vec::with_capacity(comparisons.len());
    for comparison in comparisons {
        while let Some(change) = changes.next_if(|change| change.clock <= comparison.end) {
            level = change.value == 1;
        }
        decisions.push(level);
    }
    decisions
}

/// Where the two devices differ in one comparison.
struct Difference {
    /// Of the meter's widths, s.
    width_s: f64,
    /// Distance of the laser's edge from the nearest coincidence, s.
    from_coincidence_s: f64,
    /// The decisions are not the same.
    decision: bool,
}

impl Difference {
    fn of(new: Comparison, forward: bool, old: &HistoricComparison, clock_hz: f64) -> Self {
        let period_s = time_of(new.end - new.begin, clock_hz);
        // Just below 360° and just above 0° are the same phase.
        let width_s = libm::remainder(time_of(new.high, clock_hz) - old.high_s, period_s).abs();
        let from_middle_s = old.behind_middle_s.map_or(0.0, f64::abs);
        let from_coincidence_s = from_middle_s.min((period_s / 2.0 - from_middle_s).abs());
        Self { width_s, from_coincidence_s, decision: forward != old.forward }
    }
}

fn summary(differences: &[Difference], bound_s: f64, speed_um_per_s: f64) -> Certificate {
    let largest = |chosen: &dyn Fn(&Difference) -> Option<f64>| {
        differences.iter().filter_map(chosen).fold(0.0, f64::max)
    };
    let largest_s = largest(&|one| Some(one.width_s));
    let squares: f64 = differences.iter().map(|one| one.width_s * one.width_s).sum();
    Certificate {
        comparisons: differences.len(),
        largest_s,
        largest_um: largest_s * speed_um_per_s,
        rms_s: (squares / number(differences.len())).sqrt(),
        bound_s,
        bound_um: bound_s * speed_um_per_s,
        other_decisions: differences.iter().filter(|one| one.decision).count(),
        other_decision_s: largest(&|one| one.decision.then_some(one.from_coincidence_s)),
        coincidences: differences.iter().filter(|one| one.from_coincidence_s < bound_s).count(),
        runts: 0,
        mtbf_log10_years: 0.0,
    }
}

#[expect(clippy::cast_precision_loss, reason = "a pass has some ten thousand comparisons")]
fn number(count: usize) -> f64 {
    count.max(1) as f64
}

/// The grinder, whose every instant the historic device sees too.
#[derive(Debug)]
struct Both {
    grinder: Grinder,
    historic: Rc<RefCell<HistoricDevice>>,
}

impl Process for Both {
    fn next_line_s(&mut self) -> f64 {
        self.grinder.next_line_s()
    }

    fn next_fringe_s(&mut self) -> f64 {
        self.grinder.next_fringe_s()
    }

    fn pass_line(&mut self) {
        let time_s = self.grinder.next_line_s();
        self.historic.borrow_mut().line(time_s);
        self.grinder.pass_line();
    }

    fn pass_fringe(&mut self) {
        let time_s = self.grinder.next_fringe_s();
        self.historic.borrow_mut().fringe(time_s);
        self.grinder.pass_fringe();
    }

    fn step(&mut self, time_s: f64, forward: bool) {
        self.grinder.step(time_s, forward);
    }

    fn place(&mut self, time_s: f64) -> Place {
        self.grinder.place(time_s)
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    fn machine(a: u32, b: u32, range: u32, m: u32, compensation: &str) -> Machine {
        let text = format!(
            "[workpiece]\nlead = \"6 mm\"\nlength = \"8 mm\"\n[spindle]\nspeed = \"60 rpm\"\n\
             [grating]\nlines = 13906\ndiameter = \"200 mm\"\n\
             [laser]\nwavelength = \"0.63281983 um\"\n\
             [dividers]\na = {a}\nb = {b}\nrange = {range}\ninitial_phase = {m}\n\
             compensation = \"{compensation}\"\n\
             [drive]\nstep = \"0.0125 um\"\nfrequency = \"160 Hz\"\n"
        );
        Machine::parse(&text, Path::new("machine.toml")).unwrap()
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
            assert!(80 < certificate.comparisons, "{certificate:?}");
            assert!(certificate.holds(), "A = {a}, B = {b}: {certificate:?}");
            assert!(0.3 * certificate.bound_s < certificate.largest_s, "the bound is not idle");
        }
    }

    /// By hand: 81.3 ns of settling over 0.2 ns is e^406 = 10^176.
    #[test]
    fn a_whole_clock_of_settling_is_plenty() {
        let flip_flop = FlipFlop { tau_s: 0.2e-9, window_s: 0.2e-9, overhead_s: 2e-9 };
        let log10 = mtbf_log10_years(flip_flop, 12e6, 4740.0);
        let exponent = (1e3 / 12.0 - 2.0) / 0.2 * std::f64::consts::LOG10_E;
        let rate_a_year = 0.2e-9 * 12e6 * 4740.0 * 31_557_600.0;
        assert!((log10 - (exponent - libm::log10(rate_a_year))).abs() < 1e-6, "{log10}");
    }
}
