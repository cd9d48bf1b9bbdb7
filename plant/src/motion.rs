//! Time to travel and angle, with the effects summed by entry.

use std::f64::consts::TAU;

use crate::error::moment;
use crate::record::{COVARIATES, Columns, Covariate};
use crate::term::Sum;
use crate::units::in_reach;
use crate::{Effect, EffectError, Entry, Instant, Machine, Model};

/// A stretch of a pass at constant spindle speed in one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leg {
    /// Way, mm, without sign.
    pub length_mm: f64,
    /// Spindle speed, turns a minute.
    pub speed_rpm: f64,
    /// True towards larger positions.
    pub forward: bool,
}

/// One pass over the workpiece: where it starts and the legs that follow.
#[derive(Clone, Debug, PartialEq)]
pub struct Pass {
    /// Its number, from 0.
    pub number: usize,
    /// Position at which it starts, mm.
    pub start_mm: f64,
    /// Its legs, in order; at least one.
    pub legs: Vec<Leg>,
}

impl Pass {
    /// The whole workpiece forward at the nominal speed.
    #[must_use]
    pub fn forward(machine: &Machine) -> Self {
        let leg = Leg {
            length_mm: machine.workpiece.length_mm,
            speed_rpm: machine.spindle.speed_rpm,
            forward: true,
        };
        Self { number: 0, start_mm: 0.0, legs: vec![leg] }
    }
}

/// A leg with the moment and place of its start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Stretch {
    pub(crate) start_s: f64,
    pub(crate) end_s: f64,
    start_mm: f64,
    travelled_mm: f64,
    /// mm/s, negative in reverse.
    pub(crate) velocity_mm_s: f64,
    speed_rpm: f64,
    reversed: bool,
    /// Way of the pass at the last reversal, mm.
    reversal_mm: f64,
}

impl Stretch {
    /// Spindle speed, rad/s, without sign.
    pub(crate) fn spindle_rad_s(&self) -> f64 {
        TAU * self.speed_rpm / 60.0
    }

    /// Nominal travel at a time, µm.
    pub(crate) fn travel_um(&self, time_s: f64) -> f64 {
        1000.0 * (self.start_mm + self.velocity_mm_s * (time_s - self.start_s))
    }
}

/// Sums of δ by what they move, µm.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Deltas {
    /// The table is ahead by this.
    pub motion_um: f64,
    /// The meter sees the laser lag by this: length reference and electronics.
    pub lag_um: f64,
    /// The grating reads ahead by this, as lead.
    pub angle_um: f64,
    /// The thread ends up longer by this.
    pub workpiece_um: f64,
}

/// How the machine moves in one pass: a function of time and of where the corrector stands.
///
/// Logged quantities are constant here: those of the machine file's `[environment]`. An effect
/// whose quantity is not there does nothing, and is named in [`Self::left_out`].
#[derive(Debug)]
pub struct Motion {
    pub(crate) stretches: Vec<Stretch>,
    effects: Vec<(Entry, Sum)>,
    /// Number and name of each effect, for messages.
    names: Vec<String>,
    covariates: Vec<f64>,
    lead_mm: f64,
    number: usize,
    /// Effects that do nothing because the machine file does not say what drives them.
    pub left_out: Vec<LeftOut>,
}

/// An effect that does nothing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LeftOut {
    /// Its name.
    pub effect: String,
    /// The column that drives it.
    pub column: String,
}

impl Motion {
    /// The motion of a model over a pass; actuator effects are the [`crate::Actuator`]'s.
    ///
    /// # Errors
    ///
    /// [`EffectError`] when an effect needs a section of the machine file that is missing.
    pub fn new(model: &Model, pass: &Pass) -> Result<Self, EffectError> {
        let (columns, covariates) = surroundings(model);
        let mut effects = Vec::new();
        let (mut names, mut left_out) = (Vec::new(), Vec::new());
        for (index, term) in model.effects.iter().enumerate() {
            if term.entry == Entry::Actuator {
                continue;
            }
            match term.effect(model, &columns) {
                Ok(effect) => {
                    effects.push((term.entry, effect));
                    names.push(format!("effect {} `{}`", index + 1, term.name));
                }
                Err(EffectError::MissingColumn { effect, column, .. }) => {
                    left_out.push(LeftOut { effect, column });
                }
                Err(error) => return Err(error),
            }
        }
        let lead_mm = model.workpiece.lead.mm();
        let stretches = stretches(pass, lead_mm);
        Ok(Self { stretches, effects, names, covariates, lead_mm, number: pass.number, left_out })
    }

    /// When the pass ends, s.
    #[must_use]
    pub fn end_s(&self) -> f64 {
        self.stretches.last().map_or(0.0, |stretch| stretch.end_s)
    }

    /// The state of the machine at a time in s; before the start and after the end it goes on.
    #[must_use]
    pub fn at(&self, time_s: f64) -> Instant<'_> {
        let after = self.stretches.partition_point(|stretch| stretch.start_s <= time_s);
        self.on(&self.stretches[after.saturating_sub(1)], time_s)
    }

    /// The state at a time, as if the stretch went on for ever.
    pub(crate) fn on(&self, stretch: &Stretch, time_s: f64) -> Instant<'_> {
        let elapsed_s = time_s - stretch.start_s;
        let position_mm = stretch.start_mm + stretch.velocity_mm_s * elapsed_s;
        let travelled_mm = stretch.travelled_mm + stretch.velocity_mm_s.abs() * elapsed_s;
        let since_mm =
            if stretch.reversed { travelled_mm - stretch.reversal_mm } else { f64::INFINITY };
        Instant {
            time_s,
            position_mm,
            spindle_rad: TAU * position_mm / self.lead_mm,
            speed_rpm: stretch.speed_rpm,
            direction: stretch.velocity_mm_s.signum(),
            velocity_rpm: stretch.speed_rpm * stretch.velocity_mm_s.signum(),
            pass: self.number,
            travelled_mm,
            since_reversal_mm: since_mm,
            since_turn_mm: since_mm,
            // A pass of the device goes on from start to end.
            since_stop_s: f64::INFINITY,
            error_um: 0.0,
            covariates: &self.covariates,
        }
    }

    /// Effects at an instant, with the corrector holding the table `corrector_um` ahead.
    #[must_use]
    pub fn deltas(&self, now: &Instant<'_>, corrector_um: f64) -> Deltas {
        let mut sums = Deltas::default();
        for (entry, effect) in self.effects.iter().filter(|(_, effect)| !effect.feeds_back()) {
            sums.add(*entry, effect.delta_um(now));
        }
        let now = Instant { error_um: sums.error_um(corrector_um), ..*now };
        for (entry, effect) in self.effects.iter().filter(|(_, effect)| effect.feeds_back()) {
            sums.add(*entry, effect.delta_um(&now));
        }
        sums
    }

    /// How much longer than nominal the thread is where it is ground at `time_s`, µm.
    #[must_use]
    pub fn lead_error_um(&self, time_s: f64, corrector_um: f64) -> f64 {
        let sums = self.deltas(&self.at(time_s), corrector_um);
        sums.motion_um + sums.workpiece_um + corrector_um
    }

    /// Names the effect whose value at a time is nothing a machine could follow.
    pub(crate) fn out_of_reach(&self, time_s: f64, corrector_um: f64) -> EffectError {
        let now = self.at(time_s);
        let error_um = self.deltas(&now, corrector_um).error_um(corrector_um);
        let now = Instant { error_um, ..now };
        let values = self.effects.iter().map(|(_, effect)| effect.delta_um(&now));
        let beyond = self.names.iter().zip(values).find(|(_, value)| !in_reach(*value));
        let (effect, value) = match beyond {
            Some((name, value)) => (name.clone(), value),
            None if in_reach(corrector_um) => ("the sum of the effects".into(), error_um),
            None => ("the sum of the actuator's effects".into(), corrector_um),
        };
        EffectError::OutOfReach { effect, found: value.to_string(), place: self.place(time_s) }
    }

    /// When and where, for a message.
    pub(crate) fn place(&self, time_s: f64) -> String {
        moment(time_s, self.at(time_s).position_mm)
    }

    /// The effects, with their entries.
    pub(crate) fn effects(&self) -> &[(Entry, Sum)] {
        &self.effects
    }
}

impl Deltas {
    /// What the meter shows of them, with the corrector holding the table `corrector_um` ahead.
    fn error_um(&self, corrector_um: f64) -> f64 {
        self.lag_um + self.angle_um - self.motion_um - corrector_um
    }

    fn add(&mut self, entry: Entry, delta_um: f64) {
        match entry {
            Entry::Motion => self.motion_um += delta_um,
            Entry::LengthReference | Entry::Electronics => self.lag_um += delta_um,
            Entry::AngleReference => self.angle_um += delta_um,
            Entry::Workpiece => self.workpiece_um += delta_um,
            Entry::Actuator => {}
        }
    }
}

/// Constant readings of the machine file, and the phase its switches select.
pub(crate) fn surroundings(machine: &Machine) -> (Columns, Vec<f64>) {
    let readings = &machine.environment.readings;
    let phase = COVARIATES[Covariate::InitialPhase as usize];
    let names = readings.iter().map(|(name, _)| name.as_str()).chain([phase]);
    let columns = Columns::new(names);
    let mut covariates = vec![f64::NAN; columns.len()];
    covariates[Covariate::InitialPhase as usize] = f64::from(machine.dividers.initial_phase);
    for (name, value) in readings {
        if let Some(index) = columns.index(name) {
            covariates[index] = *value;
        }
    }
    (columns, covariates)
}

fn stretches(pass: &Pass, lead_mm: f64) -> Vec<Stretch> {
    let (mut time_s, mut position_mm, mut travelled_mm) = (0.0, pass.start_mm, 0.0);
    let (mut reversed, mut reversal_mm, mut forward) = (false, 0.0, None);
    let mut stretches = Vec::new();
    for leg in &pass.legs {
        if forward.is_some_and(|before| before != leg.forward) {
            (reversed, reversal_mm) = (true, travelled_mm);
        }
        forward = Some(leg.forward);
        let pace_mm_s = lead_mm * leg.speed_rpm / 60.0;
        let velocity_mm_s = if leg.forward { pace_mm_s } else { -pace_mm_s };
        let end_s = time_s + leg.length_mm / pace_mm_s;
        stretches.push(Stretch {
            start_s: time_s,
            end_s,
            start_mm: position_mm,
            travelled_mm,
            velocity_mm_s,
            speed_rpm: leg.speed_rpm,
            reversed,
            reversal_mm,
        });
        position_mm += if leg.forward { leg.length_mm } else { -leg.length_mm };
        travelled_mm += leg.length_mm;
        time_s = end_s;
    }
    stretches
}
