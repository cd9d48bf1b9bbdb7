//! Measured samples in order: coordinates, sensors and covariates, pass by pass.

use std::cell::LazyCell;
use std::collections::BTreeMap;
use std::iter::repeat_n;
use std::ops::Deref;

use helixlock_plant::prediction::Sensor;
use helixlock_plant::{Bridging, COVARIATES, Column, LoggedColumn, Machine, Part, Samples};
use helixlock_traces::{Table, TextColumn};

use super::coordinates::Coordinates;
use super::error::LabError;
use super::passes::Restart;
use super::{coordinates, headers, passes, plausible};
use crate::numerics::{spread, weighted_median};
use crate::policy::reading::FEWEST_SAMPLES;

/// What the machine file says that a data file may leave out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nominal {
    /// Travel of one spindle turn, mm; arbitrary when rotary.
    pub lead_mm: f64,
    /// Spindle speed, rpm.
    pub speed_rpm: f64,
    /// Table travel of one counted step, µm.
    pub step_um: f64,
    /// True for chains without a workpiece, measured in arcsec.
    pub rotary: bool,
    /// True when a step of the corrector has a size, so that counted steps mean something.
    pub drive: bool,
    /// True when the corrector works, so that a counter without a recorder is a sensor.
    pub closed: bool,
}

impl Nominal {
    /// What a machine file says of it.
    #[must_use]
    pub fn of(machine: &Machine) -> Self {
        Self {
            lead_mm: machine.workpiece.lead.mm(),
            speed_rpm: machine.spindle.speed_rpm,
            step_um: machine.drive.step_um,
            rotary: machine.rotary,
            drive: machine.has(Part::Drive),
            closed: machine.loop_closed,
        }
    }
}

/// Column of the data file that a sensor fills.
#[must_use]
pub fn sensor_column(sensor: Sensor, rotary: bool) -> &'static str {
    match sensor {
        Sensor::Recorder if rotary => "error_arcsec",
        Sensor::Recorder => "error_um",
        Sensor::Counter => "steps",
        Sensor::Thread => "lead_error_um",
    }
}

/// What of the motion has a column of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Told {
    /// True for the speed.
    pub speed: bool,
    /// True for the direction.
    pub direction: bool,
}

/// [`Samples`] sorted by pass and, within a pass, by time, with what sensors showed of each.
#[derive(Debug, Clone, PartialEq)]
pub struct Measurement {
    /// True when the unit is arcsec instead of µm.
    pub rotary: bool,
    /// Where and when they were taken; gaps of what was logged are bridged from its neighbours.
    pub samples: Samples,
    /// Names of the passes as in the file.
    pub pass_names: Vec<f64>,
    /// Per sensor one value a sample, NaN where the cell is missing; the counter in µm.
    pub observations: BTreeMap<Sensor, Column>,
    /// Standard deviations of the recorder's values, where the file tells them (`error_um_sd`);
    /// their sizes against each other weigh the samples.
    pub deviations: Option<Column>,
    /// Of covariates that were rounded to steps: standard deviation of what they may be off by where
    /// they passed from one step to the next, in their unit.
    pub off_by: BTreeMap<String, f64>,
    /// Covariates that are the error or the position as it was measured.
    pub measurands: Vec<String>,
    /// True when time was measured, not worked out from travel and speed.
    pub timed: bool,
    /// True when travel or angle was measured, not worked out from time and speed.
    pub placed: bool,
    /// What columns tell that otherwise follows from travel and time.
    pub told: Told,
    /// Where the clock began anew within a pass, so that its order is not that of the rows.
    pub(crate) restart: Option<Restart>,
    /// What a user should know about how the file was read.
    pub notes: Vec<String>,
}

impl Measurement {
    /// True unless there are several passes, and no clock ran through all of them: how long the axis stood in between
    /// is not known then.
    pub(crate) fn tells_pauses(&self) -> bool {
        let between = |row: &usize| self.pass[row - 1] != self.pass[*row];
        let mut firsts = (1..self.pass.len()).filter(between);
        firsts.all(|row| self.timed && self.time_s[row - 1] <= self.time_s[row])
    }
}

impl Deref for Measurement {
    type Target = Samples;

    fn deref(&self) -> &Samples {
        &self.samples
    }
}

/// Column with the standard deviation of each value of the recorder.
fn deviation_column(nominal: &Nominal) -> &'static str {
    if nominal.rotary { "error_arcsec_sd" } else { "error_um_sd" }
}

/// Standard deviations, where the table has one for every value that it has.
fn deviations<'a>(table: &'a Table, nominal: &Nominal) -> Option<&'a [f64]> {
    let told = table.column(deviation_column(nominal))?;
    let values = table.column(sensor_column(Sensor::Recorder, nominal.rotary))?;
    let pairs = told.iter().zip(values);
    let whole = pairs.clone().all(|(sd, value)| !value.is_finite() || 0.0 < *sd && sd.is_finite());
    whole.then_some(told)
}

/// True for a column that is no covariate; one that nobody knows is kept as one.
fn is_coordinate_or_sensor(name: &str) -> bool {
    LoggedColumn::named(name).is_some_and(|column| !column.is_log())
}

/// True for the columns by which a simulated trace shows the recorder before its filter, and the
/// same machine with the loop the other way: they are sensors, but not of this run.
fn is_of_another_run(name: &str) -> bool {
    let rest = name.strip_prefix("open_").or_else(|| name.strip_prefix("closed_"));
    let rest = rest.unwrap_or("");
    name == "raw_error_um" || rest == "raw_error_um" || is_coordinate_or_sensor(rest)
}

impl Measurement {
    /// The same with places that count the other way.
    pub(crate) fn turned(&self) -> Self {
        let mut turned = self.clone();
        let Samples { position_mm, angle_rev, direction, .. } = &mut turned.samples;
        for column in [position_mm, angle_rev, direction] {
            column.iter_mut().for_each(|value| *value = -*value);
        }
        turned
    }

    /// Every so many rows, those that moved since the one so far before, with the speed by travel and clock,
    /// rpm.
    pub(crate) fn clocked(&self, apart: usize) -> impl Iterator<Item = (usize, f64)> {
        let Samples { angle_rev, time_s, pass, .. } = &self.samples;
        let rows = (apart..pass.len()).step_by(apart);
        let inside = rows.filter(move |&row| pass[row] == pass[row - apart]);
        let speed = move |row: usize| {
            let turns = angle_rev[row] - angle_rev[row - apart];
            (row, 60.0 * (turns / (time_s[row] - time_s[row - apart])).abs())
        };
        inside.map(speed).filter(|(_, rpm)| rpm.is_finite() && 0.0 < *rpm)
    }

    /// Speed that a row was told, by its column or else the nominal one, rpm.
    pub(crate) fn told_rpm(&self, row: usize, nominal_rpm: f64) -> f64 {
        if self.told.speed { self.samples.speed_rpm[row] } else { nominal_rpm }
    }

    /// Median over the way of a speed of each row, given with its own by the clock, rpm: over the
    /// rows it would be that of a trembling axis where it dwells.
    pub(crate) fn over_the_way(&self, speed: impl Fn(usize, f64) -> f64) -> f64 {
        let angle = &self.samples.angle_rev;
        let piece =
            |(row, rpm): (usize, f64)| (speed(row, rpm), (angle[row] - angle[row - 1]).abs());
        weighted_median(&mut self.clocked(1).map(piece).collect::<Vec<_>>())
    }

    /// Orders and completes the samples of a table.
    ///
    /// Columns such as `Position [m]` are converted where name and unit leave no doubt. Rows without
    /// a coordinate or without any observation are left out and counted in `notes`.
    ///
    /// # Errors
    ///
    /// A missing observation or coordinate, an observation of the other kind of machine, a reading
    /// that its sensor cannot show, fewer than 16 usable samples, or passes of which most have one.
    pub fn from_table(table: &Table, nominal: &Nominal) -> Result<Self, LabError> {
        let mut notes = left_out(table)?;
        let mut measurement = match headers::understood(table) {
            Some((understood, more)) => {
                notes.extend(more);
                Self::from_named(&understood, nominal)?
            }
            None => Self::from_named(table, nominal)?,
        };
        notes.append(&mut measurement.notes);
        Ok(Self { notes, ..measurement })
    }

    /// As [`Self::from_table`], for columns that have our names.
    fn from_named(table: &Table, nominal: &Nominal) -> Result<Self, LabError> {
        let path = table.path.display().to_string();
        check_kind(table, nominal, &path)?;
        plausible::check(table)?;
        let observed = observed_columns(table, nominal);
        if observed.is_empty() {
            return Err(LabError::NoObservation {
                path,
                found: names(table),
                expected: if nominal.rotary {
                    "`error_arcsec`"
                } else {
                    "`error_um`, `lead_error_um`, `steps`"
                },
            });
        }
        let coordinates = coordinates::complete(table, nominal)?;
        let keep = |row: &usize| {
            coordinates.usable(*row) && observed.iter().any(|(_, values)| values[*row].is_finite())
        };
        let rows: Vec<usize> = (0..table.rows()).filter(keep).collect();
        if rows.len() < FEWEST_SAMPLES {
            return Err(LabError::TooFew { path, found: rows.len(), expected: FEWEST_SAMPLES });
        }
        let mut notes = coordinates.notes.clone();
        let dropped = table.rows() - rows.len();
        if 0 < dropped {
            notes.push(format!(
                "{dropped} rows without a coordinate or an observation are left out"
            ));
        }
        let passes = passes::split(table, &coordinates, &rows, &mut notes);
        if let Some((passes, lone)) = passes.lone() {
            return Err(LabError::LonePasses { path, passes, lone });
        }
        let assembled = assemble(table, nominal, &coordinates, passes, notes);
        Ok(assembled.without_holds().without_treads().with_measurands_told().with_zeros_told())
    }

    /// These samples and others of the same sensors and columns behind them, as further passes.
    #[must_use]
    pub(crate) fn followed_by(&self, more: &Self) -> Self {
        let mut both = self.clone();
        let passes = self.pass_names.len();
        let last = self.pass_names.iter().copied().fold(0.0, f64::max);
        both.samples.time_s.extend(&more.time_s);
        both.samples.position_mm.extend(&more.position_mm);
        both.samples.angle_rev.extend(&more.angle_rev);
        both.samples.speed_rpm.extend(&more.speed_rpm);
        both.samples.direction.extend(&more.direction);
        both.samples.pass.extend(more.pass.iter().map(|pass| passes + pass));
        both.pass_names.extend(more.pass_names.iter().map(|name| last + name));
        for (sensor, values) in &mut both.observations {
            values.extend(&more.observations[sensor]);
        }
        if both.deviations.is_some() || more.deviations.is_some() {
            // What is not told weighs as is usual.
            let of = |one: &Self| {
                one.deviations.clone().unwrap_or_else(|| vec![f64::NAN; one.len()].into())
            };
            let mut told = of(self);
            told.extend(&of(more));
            both.deviations = Some(told);
        }
        for (name, values) in &more.covariates {
            // What is set anew was at its zero before.
            let own = both.samples.covariates.entry(name.clone());
            own.or_insert_with(|| vec![0.0; self.len()].into()).extend(values);
        }
        both
    }

    /// The same with the coordinates and logs of one pass as in other samples of the same rows.
    pub(crate) fn with_pass_of(&self, mut other: Self, pass: usize) -> Self {
        let mut mixed = self.clone();
        let columns = mixed.samples.columns_mut().zip(other.samples.columns_mut());
        for (values, others) in columns {
            let rows = values.iter_mut().zip(others.iter()).zip(&self.samples.pass);
            rows.filter(|(_, of)| **of == pass).for_each(|((value, other), _)| *value = *other);
        }
        mixed
    }

    /// Leaves out the samples that are not kept, and the passes that have none.
    pub(crate) fn keep(&mut self, kept: &[bool]) {
        let of = |values: &mut Column| {
            let mut kept = kept.iter();
            values.retain(|_| kept.next().copied().unwrap_or(true));
        };
        let seen = self.observations.values_mut().chain(&mut self.deviations);
        self.samples.columns_mut().chain(seen).for_each(of);
        let mut rows = kept.iter();
        let mut pass = std::mem::take(&mut self.samples.pass);
        pass.retain(|_| rows.next().copied().unwrap_or(true));
        let passes = || pass.chunk_by(|a, b| a == b);
        self.pass_names = passes().map(|rows| self.pass_names[rows[0]]).collect();
        let numbered = passes().enumerate().flat_map(|(n, rows)| repeat_n(n, rows.len()));
        self.samples.pass = numbered.collect();
    }

    /// Unit of the observations.
    #[must_use]
    pub fn unit(&self) -> &'static str {
        if self.rotary { "arcsec" } else { "µm" }
    }

    /// The same as files spell it.
    #[must_use]
    pub fn unit_word(&self) -> &'static str {
        if self.rotary { "arcsec" } else { "um" }
    }

    /// True when `name` is logged and takes more than one value.
    #[must_use]
    pub(crate) fn varies(&self, name: &str) -> bool {
        self.covariates.get(name).is_some_and(|values| spread(values) > 0.0)
    }
}

/// A note on every column of words; refuses those that should hold numbers.
fn left_out(table: &Table) -> Result<Vec<String>, LabError> {
    let note = |text: &TextColumn| {
        if headers::is_known(&text.name) {
            return Err(text.refused().into());
        }
        let TextColumn { name, first, .. } = text;
        Ok(format!("column `{name}` holds words, the first `{first}`, and is left out"))
    };
    table.text.iter().map(note).collect()
}

fn check_kind(table: &Table, nominal: &Nominal, path: &str) -> Result<(), LabError> {
    let other = |found, expected, hint| {
        Err(LabError::OtherKind { path: path.to_owned(), found, expected, hint })
    };
    let has = |name| table.column(name).is_some();
    if nominal.rotary && !has("error_arcsec") && has("error_um") {
        return other("error_um", "`error_arcsec`", "the machine file says `rotary = true`");
    }
    if !nominal.rotary && has("error_arcsec") && !has("error_um") {
        return other(
            "error_arcsec",
            "`error_um`",
            "a rotary chain needs `[output]` with `rotary = true` in the machine file",
        );
    }
    Ok(())
}

fn observed_columns<'a>(table: &'a Table, nominal: &Nominal) -> Vec<(Sensor, &'a [f64])> {
    let sees = |sensor: &Sensor| match sensor {
        Sensor::Recorder => true,
        Sensor::Counter => nominal.closed && !nominal.rotary && !steps_are_moves(table, nominal),
        Sensor::Thread => !nominal.rotary,
    };
    let sensors = Sensor::ALL.into_iter().filter(sees);
    sensors
        .filter_map(|s| table.column(sensor_column(s, nominal.rotary)).map(|c| (s, c)))
        .filter(|(_, values)| values.iter().any(|value| value.is_finite()))
        .collect()
}

/// True when the steps are known moves of the table: a cause, not an observation.
///
/// Those of an open loop were made by hand. In a closed loop the recorder says what they have left
/// of the error; recorder and steps together are the open loop's error without the hunting.
fn steps_are_moves(table: &Table, nominal: &Nominal) -> bool {
    let filled = |name| table.column(name).is_some_and(|c| c.iter().any(|v| v.is_finite()));
    !nominal.closed || filled(sensor_column(Sensor::Recorder, nominal.rotary))
}

pub(super) fn names(table: &Table) -> String {
    let empty = |values: &[f64]| !values.iter().any(|value| value.is_finite());
    let columns = table.columns.iter().map(|column| {
        let note = if empty(&column.values) { " (empty)" } else { "" };
        format!("`{}`{note}", column.name)
    });
    columns.collect::<Vec<_>>().join(", ")
}

fn assemble(
    table: &Table,
    nominal: &Nominal,
    coordinates: &Coordinates,
    passes: passes::Passes,
    mut notes: Vec<String>,
) -> Measurement {
    let rows = &passes.rows;
    let pick = |values: &[f64]| -> Column { rows.iter().map(|&row| values[row]).collect() };
    let mut observations = BTreeMap::new();
    for (sensor, values) in observed_columns(table, nominal) {
        let factor = if sensor == Sensor::Counter { nominal.step_um } else { 1.0 };
        observations.insert(sensor, rows.iter().map(|&row| values[row] * factor).collect());
    }
    let deviations = deviations(table, nominal).map(pick);
    if deviations.is_none() && table.column(deviation_column(nominal)).is_some() {
        notes.push(format!(
            "column `{}` is left out: it needs a number above 0 for every error",
            deviation_column(nominal)
        ));
    }
    if spread(&coordinates.angle_rev) <= 0.0 && spread(&coordinates.position_mm) <= 0.0 {
        notes.push(
            "the axis stands still: nothing that depends on its travel can be told".to_owned(),
        );
    }
    let covariates = covariates(table, nominal, (coordinates, &passes), &mut notes);
    if nominal.closed && covariates.contains_key("steps") {
        notes.push("the steps are known and taken off: the error is that without them".to_owned());
    }
    let samples = Samples {
        time_s: pick(&coordinates.time_s),
        position_mm: pick(&coordinates.position_mm),
        angle_rev: pick(&coordinates.angle_rev),
        speed_rpm: passes.speed_rpm.into(),
        direction: passes.direction.into(),
        pass: passes.pass.into(),
        covariates,
    };
    Measurement {
        rotary: nominal.rotary,
        samples,
        pass_names: passes.names,
        observations,
        deviations,
        off_by: BTreeMap::new(),
        measurands: Vec::new(),
        timed: coordinates.timed,
        placed: coordinates.placed,
        told: Told {
            speed: table.column("speed_rpm").is_some(),
            direction: table.column("direction").is_some(),
        },
        restart: passes.restart,
        notes,
    }
}

/// True for whole numbers that grow from row to row of every pass: the number of a sample, or the
/// ticks of a clock, which cause nothing.
fn counts_on(values: &[f64], pass: &[usize]) -> bool {
    let grows = |row: usize| pass[row] != pass[row + 1] || values[row] < values[row + 1];
    values.iter().all(|value| value.fract() == 0.0) && (0..values.len() - 1).all(grows)
}

fn covariates(
    table: &Table,
    nominal: &Nominal,
    (coordinates, passes): (&Coordinates, &passes::Passes),
    notes: &mut Vec<String>,
) -> BTreeMap<String, Column> {
    let mut known = BTreeMap::new();
    let rows = &passes.rows;
    let pick = |values: &[f64]| -> Vec<f64> { rows.iter().map(|&row| values[row]).collect() };
    let Coordinates { angle_rev, position_mm, .. } = coordinates;
    let place = LazyCell::new(|| pick(if nominal.rotary { angle_rev } else { position_mm }));
    let covariate = |name: &str| {
        if name == deviation_column(nominal) {
            return false;
        }
        let own =
            !is_coordinate_or_sensor(name) || (name == "steps" && steps_are_moves(table, nominal));
        own && !is_of_another_run(name)
    };
    for column in table.columns.iter().filter(|column| covariate(&column.name)) {
        if column.name == "steps" && !nominal.drive {
            notes.push("column `steps` is left out: the machine file has no `[drive]`".to_owned());
            continue;
        }
        let values = pick(&column.values);
        if !values.iter().any(|value| value.is_finite()) {
            notes.push(format!("column `{}` is empty and left out", column.name));
            continue;
        }
        if !COVARIATES.contains(&column.name.as_str()) {
            if counts_on(&values, &passes.pass) {
                let name = &column.name;
                notes.push(format!("column `{name}` counts on from row to row and is left out"));
                continue;
            }
            notes.push(format!("column `{}` is not known and kept as a covariate", column.name));
        }
        let follows = LoggedColumn::named(&column.name)
            .is_some_and(|known| known.bridging == Bridging::WithinPasses);
        let values =
            if follows { passes::kept_at_rest(&values, &place, &passes.pass) } else { values };
        known.insert(column.name.clone(), passes::bridged(&values, &passes.pass).into());
    }
    known
}
