//! Loop closed: each device drives a machine of its own, and the two tables are compared.
//!
//! # The bound
//!
//! Let d be by how many steps the one table is ahead of the other, and S the most ticks of the step
//! clock in one comparison.
//!
//! - Decisions that are alike leave d as it is, but for a tick that falls between the two: the
//!   synchronous device decides a few clocks later, and one motor may already step the other way
//!   while the other does not, 2 steps.
//! - Decisions can differ only when half a period lies between the two phases: the table behind is
//!   told forward, the other reverse. They move towards each other, 2 steps a tick, so that after
//!   one comparison d is at most 2 S the other way.
//!
//! ```text
//! |d| ≤ 2·S + 2 steps        S = ⌈f_step / f_φ⌉ + 1
//! ```
//!
//! It holds while the loop is locked: when the error has left the range of the meter, a phase
//! beyond 360° says the opposite, and the tables may part. Where both tables stood alike before and
//! after a comparison, the widths differ by less than a clock, as with the loop open.

use std::cell::RefCell;
use std::rc::Rc;

use helixlock_plant::{EffectError, Model};
use helixlock_rtl::settings::Settings;

use crate::Error;
use crate::closed_loop::{
    ClosedLoop, Course, Grinder, Place, Probe, Process, clock_of, measuring, reset, signals_of,
};
use crate::device::{device_engine, set_wheels};
use crate::engine::Engine;
use crate::historic::{HistoricComparison, HistoricLoop, TTL, Ticks};

use super::GATE_CLOCKS;
use super::open::Difference;
use super::seen::{SEEN, Seen, seen};

/// What two devices made of two machines alike.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BothClosed {
    /// Comparisons compared.
    pub comparisons: usize,
    /// Steps that the synchronous device took, either way.
    pub steps_taken: usize,
    /// Largest difference between the tables at the end of a comparison, steps.
    pub largest_steps: u64,
    /// The same, µm.
    pub largest_um: f64,
    /// Most steps they may differ by.
    pub bound_steps: u64,
    /// The same, µm.
    pub bound_um: f64,
    /// Comparisons before and after which both tables stood alike and went the same way, and the
    /// laser's edge was not at the ends of the period.
    pub alike: usize,
    /// Largest difference of the meter's width among those, s.
    pub alike_largest_s: f64,
    /// Largest difference of the meter's width in any comparison, s.
    pub largest_s: f64,
}

/// Runs both, the synchronous device first: it says in which phase the step clock is.
///
/// `progress` is told how many clocks are done.
pub(super) fn run_closed(
    model: &Model,
    course: &Course,
    progress: &mut dyn FnMut(u64),
) -> Result<BothClosed, Error> {
    let clock_hz = course.clock_hz();
    let new = run_synchronous(model, course, progress)?;
    let settings = course.dialled.settings;
    let ticks = new.ticks(&settings, clock_hz);
    let grinder = Grinder::new(model, course.length_mm)?;
    let gate_s = GATE_CLOCKS / clock_hz;
    let old = HistoricLoop::new(settings, gate_s, ticks, grinder).run(course.duration_s)?;
    Ok(compared(model, course, &new, &old, 1.0 / clock_hz + TTL.flip_flop_s))
}

/// What the two did; `ends_s` is how near to the ends the old one swallows pulses.
pub(super) fn compared(
    model: &Model,
    course: &Course,
    new: &Synchronous,
    old: &[(HistoricComparison, i64)],
    ends_s: f64,
) -> BothClosed {
    let comparisons: Vec<_> = new.with_steps().zip(old.iter().copied()).collect();
    let ticks_a_comparison = ceil(course.dialled.step_frequency_hz / course.comparison_hz) + 1;
    let bound_steps = 2 * ticks_a_comparison + 2;
    let summary = summary(&comparisons, course.clock_hz(), ends_s);
    BothClosed {
        steps_taken: new.steps.len(),
        largest_um: model.drive.step_um * steps_as_number(summary.largest_steps),
        bound_steps,
        bound_um: model.drive.step_um * steps_as_number(bound_steps),
        ..summary
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "ticks in a comparison, positive and few"
)]
fn ceil(number: f64) -> u64 {
    libm::ceil(number) as u64
}

#[expect(clippy::cast_precision_loss, reason = "steps of a pass")]
fn steps_as_number(steps: u64) -> f64 {
    steps as f64
}

/// What the synchronous device did.
pub(super) struct Synchronous {
    comparisons: Vec<Seen>,
    /// Clock of each step, and whether it was forward.
    steps: Vec<(u64, bool)>,
}

impl Synchronous {
    /// The step clock: it has ticked at the first step.
    pub(super) fn ticks(&self, settings: &Settings, clock_hz: f64) -> Ticks {
        let period = u64::from(settings.step_period);
        let first_step = self.steps.first().map_or(0, |step| step.0);
        Ticks { next: first_step % period, period, clock_hz }
    }

    /// Each comparison with the net steps at its end.
    fn with_steps(&self) -> impl Iterator<Item = (Seen, i64)> {
        let mut steps = self.steps.iter().peekable();
        let mut net = 0;
        self.comparisons.iter().map(move |comparison| {
            while let Some((_, forward)) = steps.next_if(|(clock, _)| *clock <= comparison.end) {
                net += if *forward { 1 } else { -1 };
            }
            (*comparison, net)
        })
    }
}

pub(super) fn run_synchronous(
    model: &Model,
    course: &Course,
    progress: &mut dyn FnMut(u64),
) -> Result<Synchronous, Error> {
    let clock_hz = course.clock_hz();
    let steps = Rc::new(RefCell::new(Vec::new()));
    let grinder = Grinder::new(model, course.length_mm)?;
    let noted = Noted { grinder, steps: Rc::clone(&steps), clock_hz };
    let mut engine = device_engine();
    set_wheels(&mut engine, &course.dialled.settings)?;
    let mut device = ClosedLoop::new(engine, noted, clock_hz, course.full_scale_um)?;
    let end = clock_of(course.duration_s, clock_hz);
    let pins = device.pins();
    let signals = signals_of(device.engine().netlist(), &SEEN.map(str::to_owned))?;
    reset(&mut device)?;
    device.begin_recording(Probe { signals, window: 0..end });
    device.set_moving()?;
    device.run_until(end, |engine| measuring(engine, pins))?;
    device.engine().set_input(pins.correct, 1);
    let mut clock = device.engine().clock();
    while clock < end {
        clock = (clock + end.div_ceil(100)).min(end);
        device.run_until(clock, |_| false)?;
        progress(clock);
    }
    let waveform = device.end_recording().unwrap_or_default();
    Ok(Synchronous { comparisons: seen(&device.samples, &waveform), steps: steps.take() })
}

/// Comparisons of either device, with the net steps at their ends.
type Pair = ((Seen, i64), (HistoricComparison, i64));

fn summary(comparisons: &[Pair], clock_hz: f64, ends_s: f64) -> BothClosed {
    let mut summary = BothClosed { comparisons: comparisons.len(), ..BothClosed::default() };
    let mut stood_alike = true;
    for ((new, new_steps), (old, old_steps)) in comparisons {
        let Difference { width_s, at_ends, .. } = Difference::of(*new, old, clock_hz, ends_s);
        let stand_alike = new_steps == old_steps && new.forward == old.forward;
        if stood_alike && stand_alike && !at_ends {
            summary.alike += 1;
            summary.alike_largest_s = summary.alike_largest_s.max(width_s);
        }
        stood_alike = stand_alike;
        summary.largest_s = summary.largest_s.max(width_s);
        summary.largest_steps = summary.largest_steps.max(new_steps.abs_diff(*old_steps));
    }
    summary
}

/// A grinder whose steps are noted.
#[derive(Debug)]
struct Noted {
    grinder: Grinder,
    steps: Rc<RefCell<Vec<(u64, bool)>>>,
    clock_hz: f64,
}

impl Process for Noted {
    fn next_line_s(&mut self) -> f64 {
        self.grinder.next_line_s()
    }

    fn next_fringe_s(&mut self) -> f64 {
        self.grinder.next_fringe_s()
    }

    fn pass_line(&mut self) {
        self.grinder.pass_line();
    }

    fn pass_fringe(&mut self) {
        self.grinder.pass_fringe();
    }

    fn step(&mut self, time_s: f64, forward: bool) {
        // Half a clock, for the rounding of the instant of an edge.
        let clock = clock_of(time_s + 0.5 / self.clock_hz, self.clock_hz);
        self.steps.borrow_mut().push((clock, forward));
        self.grinder.step(time_s, forward);
    }

    fn place(&mut self, time_s: f64) -> Place {
        self.grinder.place(time_s)
    }

    fn failure(&self) -> Option<EffectError> {
        self.grinder.failure()
    }
}
