//! The samples behind those of a measurement, for what these do not stand for.

use std::ops::Range;

use helixlock_plant::{Model, Part, Record};

use super::waves::Waves;
use crate::measurement::means;
use crate::numerics::median;
use crate::policy::extent::{
    BETWEEN_A_TURN, BETWEEN_A_WAVE, MOST_BETWEEN, MOST_COMPARISONS, MOST_REMEMBERED,
};

/// A record, those of its samples that were measured, and the groups of these that were averaged,
/// or chosen as groups of one.
///
/// Samples farther apart than comparisons have others in between: a lag works on every one, and on
/// what the model's formulas say there, not on straight lines. A recorder without comparisons follows
/// at every instant, and has as many samples in between as its waves ask for.
///
/// A formula of the mean is not the mean of a formula: a jump in the error, as the meter's dead
/// zone makes it, is smeared in one and lost in the other. And the error counts from the first
/// sample of each pass, which may not be among those chosen.
#[derive(Debug, Clone)]
pub(crate) struct Finer {
    /// All samples.
    pub(crate) record: Record,
    /// Which of them were measured, if others are in between.
    pub(crate) measured: Option<Vec<usize>>,
    /// Which measured ones make up each mean.
    pub(crate) groups: Vec<Range<usize>>,
}

/// Median time between neighbours of the same pass, s.
#[must_use]
pub(crate) fn interval_s(record: &Record) -> f64 {
    let pairs = (1..record.len()).filter(|&row| record.pass[row] == record.pass[row - 1]);
    let interval_s = |row: usize| (record.time_s[row] - record.time_s[row - 1]).abs();
    median(&mut pairs.map(interval_s).collect::<Vec<f64>>())
}

impl Finer {
    /// A record and the groups of its samples that were averaged.
    #[must_use]
    pub(crate) fn of(record: Record, groups: Vec<Range<usize>>) -> Self {
        Self { record, measured: None, groups }
    }

    /// The same samples in other groups.
    #[must_use]
    pub(crate) fn grouped(&self, groups: Vec<Range<usize>>) -> Self {
        Self { groups, ..self.clone() }
    }

    /// A record with samples in between at every comparison, or as close where there are none, and as
    /// many a wave as the quickest of the machine file asks for; `None` if it has them, or none are
    /// to be had.
    #[must_use]
    pub(crate) fn between(model: &Model, record: &Record) -> Option<Self> {
        let waves = Waves::of(model, record);
        let most = if waves.are_remembered() { MOST_REMEMBERED } else { MOST_BETWEEN };
        let compares = !model.rotary && model.has(Part::Dividers);
        let turns = if compares { model.turns_a_comparison() } else { 1.0 / BETWEEN_A_TURN };
        let asked = |row: usize| {
            let elapsed_s = record.time_s[row] - record.time_s[row - 1];
            let comparisons = elapsed_s * record.speed_rpm[row] / 60.0 / turns;
            comparisons.min(MOST_COMPARISONS).max(BETWEEN_A_WAVE * waves.between(record, row))
        };
        let (record, measured) = record.refined(most, asked)?;
        let groups = (0..measured.len()).map(|row| row..row + 1).collect();
        Some(Self { measured: Some(measured), ..Self::of(record, groups) })
    }

    /// True when the groups are the measured samples themselves, with others in between.
    #[must_use]
    pub(crate) fn is_between(&self) -> bool {
        self.measured.as_ref().is_some_and(|measured| measured.len() == self.groups.len())
    }

    /// Means of values that belong to all samples.
    #[must_use]
    pub(crate) fn means(&self, values: &[f64]) -> Vec<f64> {
        let Some(measured) = &self.measured else { return means(values, &self.groups) };
        let measured: Vec<f64> = measured.iter().map(|&sample| values[sample]).collect();
        means(&measured, &self.groups)
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use crate::measurement::{Measurement, Nominal};
    use crate::model::problem::Problem;
    use crate::numerics::mean;
    use helixlock_plant::Model;
    use helixlock_traces::{Column, Table};

    const MACHINE: &str = r#"
[workpiece]
lead = "6 mm"
[spindle]
speed = "6 rpm"
[lead_screw]
lead = "12 mm"
[grating]
lines = 13906
[laser]
wavelength = "0.63281983 um"
[dividers]
a = 110
b = 150
[drive]
step = "0.0125 um"
frequency = "160 Hz"
[[effect]]
kind = "screw-periodic"
amplitude = "1.5 um"
phase = "40 deg"
[[effect]]
kind = "meter-dead-zone"
width = "0.8 um"
"#;

    /// Two passes over 90 mm with the initial phases 0 and 3.
    fn problem() -> Problem {
        let machine = Model::parse(MACHINE, Path::new("machine.toml")).expect("a machine");
        let column = |name: &str, value: &dyn Fn(u32, u32) -> f64| {
            let samples = (0..2_u32).flat_map(|pass| (0..900_u32).map(move |row| (pass, row)));
            Column { name: name.into(), values: samples.map(|(p, r)| value(p, r)).collect() }
        };
        let table = Table::new(vec![
            column("pass", &|pass, _| f64::from(pass + 1)),
            column("position_mm", &|_, row| 0.1 * f64::from(row)),
            column("initial_phase", &|pass, _| f64::from(3 * pass)),
            column("error_um", &|_, _| 0.0),
        ]);
        let measurement = Measurement::from_table(&table, &Nominal::of(&machine));
        Problem::new(&machine, &measurement.expect("a measurement")).expect("all columns")
    }

    #[test]
    fn a_thinned_record_predicts_what_all_samples_show() {
        let whole = problem();
        let measurement = &whole.measurement;
        for groups in [measurement.groups(4), measurement.picks(7)] {
            let small = whole.averaged(groups.clone()).expect("all columns");
            let expected: Vec<f64> =
                groups.iter().map(|rows| mean(&whole.predicted[rows.clone()])).collect();
            assert_eq!(*small.predicted, expected);
        }
    }

    #[test]
    fn columns_of_an_effect_of_the_error_are_means_of_all_samples() {
        let whole = problem();
        let dead_zone = &whole.model.effects[1];
        let all = whole.design(dead_zone).expect("a column").fixed.expect("it does not scale");
        let groups = whole.measurement.picks(7);
        let small = whole.averaged(groups.clone()).expect("all columns");
        let thin = small.design(dead_zone).expect("a column").fixed.expect("it does not scale");
        // A pass counts from its first sample: of the whole record there, of those chosen here.
        for rows in small.record.passes() {
            let zero = thin[rows.start] - all[groups[rows.start].start];
            for row in rows {
                assert!((thin[row] - all[groups[row].start] - zero).abs() < 1e-12);
            }
        }
    }

    /// Ten rows a wave of 12 mm, 1.2 mm and 2 s apart: what a lag of a second shows of it is
    /// `Im(exp(iωt)/(1 + iωτ) − exp(iωt))` once it has settled. Straight lines from row to row show
    /// it a tenth off.
    #[test]
    fn a_lag_works_on_the_formula_between_rows_that_are_few_a_wave() {
        let text = "workpiece.lead = '6 mm'\nspindle.speed = '6 rpm'\nlead_screw.lead = '12 mm'\n\
                    [[effect]]\nkind = 'screw-periodic'\namplitude = '2 um'\nphase = '0 deg'\n\
                    [[effect]]\nkind = 'recorder-lag'\ntime_constant = '1 s'\n";
        let model = Model::parse(text, Path::new("machine.toml")).expect("a machine");
        let time_s = |row: u32| 2.0 * f64::from(row);
        let column = |name: &str, value: &dyn Fn(u32) -> f64| Column {
            name: name.into(),
            values: (0..100).map(value).collect(),
        };
        let table = Table::new(vec![
            column("time_s", &time_s),
            column("position_mm", &|row| 0.6 * time_s(row)),
            column("error_um", &|_| 0.0),
        ]);
        let measurement = Measurement::from_table(&table, &Nominal::of(&model)).expect("samples");
        let problem = Problem::new(&model, &measurement).expect("all columns");
        let shown = problem.design(&model.effects[1]).expect("a column").fixed.expect("a delta");
        let omega = std::f64::consts::TAU * 0.6 / 12.0;
        let square = 1.0 + omega * omega;
        for row in 10..100 {
            let angle = omega * time_s(row);
            let late = (libm::sin(angle) - omega * libm::cos(angle)) / square;
            let expected = -2.0 * (late - libm::sin(angle));
            let off = (shown[row as usize] - expected).abs();
            assert!(off < 0.02 * 2.0 * omega, "{row}: {} {expected}", shown[row as usize]);
        }
    }
}
