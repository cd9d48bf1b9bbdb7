//! The original whole, gate by gate, against the synchronous device: loop open, the same lines and
//! fringes for both, and loop closed, each on a machine of its own.
//!
//! # The bound
//!
//! Decades ripple, so a divided pulse comes up to twelve flip-flops and four gates behind the pulse
//! that it counts, and the two channels need not be alike: at the limits of the data sheets
//! 12 · 40 ns + 4 · 22 ns = 568 ns on top of the clock of the synchroniser. Where both divided pulses
//! overlap, the meter of gates goes by the end of one: the delay of figure 7, 0.6 µs at most.

use helixlock_original::device::{Wheels, circuit};
use helixlock_original::figures::compensator::Correction;
use helixlock_original::{Check, Circuit, Corner, Delays, Edge, Simulator};
use helixlock_plant::Model;
use helixlock_rtl::settings::{Range, Settings};
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};

use super::closed::{self, BothClosed, Synchronous};
use super::open::{self, Difference, OpenLoop};
use super::seen::Seen;
use crate::Error;
use crate::closed_loop::{Course, Grinder, Options, Process, reading_um, unwrap_um};
use crate::historic::{GateLoop, GateRun, HistoricComparison};

/// By how much the ways through the dividers may differ, s.
const RIPPLE_S: f64 = 568e-9;
/// Longest divided pulse, s.
const PULSE_S: f64 = 0.6e-6;

/// What the gates of the whole original made of a pass.
#[derive(Clone, Debug, PartialEq)]
pub struct WholeGates {
    /// Gates, flip-flops and delay networks.
    pub parts: usize,
    /// Changes of their outputs, both runs together.
    pub events: u64,
    /// Loop open.
    pub open: OpenLoop,
    /// Loop closed.
    pub closed: BothClosed,
    /// A clock and the ripple, s: no difference of widths may reach it.
    pub bound_s: f64,
    /// The same where both divided pulses overlap, s.
    pub bound_at_ends_s: f64,
    /// Pulses shorter, or data less at rest, than a data sheet allows.
    pub violations: u64,
    /// Pulses that a gate swallowed.
    pub swallowed: u64,
    /// By how much the reset counter is off what the motor did, steps.
    pub miscounted: u64,
    /// What a recorder at the gates' meter draws, loop open.
    pub drawn: Drawn,
}

/// One point a comparison, at its middle.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// Since the start of the pass.
    pub time_s: Vec<f64>,
    /// Nominal travel.
    pub position_mm: Vec<f64>,
    /// Laser lag positive; drawn on past the edge of the range.
    pub error_um: Vec<f64>,
}

impl Drawn {
    /// What is drawn of a run on a machine.
    fn of(run: &GateRun, mut machine: impl Process, full_scale_um: f64) -> Self {
        let ended: Vec<_> = run.comparisons.iter().map(|(comparison, _)| comparison).collect();
        let middle_s = |one: &&HistoricComparison| one.ended_s - 0.5 * one.period_s;
        let time_s: Vec<f64> = ended.iter().map(middle_s).collect();
        let position_mm = time_s.iter().map(|time_s| machine.place(*time_s).position_mm).collect();
        let error_um =
            |one: &&HistoricComparison| reading_um(one.high_s / one.period_s, full_scale_um);
        let mut error_um: Vec<f64> = ended.iter().map(error_um).collect();
        unwrap_um(&mut error_um, full_scale_um);
        Self { time_s, position_mm, error_um }
    }
}

impl WholeGates {
    /// True when every difference is below its bound. What the reset counter lost is the original's
    /// own fault and no difference: see the hazards.
    #[must_use]
    pub fn holds(&self) -> bool {
        let Self { open, closed, .. } = self;
        open.largest_s < self.bound_s
            && open.largest_at_ends_s < self.bound_at_ends_s
            && open.other_decision_s < self.bound_s
            && closed.alike_largest_s < self.bound_s
            && closed.largest_steps <= closed.bound_steps
    }
}

/// Delays of one original.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DelaySet {
    /// All parts alike.
    Corner(Corner),
    /// Each edge of each part between the limits of the data sheets, by a seed.
    Drawn(u64),
}

impl DelaySet {
    fn of(self, circuit: &Circuit) -> Delays {
        match self {
            Self::Corner(corner) => Delays::corner(circuit, corner),
            Self::Drawn(seed) => Delays::drawn(circuit, seed),
        }
    }
}

/// Runs a pass through both, with each set of delays.
///
/// # Errors
///
/// [`Error`] when the device cannot serve the machine, or its range is not the one of the gates.
pub fn certify_gates(
    model: &Model,
    length_mm: Option<f64>,
    sets: &[DelaySet],
) -> Result<Vec<WholeGates>, Error> {
    let course = Course::new(model, &Options { length_mm })?;
    let settings = course.dialled.settings;
    let circuit = circuit(&wheels(&settings)?);
    let grinder = Grinder::new(model, course.length_mm)?;
    let (clock_hz, duration_s) = (course.clock_hz(), course.duration_s);
    let open = open::run_synchronous(&settings, grinder, clock_hz, duration_s, &mut |_| {})?;
    let closed = closed::run_synchronous(model, &course, &mut |_| {})?;
    let synchronous = Reference { model, course, settings, open, closed };
    sets.par_iter().map(|set| synchronous.against(&circuit, &set.of(&circuit))).collect()
}

/// Every wire of the whole original over a pass.
#[derive(Clone, Debug)]
pub struct GateWaves {
    /// What is joined to what.
    pub circuit: Circuit,
    /// Levels at power-up, in the order of its wires.
    pub initial: Vec<bool>,
    /// All edges since, in the order of time.
    pub edges: Vec<Edge>,
}

/// Runs a pass with the loop closed and keeps every edge, some sixty thousand a millimetre.
///
/// # Errors
///
/// As [`certify_gates`].
pub fn gate_waves(
    model: &Model,
    length_mm: Option<f64>,
    set: DelaySet,
) -> Result<GateWaves, Error> {
    let course = Course::new(model, &Options { length_mm })?;
    let settings = course.dialled.settings;
    let circuit = circuit(&wheels(&settings)?);
    let delays = set.of(&circuit);
    let initial = Simulator::new(&circuit, &delays)?.levels().to_vec();
    let synchronous = closed::run_synchronous(model, &course, &mut |_| {})?;
    let ticks = Some(synchronous.ticks(&settings, course.clock_hz()));
    let grinder = Grinder::new(model, course.length_mm)?;
    let gates = GateLoop::new(&circuit, &delays, ticks, grinder)?.recorded();
    let edges = gates.run(course.duration_s)?.edges;
    Ok(GateWaves { circuit, initial, edges })
}

/// What the synchronous device made of the pass.
struct Reference<'a> {
    model: &'a Model,
    course: Course,
    settings: Settings,
    open: Vec<Seen>,
    closed: Synchronous,
}

impl Reference<'_> {
    /// The original of these delays beside it.
    fn against(&self, circuit: &Circuit, delays: &Delays) -> Result<WholeGates, Error> {
        let Self { model, course, .. } = self;
        let clock_hz = course.clock_hz();
        let grinder = || Grinder::new(model, course.length_mm);
        let ends_s = 1.0 / clock_hz + RIPPLE_S + PULSE_S;

        let first = GateLoop::new(circuit, delays, None, grinder()?)?.run(course.duration_s)?;
        let pairs = self.open.iter().zip(&first.comparisons);
        let differences: Vec<_> =
            pairs.map(|(new, (old, _))| Difference::of(*new, old, clock_hz, ends_s)).collect();
        let open = open::summary(&differences, 1.0 / clock_hz);

        let ticks = Some(self.closed.ticks(&self.settings, clock_hz));
        let second = GateLoop::new(circuit, delays, ticks, grinder()?)?.run(course.duration_s)?;
        let closed = closed::compared(model, course, &self.closed, &second.comparisons, ends_s);
        if open.comparisons == 0 || closed.comparisons == 0 {
            return Err(Error::NoComparison { length_mm: course.length_mm });
        }
        let [violations, swallowed] = found(&[&first, &second]);
        Ok(WholeGates {
            parts: circuit.elements.len(),
            events: first.events + second.events,
            open,
            closed,
            bound_s: 1.0 / clock_hz + RIPPLE_S,
            bound_at_ends_s: ends_s,
            violations,
            swallowed,
            drawn: Drawn::of(&first, grinder()?, course.full_scale_um),
            miscounted: (second.steps.abs() % 4096).abs_diff(second.counted),
        })
    }
}

fn wheels(settings: &Settings) -> Result<Wheels, Error> {
    if settings.range != Range::X2 {
        return Err(Error::NoGates);
    }
    // The settings are within the wheels' three and four digits.
    let wheel = |number: u32| u16::try_from(number).unwrap_or(u16::MAX);
    let way = if settings.insert { Correction::Insert } else { Correction::Block };
    let thousands = settings.compensation_f / 1000;
    Ok(Wheels {
        a: wheel(settings.a),
        b: wheel(settings.b),
        initial_phase: wheel(settings.initial_phase),
        compensation: (0 < thousands).then(|| (wheel(thousands), way)),
    })
}

/// What data sheets do not allow, and what gates swallowed.
fn found(runs: &[&GateRun]) -> [u64; 2] {
    let findings = || runs.iter().flat_map(|run| &run.findings);
    let count = |swallowed: bool| {
        let chosen = findings().filter(|one| (one.check == Check::Swallowed) == swallowed);
        chosen.map(|one| one.count).sum()
    };
    [count(false), count(true)]
}
