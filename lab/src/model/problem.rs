//! A measurement against a machine, as the rows of one least-squares problem.

use std::collections::BTreeSet;
use std::ops::Range;
use std::sync::{Arc, OnceLock};

use helixlock_plant::prediction::{Sensor, gain, meter_um, observe, observe_late, shown};
use helixlock_plant::{Column, Effect, EffectError, Entry, Model, Part, Record, Sum, Term};

use super::columns::Columns;
use super::designs::Designs;
use super::finer::{Finer, interval_s};
use crate::measurement::{Measurement, spacing};
use crate::noise::{Block, Layout};
use crate::numerics::{count, highest_frequency, median, middle};
use crate::policy::extent::{MOST_BETWEEN, SEARCHED_ROWS};
use crate::policy::reading::{FAR_OUT, MOST_TOLD, OUTLIER_DEVIATIONS, WRITTEN_INTERVAL};
use crate::policy::size::{FINEST_SENSOR_UM, ONE_SPEED, SAMPLES_OFF, SWINGS};

/// All sensors of a measurement stacked, with what the model predicts taken off.
#[derive(Debug, Clone)]
pub struct Problem {
    /// The machine and its effects, which are part of the prediction.
    pub model: Model,
    /// The samples.
    pub measurement: Measurement,
    /// The samples as the catalogue wants them.
    pub record: Record,
    /// See [`Self::finer`]; most problems are laid out to be compared, and never ask.
    pub(crate) finer: Arc<OnceLock<Option<Finer>>>,
    /// Sensors in the order of `Layout`'s numbers.
    pub sensors: Vec<Sensor>,
    /// Of each row, the index of its sample in the measurement and in the record.
    pub samples: Column<usize>,
    /// Blocks, clocks and outliers.
    pub layout: Layout,
    /// Observed values in µm (arcsec), the counter too.
    pub observed: Column,
    /// Variance below which no sensor's noise is taken to be, µm² (arcsec²).
    pub(crate) least_variance: Vec<f64>,
    /// What the model predicts, each pass from its own zero.
    pub(crate) predicted: Column,
    /// Where the meter stood as each pass began, against the first, µm: its reading, as far above what the model
    /// says from the pass's own zero. A count that nobody sets back goes on from pass to pass.
    pub(crate) begun: Vec<(usize, f64)>,
    /// Effects of the user's own to be tried beside the catalogue.
    pub extra: Vec<Term>,
    /// See [`Self::highest_order`]; most problems are laid out to be compared, and never ask.
    pub(crate) highest_order: OnceLock<f64>,
    /// See [`Self::highest_hz`].
    pub(crate) highest_hz: OnceLock<f64>,
    /// Columns of effects on these samples; they depend on the machine and the record alone.
    pub(crate) designs: Designs,
    /// See [`Self::velocity_rpm`], which asks the record once.
    pub(crate) velocity_rpm: OnceLock<Option<Column>>,
    /// How far a closed loop whose steps are not known swings either way, µm; 0 for any other.
    pub(crate) hunting_um: f64,
    /// What belongs to no effect and every model may follow: see [`Self::with_targets_free`].
    pub(crate) free: Columns,
    /// How many of these, the first, are what passes began with: see [`Self::with_starts`].
    pub(crate) starts: usize,
}

impl Problem {
    /// Lays a measurement out for a machine.
    ///
    /// # Errors
    ///
    /// [`EffectError`] when an effect of the machine needs a column the measurement lacks.
    pub fn new(model: &Model, measurement: &Measurement) -> Result<Self, EffectError> {
        Self::laid_out(model, measurement, None, None)
    }

    /// Highest order of the spindle that the samples resolve.
    #[must_use]
    pub fn highest_order(&self) -> f64 {
        *self
            .highest_order
            .get_or_init(|| highest_frequency(&self.record.turns().collect::<Vec<_>>()))
    }

    /// Highest frequency in time that the samples resolve, Hz.
    #[must_use]
    pub(crate) fn highest_hz(&self) -> f64 {
        *self.highest_hz.get_or_init(|| highest_frequency(&self.record.time_s))
    }

    /// Turns of the spindle a minute at every sample, negative backwards; `None` where time was not
    /// measured, or a pass has one speed: differences of neighbours then tell what its direction
    /// tells, with more noise.
    #[must_use]
    pub(crate) fn velocity_rpm(&self) -> Option<&Column> {
        self.velocity_rpm.get_or_init(|| self.uneven_velocity_rpm()).as_ref()
    }

    fn uneven_velocity_rpm(&self) -> Option<Column> {
        if !self.measurement.timed {
            return None;
        }
        let velocity: Column = self.record.instants().map(|now| now.velocity_rpm).collect();
        let off_in = |rows: Range<usize>| {
            let mut speeds: Vec<f64> = velocity[rows].iter().map(|now| now.abs()).collect();
            let usual = median(&mut speeds);
            speeds.iter().filter(|speed| ONE_SPEED * usual < (*speed - usual).abs()).count()
        };
        let off: usize = self.record.passes().into_iter().map(off_in).sum();
        (SAMPLES_OFF * count(velocity.len()) < count(off)).then_some(velocity)
    }

    /// The same with means of groups of neighbouring samples.
    ///
    /// # Errors
    ///
    /// As [`Self::new`].
    pub(crate) fn averaged(&self, groups: Vec<Range<usize>>) -> Result<Self, EffectError> {
        let measurement = self.measurement.averaged(&groups);
        let finer = match self.finer() {
            Some(finer) if finer.is_between() && finer.record.len() <= MOST_BETWEEN => {
                finer.grouped(groups)
            }
            _ => Finer::of(self.record.clone(), groups),
        };
        Self::laid_out(&self.model, &measurement, Some(finer), Some(self.begun.clone()))
    }

    fn laid_out(
        model: &Model,
        measurement: &Measurement,
        averaged: Option<Finer>,
        begun: Option<Vec<(usize, f64)>>,
    ) -> Result<Self, EffectError> {
        let whole = averaged.is_none();
        let mut problem = Self {
            model: as_measured(model, measurement),
            measurement: measurement.clone(),
            record: Record::new(model, measurement),
            finer: Arc::default(),
            sensors: measurement.observations.keys().copied().collect(),
            samples: Column::default(),
            layout: Layout::default(),
            observed: Column::default(),
            least_variance: Vec::new(),
            predicted: Column::default(),
            begun: Vec::new(),
            extra: Vec::new(),
            highest_order: OnceLock::new(),
            highest_hz: OnceLock::new(),
            designs: Designs::default(),
            velocity_rpm: OnceLock::new(),
            hunting_um: 0.0,
            free: Columns::default(),
            starts: 0,
        };
        problem.stack_rows();
        problem.least_variance = problem.finest(&[]);
        problem.begun = begun.map_or_else(|| problem.begun_from(), Ok)?;
        if let Some(averaged) = averaged {
            problem.finer = Arc::new(OnceLock::from(Some(problem.with_error(averaged)?)));
        }
        problem.predict()?;
        if whole {
            problem.find_start()?;
        }
        problem.find_starts()?;
        let residual = problem.residual();
        problem.mark_outliers(&residual);
        if problem.is_coarser_without_far_rows() {
            problem.mark_outliers(&residual);
        }
        problem.hunting_um = hunting_um(&problem, &residual);
        Ok(problem)
    }

    /// Samples behind those of this problem: between them, where a recorder follows, or that they are means or a
    /// choice of. There may be millions; clones of a problem share them.
    fn finer(&self) -> Option<&Finer> {
        self.finer.get_or_init(|| self.between()).as_ref()
    }

    fn between(&self) -> Option<Finer> {
        let follows = self.sensors.contains(&Sensor::Recorder);
        let finer = follows.then(|| Finer::between(&self.model, &self.record)).flatten();
        self.with_error(finer?).ok()
    }

    /// Rows that lie far beyond what noise does, and weigh little.
    pub(crate) fn far_rows(&self) -> Vec<usize> {
        let told = self.told_variances();
        let far = (FAR_OUT / OUTLIER_DEVIATIONS) * (FAR_OUT / OUTLIER_DEVIATIONS);
        (0..told.len()).filter(|&row| far * told[row] < self.layout.inflation[row]).collect()
    }

    /// For each row whether it weighs less than its deviation says.
    #[must_use]
    pub(crate) fn weighed_down(&self) -> Vec<bool> {
        let told = self.told_variances();
        told.iter().zip(self.layout.inflation.iter()).map(|(told, own)| told < own).collect()
    }

    /// The same problem where some rows weigh as their deviations say, however far they lie.
    #[must_use]
    pub(crate) fn weighing_fully(&self, rows: &BTreeSet<usize>) -> Self {
        let told = self.told_variances();
        let mut inflation = self.layout.inflation.to_vec();
        for &row in rows {
            inflation[row] = told[row];
        }
        let layout = Layout { inflation: inflation.into(), ..self.layout.clone() };
        Self { layout, ..self.clone() }
    }

    /// Takes the steps that the sensors read in from the other rows alone; true where they are then coarser: one
    /// wild reading off the lattice, as a mean over a gap is, hides it.
    fn is_coarser_without_far_rows(&mut self) -> bool {
        let far = self.far_rows();
        let before = self.least_variance.clone();
        if !far.is_empty() {
            self.least_variance = self.finest(&far);
        }
        self.least_variance != before
    }

    /// Variance of every row against the usual one, as the file tells it, in powers of two: most
    /// neighbours then share one, which the noise works faster with.
    pub(crate) fn told_variances(&self) -> Vec<f64> {
        let Some(told) = &self.measurement.deviations else { return vec![1.0; self.samples.len()] };
        let mut finite: Vec<f64> = told.iter().copied().filter(|sd| sd.is_finite()).collect();
        let usual = median(&mut finite);
        let variance = |sensor: Sensor, sample: usize| {
            let share = told[sample] / usual;
            if sensor != Sensor::Recorder || !(0.0 < share && share.is_finite()) {
                return 1.0;
            }
            let share = share.clamp(1.0 / MOST_TOLD, MOST_TOLD);
            libm::exp2(libm::round(2.0 * libm::log2(share)))
        };
        let of_block = |block: &Block| {
            let sensor = self.sensors[block.sensor];
            self.samples[block.rows.clone()].iter().map(move |&sample| variance(sensor, sample))
        };
        self.layout.blocks.iter().flat_map(of_block).collect()
    }

    /// Observed less predicted, µm (arcsec); every pass has an arbitrary zero.
    #[must_use]
    pub fn residual(&self) -> Vec<f64> {
        self.observed.iter().zip(&self.predicted).map(|(seen, said)| seen - said).collect()
    }

    /// True when every row is of the same sensor and sample as that of another problem.
    #[must_use]
    pub(crate) fn has_rows_of(&self, other: &Self) -> bool {
        self.sensors == other.sensors && self.samples == other.samples
    }

    /// True when every row is of the same sample as that of another problem, of whichever sensor.
    #[must_use]
    pub(crate) fn has_samples_of(&self, other: &Self) -> bool {
        self.sensors.len() == other.sensors.len() && self.samples == other.samples
    }

    /// What a free number costs as evidence (Bayesian information criterion): rows beyond those that are searched
    /// tell no more of what their means do not.
    #[must_use]
    pub(crate) fn price_of_a_number(&self) -> f64 {
        libm::log(count(self.samples.len().min(SEARCHED_ROWS)).max(3.0))
    }

    /// Design column, row by row, of an effect whose δ at every sample is given.
    #[must_use]
    pub(crate) fn column(&self, entry: Entry, deltas: &[f64]) -> Vec<f64> {
        self.stacked(|sensor| observe(&self.model, &self.record, entry, sensor, deltas))
    }

    /// What each row shows of 1 µm that goes in somewhere and stays.
    pub(crate) fn unit_column(&self, entry: Entry) -> Vec<f64> {
        self.stacked(|sensor| vec![gain(&self.model, entry, sensor); self.record.len()])
    }

    /// Design column of an effect, through the recorder's filter and lags at every comparison.
    fn column_of(&self, entry: Entry, unit: &dyn Effect, lags: &[(Entry, Sum)]) -> Vec<f64> {
        let late = if unit.feeds_back() { &[] } else { lags };
        let filters = self.model.filter_cutoff_hz.is_some();
        let finer = match late {
            [] if !filters => None,
            [] => self.finer().filter(|finer| finer.measured.is_some()),
            _ => self
                .finer()
                .filter(|finer| finer.is_between() || finer.record.len() <= MOST_BETWEEN),
        };
        if late.is_empty() && finer.is_none() {
            return self.column(entry, &self.deltas_um(unit));
        }
        let record = finer.map_or(&self.record, |finer| &finer.record);
        let deltas = unit.deltas_um(record);
        self.stacked(|sensor| {
            let shown = observe_late(&self.model, record, (entry, &deltas), sensor, late);
            match finer {
                Some(finer) => finer.means(&shown),
                None => shown,
            }
        })
    }

    /// What each sensor shows of each sample, row by row in µm.
    fn stacked(&self, shown: impl Fn(Sensor) -> Vec<f64>) -> Vec<f64> {
        let shown: Vec<Vec<f64>> = self.sensors.iter().map(|&sensor| shown(sensor)).collect();
        let mut column = Vec::with_capacity(self.samples.len());
        for block in &self.layout.blocks {
            let shown = &shown[block.sensor];
            let factor = self.unit(self.sensors[block.sensor]);
            let samples = &self.samples[block.rows.clone()];
            column.extend(samples.iter().map(|&sample| factor * shown[sample]));
        }
        column
    }

    /// What one sensor shows of each sample, row by row; 0 in the rows of the others.
    #[must_use]
    pub(crate) fn alone(&self, sensor: usize, shown: impl Fn(usize) -> f64) -> Vec<f64> {
        self.of_rows(sensor, |row| shown(self.samples[row]))
    }

    /// A column of one sensor's rows, 0 in those of the others.
    pub(crate) fn of_rows(&self, sensor: usize, shown: impl Fn(usize) -> f64) -> Vec<f64> {
        let mut column = vec![0.0; self.samples.len()];
        for block in self.layout.blocks.iter().filter(|block| block.sensor == sensor) {
            block.rows.clone().for_each(|row| column[row] = shown(row));
        }
        column
    }

    /// True when some sensor sees an entry.
    #[must_use]
    pub(crate) fn sees(&self, entry: Entry) -> bool {
        self.sensors.iter().any(|&s| gain(&self.model, entry, s) != 0.0)
    }

    /// Entries that sensors see, without those that all show as they do an earlier one, of any size.
    #[must_use]
    pub(crate) fn distinct_entries(&self) -> Vec<Entry> {
        let gains = |entry| -> Vec<f64> {
            self.sensors.iter().map(|&sensor| gain(&self.model, entry, sensor)).collect()
        };
        let is_alike = |one: &[f64], other: &[f64]| {
            let [own, both, theirs] = [(one, one), (one, other), (other, other)]
                .map(|(a, b)| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>());
            own * theirs <= both * both * (1.0 + f64::EPSILON.sqrt())
        };
        let mut distinct: Vec<Entry> = Vec::new();
        for entry in Entry::ALL.into_iter().filter(|entry| self.sees(*entry)) {
            if !distinct.iter().any(|earlier| is_alike(&gains(*earlier), &gains(entry))) {
                distinct.push(entry);
            }
        }
        distinct
    }

    /// Design columns of a term at its nonlinear values, and what does not scale.
    ///
    /// # Errors
    ///
    /// [`EffectError`] when a column or a section of the machine file is missing.
    pub(crate) fn design(&self, term: &Term) -> Result<Design, EffectError> {
        self.design_beside(term, &[])
    }

    /// The same beside other effects of a model, through those of them that delay.
    ///
    /// # Errors
    ///
    /// As [`Self::design`].
    pub(crate) fn design_beside(
        &self,
        term: &Term,
        others: &[&Term],
    ) -> Result<Design, EffectError> {
        let lags = self.lags_beside(others)?;
        let mut design = self.design_alone(term, &lags)?;
        if let Some(before) = term.instead_of.and_then(|place| self.model.effects.get(place)) {
            let said = self.said(before, &lags)?;
            let fixed = design.fixed.get_or_insert_with(|| vec![0.0; said.len()].into());
            fixed.iter_mut().zip(&said).for_each(|(fixed, said)| *fixed -= said);
        }
        Ok(design)
    }

    /// The effects that delay what is shown: those of some terms, and of the machine file's those in
    /// whose place none of them stands.
    fn lags_beside(&self, terms: &[&Term]) -> Result<Vec<(Entry, Sum)>, EffectError> {
        let stands = |place: usize| terms.iter().all(|term| term.instead_of != Some(place));
        let own = self.model.effects.iter().enumerate().filter(|(place, _)| stands(*place));
        let all = own.map(|(_, term)| term).chain(terms.iter().copied());
        let lags = all.filter(|term| term.nature().delays).map(Term::without_starts);
        lags.map(|term| Ok((term.entry, term.effect(&self.model, &self.record.columns)?))).collect()
    }

    /// What the machine file says that an effect of it shows, row by row.
    fn said(&self, term: &Term, lags: &[(Entry, Sum)]) -> Result<Vec<f64>, EffectError> {
        let Design { columns, fixed } = self.design_alone(term, lags)?;
        let mut said = fixed.map_or_else(|| vec![0.0; self.samples.len()], |fixed| fixed.to_vec());
        for (column, size) in columns.iter().zip(term.coefficients()) {
            said.iter_mut().zip(column.iter()).for_each(|(sum, value)| *sum += size * value);
        }
        Ok(said)
    }

    /// The same of a term that takes no other's place.
    fn design_alone(&self, term: &Term, lags: &[(Entry, Sum)]) -> Result<Design, EffectError> {
        let context =
            helixlock_plant::Context { machine: &self.model, columns: &self.record.columns };
        let basis = term.basis(&context)?;
        let column = |unit: &dyn Effect| Column::from(self.column_of(term.entry, unit, lags));
        let columns = basis.columns.iter().map(|unit| column(unit.as_ref())).collect();
        Ok(Design { columns, fixed: basis.fixed.map(|unit| column(unit.as_ref())) })
    }

    /// δ of every sample. The mean of neighbours stands for them, except with an effect that
    /// depends on the error since the start of the pass: of that one the mean is taken.
    fn deltas_um(&self, unit: &dyn Effect) -> Vec<f64> {
        let finer = if unit.feeds_back() { self.finer() } else { None };
        match finer {
            Some(finer) => finer.means(&unit.deltas_um(&finer.record)),
            None => unit.deltas_um(&self.record),
        }
    }

    /// Median time between two samples of a pass before any means, s, those in between among them.
    #[must_use]
    pub(crate) fn finest_interval_s(&self) -> f64 {
        interval_s(self.finer().map_or(&self.record, |finer| &finer.record))
    }

    /// µm a unit of a sensor's prediction: the counter counts steps.
    fn unit(&self, sensor: Sensor) -> f64 {
        if sensor == Sensor::Counter { self.model.drive.step_um } else { 1.0 }
    }

    fn stack_rows(&mut self) {
        let mut samples = Vec::with_capacity(self.sensors.len() * self.record.len());
        for (index, &sensor) in self.sensors.iter().enumerate() {
            let values = &self.measurement.observations[&sensor];
            for rows in self.record.passes() {
                let start = samples.len();
                let pass = self.record.pass[rows.start];
                samples.extend(rows.filter(|&sample| values[sample].is_finite()));
                if start < samples.len() {
                    let rows = start..samples.len();
                    self.layout.blocks.push(Block { sensor: index, pass, rows, loudness: 0 });
                }
            }
        }
        self.samples = samples.into();
        self.observed = self.of_samples(|sensor| &self.measurement.observations[&sensor]);
        let clock = clock(&self.measurement).into();
        self.layout.clock = self.of_samples(|_| &clock);
        self.layout.inflation = vec![1.0; self.samples.len()].into();
    }

    /// Values that belong to samples, row by row; shared where every sample is a row.
    fn of_samples<'a>(&'a self, values: impl Fn(Sensor) -> &'a Column) -> Column {
        if let [sensor] = *self.sensors
            && self.samples.len() == self.record.len()
        {
            return values(sensor).clone();
        }
        let of_block = |block: &Block| {
            let values = values(self.sensors[block.sensor]);
            self.samples[block.rows.clone()].iter().map(|&sample| values[sample])
        };
        self.layout.blocks.iter().flat_map(of_block).collect()
    }

    /// Variance that the steps of each sensor's readings leave, but for some rows in order: a reading on a lattice
    /// of spacing q is off by q/√12, however still the digits stand.
    fn finest(&self, but: &[usize]) -> Vec<f64> {
        let of_sensor = |sensor: usize| {
            let rows = self.layout.of_sensor(sensor).1;
            let step = if but.is_empty() {
                spacing(&self.observed[rows])
            } else {
                let near = rows.filter(|row| but.binary_search(row).is_err());
                spacing(&near.map(|row| self.observed[row]).collect::<Vec<f64>>())
            };
            let step = step.unwrap_or(0.0);
            (FINEST_SENSOR_UM * FINEST_SENSOR_UM).max(step * step / 12.0)
        };
        (0..self.sensors.len()).map(of_sensor).collect()
    }

    /// Where the compensator began to count is not in the file: at the first sample of each pass,
    /// or at travel zero before it, whichever leaves the smaller steps between neighbours.
    fn find_start(&mut self) -> Result<(), EffectError> {
        if self.model.lacks(&[Part::Table, Part::Dividers]).is_some()
            || self.model.dividers.compensation_cycle().is_none()
        {
            return Ok(());
        }
        let record = self.record.begun_at_zero();
        let mut begun = Self { record, finer: Arc::default(), ..self.clone() };
        begun.predict()?;
        if begun.roughness() < self.roughness() {
            *self = begun;
        }
        Ok(())
    }

    /// Sum of the squares of what the prediction leaves from neighbour to neighbour, µm².
    fn roughness(&self) -> f64 {
        let left = |row: usize| self.observed[row] - self.predicted[row];
        let blocks = self.layout.blocks.iter();
        let steps = blocks.flat_map(|block| {
            let pairs = block.rows.start..block.rows.end.saturating_sub(1);
            pairs.map(|row| left(row + 1) - left(row))
        });
        steps.map(|step| step * step).sum()
    }

    /// What the model says of every row if the samples were taken elsewhere or told otherwise, without what the
    /// recorder shows of the times between them.
    pub(crate) fn predicted_of(&self, measurement: &Measurement) -> Result<Vec<f64>, EffectError> {
        let mut record = Record::new(&self.model, measurement);
        let effects = self.effects_on(&record)?;
        record.error_um = meter_um(&self.model, &record, &effects).into();
        Ok(self.stacked(|sensor| shown(&self.model, &record, &effects, sensor)))
    }

    /// The model's effects, ready for a record.
    fn effects_on(&self, record: &Record) -> Result<Vec<(Entry, Sum)>, EffectError> {
        let effects = self.model.effects.iter();
        effects.map(|term| Ok((term.entry, term.effect(&self.model, &record.columns)?))).collect()
    }

    /// What the model says of every row, each pass from its own zero: between the rows too where that is
    /// remembered.
    fn predict(&mut self) -> Result<(), EffectError> {
        let effects = self.effects_on(&self.record)?;
        self.record.error_um = self.error_at_the_meter(&self.record, &effects);
        let remembers = |(_, effect): &(Entry, Sum)| effect.remembers();
        let remembers = self.model.filter_cutoff_hz.is_some() || effects.iter().any(remembers);
        let finer =
            if remembers { self.finer() } else { self.finer.get().and_then(Option::as_ref) };
        let predicted = self.stacked(|sensor| match finer {
            None => shown(&self.model, &self.record, &effects, sensor),
            Some(finer) => finer.means(&shown(&self.model, &finer.record, &effects, sensor)),
        });
        if predicted.iter().any(|value| !value.is_finite()) {
            for term in &self.model.effects {
                self.must_be_in_reach(term)?;
            }
        }
        self.predicted = predicted.into();
        Ok(())
    }

    /// Samples with the error that the model predicts, for effects that depend on it: what was measured carries
    /// the noise, and a column made of the noise explains it.
    fn with_error(&self, mut finer: Finer) -> Result<Finer, EffectError> {
        let effects = self.effects_on(&finer.record)?;
        finer.record.error_um = self.error_at_the_meter(&finer.record, &effects);
        Ok(finer)
    }

    fn error_at_the_meter(&self, record: &Record, effects: &[(Entry, Sum)]) -> Column {
        counted_on(record, meter_um(&self.model, record, effects), &self.begun)
    }

    /// What [`Self::begun`] is, of these samples; a single pass needs none.
    fn begun_from(&self) -> Result<Vec<(usize, f64)>, EffectError> {
        let of_meter = |block: &&Block| self.sensors[block.sensor] == Sensor::Recorder;
        let passes: Vec<&Block> = self.layout.blocks.iter().filter(of_meter).collect();
        if passes.len() < 2 {
            return Ok(Vec::new());
        }
        let from_zero_um = meter_um(&self.model, &self.record, &self.effects_on(&self.record)?);
        let above = |block: &Block| {
            let above = |row: usize| self.observed[row] - from_zero_um[self.samples[row]];
            middle(&mut block.rows.clone().map(above).collect::<Vec<f64>>())
        };
        let above_um: Vec<f64> = passes.iter().map(|block| above(block)).collect();
        let from_first = above_um.iter().map(|above| above - above_um[0]);
        Ok(passes.iter().map(|block| block.pass).zip(from_first).collect())
    }

    /// Names the first sample at which an effect has no value that a machine could follow.
    ///
    /// # Errors
    ///
    /// [`EffectError`] with that sample.
    pub(crate) fn must_be_in_reach(&self, term: &Term) -> Result<(), EffectError> {
        let record = self.finer().map_or(&self.record, |finer| &finer.record);
        term.must_be_in_reach(&self.model, record)
    }
}

/// The error at the meter of a record, each pass counted on from where it began.
fn counted_on(record: &Record, mut error_um: Vec<f64>, begun: &[(usize, f64)]) -> Column {
    let from = |pass: usize| begun.iter().find(|(of, _)| *of == pass).map_or(0.0, |(_, um)| *um);
    for rows in record.passes() {
        let from_um = from(record.pass[rows.start]);
        error_um[rows].iter_mut().for_each(|error| *error += from_um);
    }
    error_um.into()
}

/// The machine as the samples show it: where the steps are known, a closed loop is an open one
/// whose motor was turned by hand, and its hunting is no part of the error.
fn as_measured(model: &Model, measurement: &Measurement) -> Model {
    let known = measurement.covariates.contains_key("steps");
    let mut shown = model.clone();
    shown.machine.loop_closed &= !known;
    shown
}

/// What the motor moves from one comparison to the next, at the slowest speed of the samples; less
/// where neighbours differ too little for it.
fn hunting_um(problem: &Problem, residual: &[f64]) -> f64 {
    let machine = &problem.model;
    if !machine.loop_closed || machine.lacks(&[Part::Table, Part::Dividers]).is_some() {
        return 0.0;
    }
    let speeds = problem.record.speed_rpm.iter().copied();
    let slower = (machine.spindle.speed_rpm / speeds.fold(f64::INFINITY, f64::min)).max(1.0);
    let swing_um =
        slower * machine.drive.step_um * machine.drive.frequency_hz / machine.comparison_hz();
    // Equal values of a counter say that no step was taken in between, and nothing of their size.
    let moved =
        |&row: &usize| problem.observed[row].to_bits() != problem.observed[row + 1].to_bits();
    let blocks = problem.layout.blocks.iter();
    let mut steps: Vec<f64> = blocks
        .flat_map(|block| block.rows.start..block.rows.end.saturating_sub(1))
        .filter(moved)
        .map(|row| (residual[row + 1] - residual[row]).abs())
        .collect();
    swing_um.min(SWINGS * median(&mut steps))
}

/// Columns of one effect.
#[derive(Debug, Clone)]
pub(crate) struct Design {
    /// One a coefficient, row by row.
    pub(crate) columns: Vec<Column>,
    /// What does not scale with a coefficient.
    pub(crate) fixed: Option<Column>,
}

/// Clock of the noise in median intervals: time if it was logged, else the count of samples.
fn clock(measurement: &Measurement) -> Vec<f64> {
    let time = &measurement.time_s;
    let mut intervals: Vec<f64> = time
        .windows(2)
        .zip(measurement.pass.windows(2))
        .filter(|(_, pass)| pass[0] == pass[1])
        .map(|(pair, _)| pair[1] - pair[0])
        .filter(|interval| 0.0 < *interval)
        .collect();
    let usual = median(&mut intervals);
    if measurement.timed && 0.0 < usual {
        let mut clock = time.first().map_or(0.0, |first| first / usual);
        let later = time.windows(2).map(|pair| {
            let interval = (pair[1] - pair[0]) / usual;
            clock += if (interval - 1.0).abs() < WRITTEN_INTERVAL { 1.0 } else { interval };
            clock
        });
        return time.first().map(|first| first / usual).into_iter().chain(later).collect();
    }
    (0..time.len()).map(count).collect()
}

#[cfg(test)]
mod tests;
