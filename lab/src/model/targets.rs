//! Targets that are approached again and again, as ISO 230-2 has it.

use super::columns::Columns;
use super::problem::Problem;
use crate::numerics::spread;
use crate::policy::evidence::{PASSING, VISITS};
use crate::policy::extent::ROWS_A_COLUMN;

/// Places that count as one, against the travel.
const ONE_PLACE: f64 = 1e-6;

impl Problem {
    /// Places of the targets, where all samples lie at a few places and the axis may have stopped there.
    fn targets(&self) -> Option<Vec<f64>> {
        self.places().filter(|_| !self.goes_as_told())
    }

    /// Places of the samples, turns of the spindle, lowest first; `None` unless each is met several
    /// times.
    #[must_use]
    pub(crate) fn places(&self) -> Option<Vec<f64>> {
        let mut turns: Vec<f64> = self.record.turns().collect();
        let samples = turns.len();
        turns.sort_by(f64::total_cmp);
        let apart = ONE_PLACE * spread(&turns);
        turns.dedup_by(|next, before| *next - *before <= apart);
        (VISITS * turns.len() <= samples).then_some(turns)
    }

    /// True where time was measured and the axis goes as fast as it is told to: it stops nowhere.
    fn goes_as_told(&self) -> bool {
        let measurement = &self.measurement;
        let nominal = self.model.spindle.speed_rpm;
        let share = measurement.over_the_way(|row, rpm| rpm / measurement.told_rpm(row, nominal));
        measurement.timed && libm::log(share).abs() < PASSING
    }

    /// What each target shows at every visit, a column a target and sensor; none where there are no
    /// targets, or too few rows of each.
    #[must_use]
    pub(crate) fn columns_of_targets(&self) -> Vec<Vec<f64>> {
        let Some(targets) = self.targets() else { return Vec::new() };
        let width = targets.len() * self.sensors.len();
        if self.samples.len() < ROWS_A_COLUMN * width {
            return Vec::new();
        }
        let apart = ONE_PLACE * (targets[targets.len() - 1] - targets[0]);
        let turns: Vec<f64> = self.record.turns().collect();
        let target_of = |turn: f64| targets.partition_point(|target| *target <= turn + apart);
        let of: Vec<usize> = turns.into_iter().map(target_of).collect();
        let one =
            |sensor, target| self.alone(sensor, |sample| f64::from(u8::from(of[sample] == target)));
        // The zero of a pass stands for the first.
        let sensors = 0..self.sensors.len();
        sensors
            .flat_map(|sensor| (2..=targets.len()).map(move |target| one(sensor, target)))
            .collect()
    }

    /// The same problem with what each target shows at every visit left free, so that what happens
    /// from one visit to the next is measured against how well visits agree.
    #[must_use]
    pub(crate) fn with_targets_free(&self) -> Self {
        Self { free: Columns::free(self.columns_of_targets()), ..self.clone() }
    }

    /// The same problem with some columns more that every model may follow.
    #[must_use]
    pub(crate) fn beside(&self, columns: &Columns) -> Self {
        Self { free: self.free.and(columns), ..self.clone() }
    }
}
