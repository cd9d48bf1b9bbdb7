//! Where and when: one instant of a run, or a whole record of samples.

mod column;
mod logged;
mod refined;
mod samples;
mod stops;

use std::f64::consts::TAU;

pub use column::Column;
pub use logged::{Bridging, COVARIATES, HeaderUnit, LOGGED_COLUMNS, LoggedColumn, Setting};
pub use samples::Samples;

/// Index of [`COVARIATES`], for effects to read `now.covariates`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(usize)]
pub enum Covariate {
    /// Air along the laser beam, °C.
    AirTemperature,
    /// Air pressure, hPa.
    AirPressure,
    /// Relative humidity, %.
    Humidity,
    /// Workpiece, °C.
    WorkpieceTemperature,
    /// Bed, °C.
    BedTemperature,
    /// Pitch of the carriage on the bed, seconds of arc.
    BedPitch,
    /// Normal grinding force, N.
    Force,
    /// Laser pulses of the initial phase selection.
    InitialPhase,
    /// How far the grating disc has been turned on its hub, °.
    GratingIndex,
    /// How far the workpiece has been turned in its clamping, °.
    ClampingIndex,
    /// Net steps the corrector was told to take.
    Steps,
}

/// Names of the columns behind `covariates`, and which of them hold anything.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Columns {
    names: Vec<String>,
    present: Vec<bool>,
}

impl Default for Columns {
    fn default() -> Self {
        let names: Vec<_> = COVARIATES.iter().map(ToString::to_string).collect();
        let present = vec![false; names.len()];
        Self { names, present }
    }
}

impl Columns {
    /// All of [`COVARIATES`] in their order, then the others among `present` in theirs.
    pub fn new<'a>(present: impl IntoIterator<Item = &'a str>) -> Self {
        let mut columns = Self::default();
        for name in present {
            if let Some(index) = columns.index(name) {
                columns.present[index] = true;
            } else {
                columns.names.push(name.into());
                columns.present.push(true);
            }
        }
        columns
    }

    /// Index of a column in `covariates`, present or not.
    #[must_use]
    pub fn index(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|known| known == name)
    }

    /// True when the column holds values.
    #[must_use]
    pub fn has(&self, name: &str) -> bool {
        self.index(name).is_some_and(|index| self.present[index])
    }

    /// Number of columns, present or not.
    #[must_use]
    pub fn len(&self) -> usize {
        self.names.len()
    }

    /// True when there are no columns, which never happens.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.names.is_empty()
    }

    /// Names of the columns that hold values.
    pub fn present(&self) -> impl Iterator<Item = &str> {
        self.names.iter().zip(&self.present).filter(|(_, there)| **there).map(|(n, _)| n.as_str())
    }
}

/// One moment of a run, as far as an effect may know it.
#[derive(Clone, Copy, Debug)]
pub struct Instant<'a> {
    /// Time since the start of the record, s.
    pub time_s: f64,
    /// Nominal travel on the workpiece, mm; falls in a reverse pass.
    pub position_mm: f64,
    /// Spindle angle, rad, counted on over the turns.
    pub spindle_rad: f64,
    /// Spindle speed, turns a minute, without sign.
    pub speed_rpm: f64,
    /// +1 forward, −1 in reverse.
    pub direction: f64,
    /// Turns of the spindle a minute at this very moment, negative backwards.
    pub velocity_rpm: f64,
    /// Pass, from 0.
    pub pass: usize,
    /// Way since the start of the pass, mm, never falling; degrees on a rotary chain.
    pub travelled_mm: f64,
    /// Way since the last reversal inside this pass, mm; infinite before the first; degrees on a rotary chain.
    pub since_reversal_mm: f64,
    /// The same, where a pass goes on from where the one before ended: of that too.
    pub since_turn_mm: f64,
    /// Time since the axis came to stand, s; infinite while it moves.
    pub since_stop_s: f64,
    /// What the meter would show without the effects that depend on it, µm, laser lag positive.
    pub error_um: f64,
    /// Logged quantities, indexed by [`Covariate`], then by [`Columns`]; NaN where missing.
    pub covariates: &'a [f64],
}

impl Instant<'_> {
    /// A logged quantity, or NaN.
    #[must_use]
    pub fn covariate(&self, which: Covariate) -> f64 {
        self.covariates.get(which as usize).copied().unwrap_or(f64::NAN)
    }

    /// Nominal travel, m.
    #[must_use]
    pub fn position_m(&self) -> f64 {
        self.position_mm / 1000.0
    }
}

/// What an instant knows where nothing was logged.
static UNLOGGED: [f64; COVARIATES.len()] = [f64::NAN; COVARIATES.len()];

/// [`Samples`] as the effects of a machine read them, with what follows from how it moves.
#[derive(Clone, Debug, Default)]
pub struct Record {
    /// Time since the start of the record, s.
    pub time_s: Column,
    /// Nominal travel, mm.
    pub position_mm: Column,
    /// Spindle angle, rad.
    pub spindle_rad: Column,
    /// Spindle speed, turns a minute.
    pub speed_rpm: Column,
    /// +1 or −1.
    pub direction: Column,
    /// Pass, from 0, in blocks: a number never comes back.
    pub pass: Column<usize>,
    /// Way since the start of the pass, mm; see [`Self::begun_at_zero`] for where that is.
    pub travelled_mm: Column,
    /// Way since the last reversal inside the pass, mm; infinite before the first.
    pub since_reversal_mm: Column,
    /// The same, where a pass goes on from where the one before ended: of that too.
    pub since_turn_mm: Column,
    /// Time since the axis came to stand, s, infinite while it moves; empty where it never stands.
    pub since_stop_s: Column,
    /// Turns over time from the sample before to the one behind, rpm; see [`Self::velocities_rpm`].
    pub(crate) velocity_rpm: Column,
    /// What the meter would show without the effects that depend on it, µm; zeros until set.
    pub error_um: Column,
    /// Names behind the covariates.
    pub columns: Columns,
    /// Row by row; empty where nothing was logged.
    pub(crate) covariates: Column,
}

impl Record {
    /// Number of samples.
    #[must_use]
    pub fn len(&self) -> usize {
        self.time_s.len()
    }

    /// True when there is no sample.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.time_s.is_empty()
    }

    /// One sample as an instant.
    ///
    /// # Panics
    ///
    /// When `index` is not below [`Self::len`].
    #[must_use]
    pub fn instant(&self, index: usize) -> Instant<'_> {
        Instant {
            time_s: self.time_s[index],
            position_mm: self.position_mm[index],
            spindle_rad: self.spindle_rad[index],
            speed_rpm: self.speed_rpm[index],
            direction: self.direction[index],
            velocity_rpm: self.velocity_rpm[index],
            pass: self.pass[index],
            travelled_mm: self.travelled_mm[index],
            since_reversal_mm: self.since_reversal_mm[index],
            since_turn_mm: self.since_turn_mm[index],
            since_stop_s: self.since_stop_s(index),
            error_um: self.error_um[index],
            covariates: self.logged(index),
        }
    }

    /// All samples as instants.
    pub fn instants(&self) -> impl Iterator<Item = Instant<'_>> {
        let rows = self.len();
        // Of equal length beyond doubt, so that no sample asks again.
        let (time_s, position_mm) = (&self.time_s[..rows], &self.position_mm[..rows]);
        let (spindle_rad, speed_rpm) = (&self.spindle_rad[..rows], &self.speed_rpm[..rows]);
        let (direction, pass) = (&self.direction[..rows], &self.pass[..rows]);
        let (travelled_mm, velocity_rpm) = (&self.travelled_mm[..rows], &self.velocity_rpm[..rows]);
        let since_reversal_mm = &self.since_reversal_mm[..rows];
        let since_turn_mm = &self.since_turn_mm[..rows];
        let error_um = &self.error_um[..rows];
        (0..rows).map(move |row| Instant {
            time_s: time_s[row],
            position_mm: position_mm[row],
            spindle_rad: spindle_rad[row],
            speed_rpm: speed_rpm[row],
            direction: direction[row],
            velocity_rpm: velocity_rpm[row],
            pass: pass[row],
            travelled_mm: travelled_mm[row],
            since_reversal_mm: since_reversal_mm[row],
            since_turn_mm: since_turn_mm[row],
            since_stop_s: self.since_stop_s(row),
            error_um: error_um[row],
            covariates: self.logged(row),
        })
    }

    /// Turns over time from the sample before to the one behind, as far as they are of its pass; 0
    /// where no time passes between them. Many effects ask for what few use: it is worked out once.
    pub(crate) fn velocities_rpm(&self) -> Column {
        let of = |row: usize| {
            let is_own = |other: &usize| self.pass.get(*other) == Some(&self.pass[row]);
            let before = row.checked_sub(1).filter(is_own).unwrap_or(row);
            let behind = Some(row + 1).filter(is_own).unwrap_or(row);
            let elapsed_s = self.time_s[behind] - self.time_s[before];
            let turns = (self.spindle_rad[behind] - self.spindle_rad[before]) / TAU;
            if 0.0 < elapsed_s { 60.0 * turns / elapsed_s } else { 0.0 }
        };
        (0..self.len()).map(of).collect()
    }

    fn since_stop_s(&self, row: usize) -> f64 {
        self.since_stop_s.get(row).copied().unwrap_or(f64::INFINITY)
    }

    /// Logged quantities of one sample.
    fn logged(&self, row: usize) -> &[f64] {
        let width = self.columns.len();
        self.covariates.get(row * width..(row + 1) * width).unwrap_or(&UNLOGGED)
    }

    /// A logged column, or `None` when it is not there.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<Vec<f64>> {
        let index = self.columns.index(name).filter(|_| self.columns.has(name))?;
        Some(self.instants().map(|now| now.covariates[index]).collect())
    }

    /// True when the direction changes between a sample and the one before it.
    pub(crate) fn turned(&self, row: usize) -> bool {
        self.direction[row] * self.direction[row - 1] < 0.0
    }

    /// The same, if every forward pass began at travel zero, however far its first sample lies.
    #[must_use]
    pub fn begun_at_zero(&self) -> Self {
        let mut begun = self.clone();
        for rows in self.passes() {
            let before_mm = self.position_mm[rows.start] - self.travelled_mm[rows.start];
            if 0.0 < before_mm && 0.0 < self.direction[rows.start] {
                begun.travelled_mm[rows].iter_mut().for_each(|way_mm| *way_mm += before_mm);
            }
        }
        begun
    }

    /// Rows of each pass, in order.
    #[must_use]
    pub fn passes(&self) -> Vec<std::ops::Range<usize>> {
        let mut end = 0;
        let rows = |pass: &[usize]| {
            let start = end;
            end += pass.len();
            start..end
        };
        self.pass.chunk_by(|a, b| a == b).map(rows).collect()
    }

    /// Turns of the spindle since its zero.
    pub fn turns(&self) -> impl Iterator<Item = f64> {
        self.spindle_rad.iter().map(|rad| rad / TAU)
    }
}
