//! What recorder, counter and finished screw show, in closed form.
//!
//! | entry | recorder, open | recorder, closed | counter, closed | thread, open | thread, closed |
//! |---|---|---|---|---|---|
//! | motion | −δ | 0 | −δ/step | +δ | 0 |
//! | length reference | +δ | 0 | +δ/step | 0 | +δ |
//! | angle reference | +δ | 0 | +δ/step | 0 | +δ |
//! | workpiece | 0 | 0 | 0 | +δ | +δ |
//! | electronics | +δ | 0 | +δ/step | 0 | +δ |
//! | actuator | +δ | 0 | +δ/step | −δ | 0 |
//!
//! An actuator effect is a function of the steps; without steps its δ is 0, so an open loop shows
//! nothing of it unless the record says that steps were taken by hand. Closed, the loop is taken
//! to be perfect: what it leaves (hunting, lag, slew) is the cycle-accurate run's to say.
//!
//! Each pass has its own zero: everything is counted from its first sample.

use crate::compensation::compensation_um;
use crate::rationalisation::rationalisation_um_per_m;
use crate::{
    Effect, EffectError, Entry, LowPass, Machine, Model, Record, record::Covariate, term::Sum,
};

/// Something that records an error.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Sensor {
    /// `error_um` (`error_arcsec` on a rotary chain): positive when the laser lags.
    Recorder,
    /// `steps`: net steps of the corrector, forward positive.
    Counter,
    /// `lead_error_um`: positive when the thread is too long.
    Thread,
}

impl Sensor {
    /// All sensors.
    pub const ALL: [Self; 3] = [Self::Recorder, Self::Counter, Self::Thread];
}

/// How much of an effect of 1 µm a sensor shows, in its unit.
#[must_use]
pub fn gain(machine: &Machine, entry: Entry, sensor: Sensor) -> f64 {
    let (open, closed) = match entry {
        Entry::Motion => ([-1.0, 0.0, 1.0], [0.0, -1.0, 0.0]),
        Entry::LengthReference | Entry::AngleReference | Entry::Electronics => {
            ([1.0, 0.0, 0.0], [0.0, 1.0, 1.0])
        }
        Entry::Workpiece => ([0.0, 0.0, 1.0], [0.0, 0.0, 1.0]),
        Entry::Actuator => ([1.0, 0.0, -1.0], [0.0, 1.0, 0.0]),
    };
    let [recorder, counter_um, thread] = if machine.loop_closed { closed } else { open };
    match sensor {
        Sensor::Recorder => recorder,
        Sensor::Counter => counter_um / machine.drive.step_um,
        Sensor::Thread => thread,
    }
}

/// What each sensor shows for each sample of a record.
#[derive(Clone, Debug, PartialEq)]
pub struct Prediction {
    /// Recorder, µm (arcsec on a rotary chain), through its filter.
    pub error_um: Vec<f64>,
    /// Counter, in steps, not rounded.
    pub steps: Vec<f64>,
    /// Finished thread, µm.
    pub lead_error_um: Vec<f64>,
}

impl Prediction {
    /// The column of a sensor.
    #[must_use]
    pub fn of(&self, sensor: Sensor) -> &[f64] {
        match sensor {
            Sensor::Recorder => &self.error_um,
            Sensor::Counter => &self.steps,
            Sensor::Thread => &self.lead_error_um,
        }
    }
}

/// Predicts all sensors for a machine with its effects.
///
/// # Errors
///
/// [`EffectError`] when an effect needs a column or section that is missing.
pub fn predict(model: &Model, record: &Record) -> Result<Prediction, EffectError> {
    let machine = &model.machine;
    let effects = model
        .effects
        .iter()
        .map(|term| Ok((term.entry, term.effect(machine, &record.columns)?)))
        .collect::<Result<Vec<_>, EffectError>>()?;
    let record = Record { error_um: meter_um(machine, record, &effects).into(), ..record.clone() };
    let shown = |sensor| shown(machine, &record, &effects, sensor);
    Ok(Prediction {
        error_um: shown(Sensor::Recorder),
        steps: shown(Sensor::Counter),
        lead_error_um: shown(Sensor::Thread),
    })
}

/// What one sensor shows of effects on a record that has the error at the meter ([`meter_um`]).
#[must_use]
pub fn shown(
    machine: &Machine,
    record: &Record,
    effects: &[(Entry, Sum)],
    sensor: Sensor,
) -> Vec<f64> {
    let mut shown = implied(machine, record, sensor);
    for (entry, effect) in effects {
        let factor = gain(machine, *entry, sensor);
        if factor != 0.0 {
            let deltas = effect.deltas_um(record);
            shown.iter_mut().zip(&deltas).for_each(|(sum, delta)| *sum += factor * delta);
        }
    }
    settle(machine, record, sensor, shown)
}

/// A design column: what `sensor` shows of an effect whose δ is `deltas_um`.
///
/// It is linear in the deltas: gain of the entry, zero at the start of each pass, and for the
/// recorder its filter. Zeros everywhere when the sensor does not see the entry.
#[must_use]
pub fn observe(
    machine: &Machine,
    record: &Record,
    entry: Entry,
    sensor: Sensor,
    deltas_um: &[f64],
) -> Vec<f64> {
    let factor = gain(machine, entry, sensor);
    if factor == 0.0 {
        return vec![0.0; record.len()];
    }
    let scaled: Vec<_> = deltas_um.iter().map(|delta| factor * delta).collect();
    settle(machine, record, sensor, scaled)
}

/// The same through effects that delay the error which the deltas make, as a recorder's lag does.
#[must_use]
pub fn observe_late(
    machine: &Machine,
    record: &Record,
    (entry, deltas_um): (Entry, &[f64]),
    sensor: Sensor,
    lags: &[(Entry, Sum)],
) -> Vec<f64> {
    let factor = gain(machine, entry, Sensor::Recorder);
    if sensor != Sensor::Recorder || machine.loop_closed || factor == 0.0 || lags.is_empty() {
        return observe(machine, record, entry, sensor, deltas_um);
    }
    let error_um = zeroed(record, deltas_um.iter().map(|delta| factor * delta).collect());
    let seen = Record { error_um: error_um.clone().into(), ..record.clone() };
    let mut shown = error_um;
    for (entry, lag) in lags {
        let factor = gain(machine, *entry, sensor);
        let deltas = lag.deltas_um(&seen);
        shown.iter_mut().zip(&deltas).for_each(|(sum, delta)| *sum += factor * delta);
    }
    settle(machine, record, sensor, shown)
}

/// Error at the meter without the effects that depend on it, each pass from its own zero, µm.
///
/// Put it into [`Record::error_um`] before a feedback effect is worked out on a record.
#[must_use]
pub fn meter_um(machine: &Machine, record: &Record, effects: &[(Entry, Sum)]) -> Vec<f64> {
    if machine.loop_closed {
        return vec![0.0; record.len()];
    }
    let mut error_um = implied(machine, record, Sensor::Recorder);
    for (entry, effect) in effects.iter().filter(|(_, effect)| !effect.feeds_back()) {
        let factor = gain(machine, *entry, Sensor::Recorder);
        if factor != 0.0 {
            let deltas = effect.deltas_um(record);
            error_um.iter_mut().zip(&deltas).for_each(|(sum, delta)| *sum += factor * delta);
        }
    }
    zeroed(record, error_um)
}

/// What the machine file itself implies, before zero and filter: the slope that the dividers leave
/// against the laser's own number of fringes, the stairs of the compensation that is set, steps
/// made by hand.
#[must_use]
pub fn implied(machine: &Machine, record: &Record, sensor: Sensor) -> Vec<f64> {
    if machine.rotary {
        return vec![0.0; record.len()];
    }
    let reference = gain(machine, Entry::LengthReference, sensor);
    let slope = reference * rationalisation_um_per_m(machine) / 1000.0;
    let by_hand = if machine.loop_closed {
        0.0
    } else {
        machine.drive.step_um * gain(machine, Entry::Motion, sensor)
    };
    record
        .instants()
        .zip(compensation_um(machine, record))
        .map(|(now, stairs_um)| {
            let steps = now.covariate(Covariate::Steps);
            let moved = if by_hand == 0.0 || steps.is_nan() { 0.0 } else { by_hand * steps };
            slope * now.position_mm + reference * stairs_um + moved
        })
        .collect()
}

/// Zero of each pass, and the recorder's filter.
fn settle(machine: &Machine, record: &Record, sensor: Sensor, shown: Vec<f64>) -> Vec<f64> {
    let zeroed = zeroed(record, shown);
    let cutoff_hz = machine.filter_cutoff_hz.filter(|_| sensor == Sensor::Recorder);
    let Some(cutoff_hz) = cutoff_hz else { return zeroed };
    let mut filtered = Vec::with_capacity(zeroed.len());
    for rows in record.passes() {
        let filter = LowPass::with_cutoff(cutoff_hz);
        filtered.extend(filter.pass(&record.time_s[rows.clone()], &zeroed[rows]));
    }
    filtered
}

/// Values counted from the first sample of each pass that has one.
fn zeroed(record: &Record, mut values: Vec<f64>) -> Vec<f64> {
    for rows in record.passes() {
        let pass = &mut values[rows];
        let zero = pass.iter().copied().find(|value| value.is_finite()).unwrap_or_default();
        for value in pass {
            *value -= zero;
        }
    }
    values
}
