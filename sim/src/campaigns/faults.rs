//! What a flipped flip-flop does to the pass: every one, at several instants.
//!
//! A particle or a spike flips one flip-flop of the running device. Two things are asked:
//!
//! - *the logic*: given the same pins, when are all flip-flops again as if nothing had happened? All
//!   flip-flops are flipped at once, one a [lane](crate::Lanes), beside a lane that is left alone.
//! - *the machine*: in closed loop, how far is the table moved off the course it would have taken, for
//!   how long, and do counter, windings and table still agree, so that a playback would find home?
//!
//! Courses are compared as means over one hunting cycle: the hunting itself has no fixed phase. A
//! table within one swing of its course counts as back on it.

mod ring;
mod tap;

use helixlock_netlist::Signal;
use helixlock_plant::Model;

use super::parallel::parallel;
use crate::Error;
use crate::closed_loop::{
    ClosedLoop, Course, Grinder, Options, clock_of, measuring, ready, reset, time_of,
};
use crate::device::{DeviceEngine, device, device_lanes, find};
use crate::engine::{Engine, LANES, Snapshot};
use tap::{InputChange, Tapped};

/// Comparisons after which the loop has pulled to zero.
const PULL_IN: f64 = 20.0;

/// Comparisons for which the machine is looked at after a flip.
const WINDOW: u32 = 24;

/// Comparisons from instant to instant: the golden ratio, so that every phase of the hunting and of
/// the meter is met.
const STRIDE: f64 = 1.618_033_988_749_895;

/// Looks at the table in one comparison.
const LOOKS: u32 = 2;

/// Looks in one hunting cycle, which lasts two comparisons.
const CYCLE: usize = 2 * LOOKS as usize;

/// Clocks for which the logic is looked at after a flip.
pub const LOGIC_CLOCKS: u64 = 20_000;

/// One flip and what came of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// Place of the flip-flop among the [names](flip_flops) of all.
    pub flip_flop: usize,
    /// When it was flipped, s since power-up.
    pub time_s: f64,
    /// Clocks until all flip-flops were as if nothing had happened, given the same pins; `None`
    /// when they were not within [`LOGIC_CLOCKS`].
    pub healed_clocks: Option<u64>,
    /// Furthest the table was off its course, µm.
    pub worst_um: f64,
    /// How far it was off in the mean at the end, µm.
    pub left_um: f64,
    /// Time until it stayed within one swing of its course, s; `None` when it did not.
    pub recovery_s: Option<f64>,
    /// Steps by which counter and table disagree at the end.
    pub home_error: i64,
    /// Steps by which windings and table disagree at the end.
    pub ring_slip: i64,
    /// Clocks for which the flip left the windings in a state outside the ring, before the ring
    /// cleared itself; 0 when they stayed in it.
    pub ring_illegal_clocks: u64,
    /// The fault output came on.
    pub fault_shown: bool,
    /// All of it in a word.
    pub verdict: Verdict,
}

/// What a flip amounts to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// The table stays on its course, and everything agrees.
    Unseen,
    /// The table leaves its course and comes back by itself.
    Recovers,
    /// The table is on its course, but a playback would miss home.
    HomeLost,
    /// The table is off its course for good: the thread has a step in it.
    Stays,
}

/// Every flip-flop at some instants of a closed-loop pass: flips that do not know of each other, by
/// instant, then by flip-flop.
#[derive(Debug)]
pub struct Flips<'a> {
    bench: Bench<'a>,
    clocks: Vec<u64>,
}

impl<'a> Flips<'a> {
    /// All flip-flops at `instants` instants.
    ///
    /// # Errors
    ///
    /// [`Error`] when the machine cannot be simulated.
    pub fn new(model: &'a Model, instants: u32) -> Result<Self, Error> {
        let bench = Bench::new(model)?;
        let clocks = bench.instants(instants)?;
        Ok(Self { bench, clocks })
    }

    /// How long each flip is followed in closed loop, s.
    #[must_use]
    pub fn window_s(&self) -> f64 {
        f64::from(WINDOW) / self.bench.course.comparison_hz
    }

    /// Within this the table is on its course, µm.
    #[must_use]
    pub fn band_um(&self) -> f64 {
        self.bench.course.swing_um
    }

    /// Tries the flips of these numbers, in rising order, on all cores.
    ///
    /// `keep` is given each with its number, from any thread, in any order.
    ///
    /// # Errors
    ///
    /// [`Error`] when the machine cannot be simulated; and what `keep` fails with.
    pub fn try_each<E: From<Error> + Send>(
        &self,
        flips: &[u64],
        keep: &(impl Fn(u64, Outcome) -> Result<(), E> + Sync),
    ) -> Result<(), E> {
        let flip_flops = flip_flops().len();
        for (clock, first) in self.clocks.iter().zip((0..).step_by(flip_flops)) {
            let here = first..first + flip_flops as u64;
            if !flips.iter().any(|flip| here.contains(flip)) {
                continue;
            }
            let undisturbed = self.bench.undisturbed(*clock)?;
            let all = here.zip(healed(&undisturbed).into_iter().enumerate());
            let wanted: Vec<(u64, (usize, Option<u64>))> =
                all.filter(|(flip, _)| flips.binary_search(flip).is_ok()).collect();
            parallel(&wanted, |(flip, (flip_flop, healed_clocks))| {
                keep(*flip, self.bench.flip(&undisturbed, *flip_flop, *healed_clocks)?)
            })?;
        }
        Ok(())
    }
}

/// Names of the flip-flops of the device, register and bit, such as `ring.a_q[0]`.
#[must_use]
pub fn flip_flops() -> Vec<String> {
    let netlist = device().netlist();
    let registers = netlist.registers.iter().map(|register| netlist.signal(register.output));
    let bits = |signal: &Signal| {
        let path = signal.path.clone();
        (0..signal.width).map(move |bit| format!("{path}[{bit}]"))
    };
    registers.flat_map(bits).collect()
}

/// The machine on which flips are tried.
#[derive(Debug)]
struct Bench<'a> {
    model: &'a Model,
    course: Course,
}

/// Where the machine went.
#[derive(Clone, Debug)]
struct Track {
    /// Lead error in the mean over a hunting cycle, µm, from the flip on.
    mean_um: Vec<f64>,
    steps: i64,
    counted: i64,
    /// Place of the windings in their cycle of six.
    ring: i64,
    fault: bool,
}

/// A pass that nothing disturbs, from one instant on.
struct Undisturbed {
    moment: Snapshot,
    changes: Vec<InputChange>,
    track: Track,
}

impl<'a> Bench<'a> {
    fn new(model: &'a Model) -> Result<Self, Error> {
        Ok(Self { model, course: Course::new(model, &Options::default())? })
    }

    fn time_s(&self, clock: u64) -> f64 {
        time_of(clock, self.course.clock_hz())
    }

    fn clocks(&self, comparisons: f64) -> u64 {
        clock_of(comparisons / self.course.comparison_hz, self.course.clock_hz())
    }

    /// Clocks of the flips: after the pull to zero, spread over phases.
    fn instants(&self, count: u32) -> Result<Vec<u64>, Error> {
        let mut device = self.correcting()?;
        let begin = device.engine().clock();
        let at = |index| begin + self.clocks(PULL_IN + STRIDE * f64::from(index));
        Ok((0..count).map(at).collect())
    }

    /// A device that has just begun to correct.
    fn correcting(&self) -> Result<ClosedLoop<Tapped<DeviceEngine>, Grinder>, Error> {
        let course = &self.course;
        let grinder = Grinder::new(self.model, course.length_mm)?;
        let engine = Tapped::new(ready(course)?);
        let clock_hz = course.clock_hz();
        let mut device = ClosedLoop::new(engine, grinder, clock_hz, course.full_scale_um)?;
        let pins = device.pins();
        reset(&mut device)?;
        device.set_moving()?;
        let end = clock_of(course.duration_s, clock_hz);
        device.run_until(end, |engine| measuring(engine, pins))?;
        device.engine().set_input(pins.correct, 1);
        Ok(device)
    }

    fn undisturbed(&self, clock: u64) -> Result<Undisturbed, Error> {
        let mut device = self.correcting()?;
        device.run_until(clock, |_| false)?;
        device.engine().changes.clear();
        let moment = device.engine().snapshot();
        let track = self.follow(&mut device)?;
        Ok(Undisturbed { moment, changes: std::mem::take(&mut device.engine().changes), track })
    }

    /// The pass again, with one flip-flop flipped.
    fn flip(
        &self,
        undisturbed: &Undisturbed,
        flip_flop: usize,
        healed_clocks: Option<u64>,
    ) -> Result<Outcome, Error> {
        let mut device = self.correcting()?;
        device.run_until(undisturbed.moment.clock, |_| false)?;
        let mut moment = device.engine().snapshot();
        let bit = !moment.flip_flops[flip_flop];
        moment.flip_flops.set(flip_flop, bit);
        device.engine().restore(&moment);
        let ring_illegal_clocks = ring::illegal_clocks(&moment)?;
        let track = self.follow(&mut device)?;
        let look_s = 1.0 / (self.course.comparison_hz * f64::from(LOOKS));
        let deviation = Deviation::of(&undisturbed.track, &track, self.course.swing_um);
        let (home_error, ring_slip) = disagreement(&undisturbed.track, &track);
        Ok(Outcome {
            flip_flop,
            time_s: self.time_s(undisturbed.moment.clock),
            healed_clocks,
            worst_um: deviation.worst_um,
            left_um: deviation.left_um,
            recovery_s: deviation.looks.map(|looks| f64::from(looks) * look_s),
            home_error,
            ring_slip,
            ring_illegal_clocks,
            fault_shown: track.fault && !undisturbed.track.fault,
            verdict: deviation.verdict(home_error != 0 || ring_slip != 0),
        })
    }

    /// Follows the machine for the window.
    fn follow(
        &self,
        device: &mut ClosedLoop<Tapped<DeviceEngine>, Grinder>,
    ) -> Result<Track, Error> {
        let pins = device.pins();
        let begin = device.engine().clock();
        let mut looks_um = Vec::new();
        let mut fault = false;
        for look in 1..=WINDOW * LOOKS {
            let clock = begin + self.clocks(f64::from(look) / f64::from(LOOKS));
            device.run_until(clock, |_| false)?;
            looks_um.push(device.place().lead_error_um);
            fault |= device.engine().value(pins.fault) == 1;
        }
        let steps = device.steps;
        let engine = device.engine();
        Ok(Track {
            mean_um: looks_um.windows(CYCLE).map(mean).collect(),
            steps,
            counted: counted(engine)?,
            ring: ring::place(engine)?,
            fault,
        })
    }
}

/// How one course differs from another.
struct Deviation {
    worst_um: f64,
    left_um: f64,
    /// Looks until it stays within the band; `None` when it does not.
    looks: Option<u32>,
    seen: bool,
}

impl Deviation {
    fn of(one: &Track, other: &Track, band_um: f64) -> Self {
        let deviations = one.mean_um.iter().zip(&other.mean_um).map(|(one, other)| other - one);
        let deviations: Vec<f64> = deviations.collect();
        let outside = |deviation: &f64| band_um < deviation.abs();
        let looks = deviations.iter().rposition(outside).map_or(0, |last| last + 1);
        let last_cycle = deviations.len().saturating_sub(CYCLE);
        Self {
            worst_um: deviations.iter().fold(0.0, |worst, um| worst.max(um.abs())),
            left_um: mean(&deviations[last_cycle..]),
            looks: u32::try_from(looks).ok().filter(|_| looks <= last_cycle),
            seen: 0 < looks,
        }
    }

    fn verdict(&self, disagrees: bool) -> Verdict {
        match (self.looks, disagrees, self.seen) {
            (None, ..) => Verdict::Stays,
            (Some(_), true, _) => Verdict::HomeLost,
            (Some(_), false, true) => Verdict::Recovers,
            (Some(_), false, false) => Verdict::Unseen,
        }
    }
}

/// Steps that the counter and the windings are off the table, beyond what they were before.
fn disagreement(one: &Track, other: &Track) -> (i64, i64) {
    let home_error = (other.counted - other.steps) - (one.counted - one.steps);
    let slip = ((other.ring - other.steps) - (one.ring - one.steps)).rem_euclid(6);
    (home_error, if 3 < slip { slip - 6 } else { slip })
}

/// For every flip-flop the clocks until its flip is forgotten, all else being the same.
fn healed(undisturbed: &Undisturbed) -> Vec<Option<u64>> {
    let all: Vec<usize> = (0..undisturbed.moment.flip_flops.len()).collect();
    // Lane 0 is left alone.
    all.chunks(LANES - 1).flat_map(|flips| healed_together(undisturbed, flips)).collect()
}

fn healed_together(undisturbed: &Undisturbed, flips: &[usize]) -> Vec<Option<u64>> {
    let moment = &undisturbed.moment;
    let mut lanes = device_lanes();
    let inputs = lanes.netlist().inputs.clone();
    lanes.fill(&moment.flip_flops);
    for (input, value) in inputs.iter().zip(&moment.inputs) {
        lanes.set_input(*input, *value);
    }
    for (lane, flip_flop) in flips.iter().enumerate() {
        lanes.flip(lane + 1, *flip_flop);
    }
    let mut healed = vec![None; flips.len()];
    let mut changes = undisturbed.changes.iter().peekable();
    for clock in 0..LOGIC_CLOCKS {
        while let Some(change) = changes.next_if(|change| change.clock <= moment.clock + clock) {
            lanes.set_input(change.input, change.value);
        }
        lanes.step();
        let unlike = lanes.unlike(0);
        for (index, healed) in healed.iter_mut().enumerate() {
            let lane = index + 1;
            let alike = unlike[lane / 64] >> (lane % 64) & 1 == 0;
            // Once alike, always alike: the pins are the same.
            if alike && healed.is_none() {
                *healed = Some(clock + 1);
            }
        }
    }
    healed
}

fn counted(engine: &mut impl Engine) -> Result<i64, Error> {
    let [count, forward] = ["count", "count_forward"].map(|port| read(engine, port));
    let count = i64::try_from(count?).unwrap_or(i64::MAX);
    Ok(if forward? == 1 { count } else { -count })
}

fn read(engine: &mut impl Engine, port: &str) -> Result<u64, Error> {
    let signal = find(engine.netlist(), port)?;
    Ok(engine.value(signal))
}

#[expect(clippy::cast_precision_loss, reason = "a few hundred looks")]
fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}
