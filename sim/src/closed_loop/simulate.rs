//! A machine file in, two passes out: without and with the correction.

use std::sync::atomic::{AtomicU64, Ordering};

use helixlock_plant::motion::LeftOut;
use helixlock_plant::{LowPass, Machine, Model};

use super::grinder::Grinder;
use super::pass::{Pass, PassPlan, Trace, run_pass};
use super::pins::clock_of;
use super::probe::{Probe, Watch, signals_of};
use crate::Error;
use crate::device::{
    DeviceEngine, Dialled, device, device_engine, dividers_fit, set_wheels, settings_for,
};

/// Comparisons that the waveform shows unless told otherwise, after the initial phase selection.
const COMPARISONS_SHOWN: f64 = 5.0;

/// Steps the counter can hold; playing back takes no longer than these.
const MOST_STEPS: f64 = 4096.0;

/// What to simulate beyond what the machine file says.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Only this much of the workpiece, from its beginning, mm.
    pub length_mm: Option<f64>,
}

/// What a waveform shows.
#[derive(Clone, Debug, Default)]
pub struct View {
    /// Scopes, as [`signals_of`] takes them.
    pub scopes: Vec<String>,
    /// Begin of the window, s; by default the beginning of the pass.
    pub from_s: Option<f64>,
    /// Its end, s; by default five comparisons later.
    pub to_s: Option<f64>,
}

/// What is fixed before the first clock.
#[derive(Clone, Copy, Debug)]
pub struct Course {
    /// Settings of the device.
    pub dialled: Dialled,
    /// FPGA clock, Hz.
    pub clock_hz: u64,
    /// Length ground, mm.
    pub length_mm: f64,
    /// How long a pass takes, s.
    pub duration_s: f64,
    /// Table travel of one turn of phase, µm.
    pub full_scale_um: f64,
    /// Comparisons a second, nominal.
    pub comparison_hz: f64,
    /// What the motor moves in one comparison, µm.
    pub swing_um: f64,
    /// The fastest error the motor follows, µm/s.
    pub slew_limit_um_per_s: f64,
    /// Travel in one turn of the machine's screw, mm.
    pub turn_mm: f64,
}

/// Both passes.
#[derive(Clone, Debug)]
pub struct Simulation {
    /// What was fixed before.
    pub course: Course,
    /// Loop open.
    pub open: Pass,
    /// Loop closed, played back at the end.
    pub closed: Pass,
    /// Effects that did nothing because the machine file does not say what drives them.
    pub left_out: Vec<LeftOut>,
}

impl Course {
    /// Works out a run of `machine`.
    ///
    /// # Errors
    ///
    /// [`Error`] when the device cannot serve the machine.
    pub fn new(machine: &Machine, options: &Options) -> Result<Self, Error> {
        let dialled = settings_for(machine)?;
        dividers_fit(machine)?;
        let length_mm = match options.length_mm {
            Some(asked) => asked.min(machine.workpiece.length_mm),
            None => machine.workpiece.length_mm,
        };
        let slew_limit_um_per_s = dialled.step_frequency_hz * machine.drive.step_um;
        Ok(Self {
            dialled,
            clock_hz: whole_hz(machine.fpga.clock_hz),
            length_mm,
            duration_s: length_mm / machine.travel_mm_per_s(),
            full_scale_um: machine.full_scale_um(),
            comparison_hz: machine.comparison_hz(),
            swing_um: slew_limit_um_per_s / machine.comparison_hz(),
            slew_limit_um_per_s,
            turn_mm: machine.lead_screw.unwrap_or(machine.workpiece.lead).mm(),
        })
    }

    /// Clocks of both passes, without the playback.
    #[must_use]
    pub fn clocks(&self) -> u64 {
        2 * clock_of(self.duration_s, self.clock_hz())
    }

    /// FPGA clock, Hz, as a number to multiply by.
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "clocks are far below 2⁵³ Hz")]
    pub fn clock_hz(&self) -> f64 {
        self.clock_hz as f64
    }

    fn plan(&self, machine: &Machine, correct: bool) -> PassPlan {
        let playback_s = MOST_STEPS / self.dialled.step_frequency_hz;
        PassPlan {
            clock_hz: self.clock_hz(),
            end_s: self.duration_s,
            full_scale_um: self.full_scale_um,
            cutoff_hz: machine.filter_cutoff_hz,
            correct,
            playback_s: correct.then_some(playback_s),
        }
    }

    /// The signals and clocks that a view means.
    ///
    /// # Errors
    ///
    /// [`Error::NoScope`], or [`Error::Window`] when it shows nothing of the run.
    pub fn probe(&self, machine: &Machine, view: &View) -> Result<Probe, Error> {
        let selecting_s = f64::from(machine.dividers.initial_phase) * machine.fringe_um()
            / (1000.0 * machine.travel_mm_per_s());
        let from_s = view.from_s.unwrap_or(0.0);
        let shown_s = COMPARISONS_SHOWN / self.comparison_hz;
        let selecting_s = if view.from_s.is_some() { 0.0 } else { selecting_s };
        let to_s = view.to_s.unwrap_or(from_s + selecting_s + shown_s).min(self.duration_s);
        if !(0.0 <= from_s && from_s < to_s) {
            return Err(Error::Window { from_s, to_s, end_s: self.duration_s });
        }
        // The nearest clock: half a clock more, rounded down.
        let nearest = |time_s: f64| clock_of(time_s + 0.5 / self.clock_hz(), self.clock_hz());
        let window = nearest(from_s)..nearest(to_s);
        Ok(Probe { signals: signals_of(device().netlist(), &view.scopes)?, window })
    }
}

/// Grinds the workpiece twice, without and with the correction, clock by clock.
///
/// `progress` is told how many of [`Course::clocks`] are done.
///
/// # Errors
///
/// [`Error`] when the device cannot serve the machine, or lines and fringes come too fast for it.
pub fn simulate(
    model: &Model,
    options: &Options,
    progress: &mut dyn FnMut(u64),
) -> Result<Simulation, Error> {
    simulate_watched(model, options, None, progress)
}

/// The same; `watch` is told the waveform of the closed loop.
///
/// # Errors
///
/// As [`simulate`], or what `watch` answers.
pub fn simulate_watched(
    model: &Model,
    options: &Options,
    watch: Option<Watch<'_>>,
    progress: &mut dyn FnMut(u64),
) -> Result<Simulation, Error> {
    let course = Course::new(model, options)?;
    let left_out = Grinder::new(model, course.length_mm)?.left_out().to_vec();
    let pass = |correct: bool, watch: Option<Watch<'_>>, progress: &mut dyn FnMut(u64)| {
        let grinder = Grinder::new(model, course.length_mm)?;
        run_pass(ready(&course)?, grinder, course.plan(model, correct), watch, progress)
    };
    // Neither pass knows of the other: they run side by side.
    let beside = AtomicU64::new(0);
    let mut open = Err(Error::NoComparison { length_mm: course.length_mm });
    let closed = rayon::in_place_scope(|scope| {
        let (open, beside, pass) = (&mut open, &beside, &pass);
        scope.spawn(move |_| {
            *open = pass(false, None, &mut |now| beside.store(now, Ordering::Relaxed));
        });
        pass(true, watch, &mut |now| progress(now + beside.load(Ordering::Relaxed)))
    });
    let (mut open, mut closed) = (open?, closed?);
    if open.trace.time_s.is_empty() || closed.trace.time_s.is_empty() {
        return Err(Error::NoComparison { length_mm: course.length_mm });
    }
    lag_recorder(model, &mut open.trace);
    lag_recorder(model, &mut closed.trace);
    Ok(Simulation { course, open, closed, left_out })
}

/// Puts the recorder's own lags behind its filter; the loop does not go through them.
fn lag_recorder(model: &Model, trace: &mut Trace) {
    for lag_s in model.recorder_lags_s() {
        let lag = LowPass::new(lag_s);
        trace.filtered_error_um = lag.pass(&trace.time_s, &trace.filtered_error_um);
    }
}

/// A device at power-up with its wheels set.
pub(crate) fn ready(course: &Course) -> Result<DeviceEngine, Error> {
    let mut engine = device_engine();
    set_wheels(&mut engine, &course.dialled.settings)?;
    Ok(engine)
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the machine file holds clocks between 1 Hz and some GHz"
)]
fn whole_hz(clock_hz: f64) -> u64 {
    libm::round(clock_hz) as u64
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    /// A drift of 0.1 µm/s through 2 s is recorded 0.2 µm behind.
    #[test]
    fn a_lagging_recorder_is_behind_the_meter() {
        let text = "output.rotary = true\nspindle.speed = '6 rpm'\n[[effect]]\n\
                    kind = 'recorder-lag'\ntime_constant = '2 s'\n";
        let machine = Model::parse(text, Path::new("machine.toml")).unwrap();
        let time_s: Vec<f64> = (0..100).map(f64::from).collect();
        let ramp_um: Vec<f64> = time_s.iter().map(|time_s| 0.1 * time_s).collect();
        let mut trace = Trace {
            time_s,
            position_mm: Vec::new(),
            error_um: ramp_um.clone(),
            filtered_error_um: ramp_um,
            steps: Vec::new(),
            lead_error_um: Vec::new(),
        };
        lag_recorder(&machine, &mut trace);
        assert!((trace.filtered_error_um[99] - 9.7).abs() < 1e-9);
        assert!((trace.error_um[99] - 9.9).abs() < 1e-12, "the meter does not lag");
    }
}
