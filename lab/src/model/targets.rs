//! Targets that are approached again and again, as ISO 230-2 has it.

use std::collections::BTreeMap;

use super::columns::Columns;
use super::problem::Problem;
use crate::numerics::{middle, middle_nearest_zero, spread};
use crate::policy::evidence::{FEW_TARGETS, PASSING, VISITS, VISITS_OF_FEW};
use crate::policy::extent::ROWS_A_COLUMN;
use crate::policy::reading::ONE_PLACE;

/// Values that are more than a place apart, lowest first.
#[must_use]
pub(crate) fn distinct(mut values: Vec<f64>) -> Vec<f64> {
    values.sort_by(f64::total_cmp);
    let apart = ONE_PLACE * spread(&values);
    values.dedup_by(|next, before| *next - *before <= apart);
    values
}

impl Problem {
    /// Places of the targets, where all samples lie at a few places and the axis may have stopped there.
    fn targets(&self) -> Option<Vec<f64>> {
        self.places().filter(|_| !self.goes_as_told())
    }

    /// Places of the samples, turns of the spindle, lowest first; `None` unless each is met several
    /// times.
    #[must_use]
    pub(crate) fn places(&self) -> Option<Vec<f64>> {
        let turns = distinct(self.record.turns().collect());
        let visits = if turns.len() <= FEW_TARGETS { VISITS_OF_FEW } else { VISITS };
        (visits * turns.len() <= self.record.len()).then_some(turns)
    }

    /// Which of some targets each sample is at.
    #[must_use]
    pub(crate) fn visited(&self, targets: &[f64]) -> Vec<usize> {
        let apart = ONE_PLACE * spread(targets);
        let behind = |turn: f64| targets.partition_point(|target| *target <= turn + apart);
        self.record.turns().map(|turn| behind(turn).saturating_sub(1)).collect()
    }

    /// True where time was measured and the axis goes as fast as it is told to, from row to row, or through whole
    /// passes where its place is looked at less often than the rest: it stops nowhere.
    fn goes_as_told(&self) -> bool {
        let measurement = &self.measurement;
        let nominal = self.model.spindle.speed_rpm;
        let of_rows = measurement.over_the_way(|row, rpm| rpm / measurement.told_rpm(row, nominal));
        let is_one = |share: f64| libm::log(share).abs() < PASSING;
        measurement.timed && (is_one(of_rows) || is_one(self.gone() / self.told_to_go(nominal)))
    }

    /// Turns that the axis has gone through all passes.
    fn gone(&self) -> f64 {
        let turns = &self.measurement.angle_rev;
        self.moves().map(|row| (turns[row] - turns[row - 1]).abs()).sum()
    }

    /// Turns that it was told to go in that time.
    fn told_to_go(&self, nominal_rpm: f64) -> f64 {
        let time_s = &self.measurement.time_s;
        let told = |row| self.measurement.told_rpm(row, nominal_rpm) / 60.0;
        self.moves().map(|row| told(row) * (time_s[row] - time_s[row - 1])).sum()
    }

    /// Rows that another of their pass stands before.
    fn moves(&self) -> impl Iterator<Item = usize> {
        self.record.passes().into_iter().flat_map(|rows| rows.skip(1))
    }

    /// What each target shows at every visit, a column a target and sensor; none where there are no
    /// targets, or too few rows of each.
    #[must_use]
    pub(crate) fn columns_of_targets(&self) -> Vec<Vec<f64>> {
        let Some(targets) = self.targets() else { return Vec::new() };
        let width = targets.len() * self.sensors.len();
        let rows = if targets.len() <= FEW_TARGETS { VISITS_OF_FEW } else { ROWS_A_COLUMN };
        if self.samples.len() < rows * width {
            return Vec::new();
        }
        let of = self.visited(&targets);
        let one =
            |sensor, target| self.alone(sensor, |sample| f64::from(u8::from(of[sample] == target)));
        // The zero of a pass stands for the first.
        let sensors = 0..self.sensors.len();
        sensors
            .flat_map(|sensor| (1..targets.len()).map(move |target| one(sensor, target)))
            .collect()
    }

    /// What each target shows at every visit one way and at every visit the other, but for a reversal that is
    /// alike at all; none where there are no targets, or too few rows of each and each way.
    #[must_use]
    pub(crate) fn columns_of_targets_each_way(&self) -> Vec<Vec<f64>> {
        let mut columns = self.columns_of_targets();
        let (Some(targets), width) = (self.targets(), columns.len()) else { return columns };
        let ways = self.samples.iter().map(|&sample| self.record.direction[sample].signum());
        let ways: Vec<f64> = ways.collect();
        let is_both = ways.iter().any(|way| *way < 0.0) && ways.iter().any(|way| 0.0 < *way);
        if !is_both || self.samples.len() < 2 * VISITS_OF_FEW * (width + self.sensors.len()) {
            return Vec::new();
        }
        let of = self.visited(&targets);
        for place in 0..width {
            let sensor = place / (targets.len() - 1);
            let first = self.alone(sensor, |sample| f64::from(u8::from(of[sample] == 0)));
            let one = columns[place].iter().zip(&first).zip(&ways);
            columns.push(one.map(|((own, first), way)| (own - first) * way).collect());
        }
        columns
    }

    /// What a model leaves without what each target shows at most of its visits one way: a target that is off
    /// at every visit is no bad reading. And which rows tell how far noise takes one: of three visits the middle one,
    /// which all are held against, does not; of more it hardly counts. Where two of four are off, nothing tells which
    /// two but that most targets are where the model has them.
    pub(super) fn without_own_errors(&self, left: &[f64]) -> (Vec<f64>, Vec<bool>) {
        let (mut rest, mut telling) = (left.to_vec(), vec![true; left.len()]);
        let Some(targets) = self.targets() else { return (rest, telling) };
        let of = self.visited(&targets);
        let mut visits = BTreeMap::<_, Vec<usize>>::new();
        for block in &self.layout.blocks {
            let level = middle(&mut left[block.rows.clone()].to_vec());
            for row in block.rows.clone() {
                rest[row] -= level;
                let sample = self.samples[row];
                let is_forward = 0.0 < self.record.direction[sample];
                visits.entry((block.sensor, of[sample], is_forward)).or_default().push(row);
            }
        }
        for rows in visits.values().filter(|rows| VISITS_OF_FEW <= rows.len()) {
            let usual =
                middle_nearest_zero(&mut rows.iter().map(|&row| rest[row]).collect::<Vec<_>>());
            for &row in rows {
                rest[row] -= usual;
                telling[row] = VISITS_OF_FEW < rows.len() || rest[row].abs() > 0.0;
            }
        }
        (rest, telling)
    }

    /// The same problem with what each target shows at every visit left free, so that what happens
    /// from one visit to the next is measured against how well visits agree.
    #[must_use]
    pub(crate) fn with_targets_free(&self) -> Self {
        self.beside(&Columns::free(self.columns_of_targets()))
    }

    /// The same problem with some columns more that every model may follow.
    #[must_use]
    pub(crate) fn beside(&self, columns: &Columns) -> Self {
        Self { free: self.free.and(columns), ..self.clone() }
    }
}
