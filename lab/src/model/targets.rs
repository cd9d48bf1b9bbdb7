//! Targets that are approached again and again, as ISO 230-2 has it.

use std::collections::BTreeMap;

use statrs::statistics::Statistics;

use super::columns::Columns;
use super::fit::settle;
use super::problem::Problem;
use super::state::State;
use crate::numerics::{middle, middle_nearest_zero, spread};
use crate::policy::evidence::{FEW_TARGETS, PASSING, VISITS, VISITS_OF_FEW};
use crate::policy::extent::{MOST_TARGETS, ROWS_A_COLUMN};
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
    /// targets, or too few rows of each, or so many that they are a log's places, which every pass reads.
    #[must_use]
    pub(crate) fn columns_of_targets(&self) -> Vec<Vec<f64>> {
        let Some(targets) = self.targets() else { return Vec::new() };
        let width = targets.len() * self.sensors.len();
        let rows = if targets.len() <= FEW_TARGETS { VISITS_OF_FEW } else { ROWS_A_COLUMN };
        if MOST_TARGETS < width || self.samples.len() < rows * width {
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

    /// What each target that is met both ways shows one way and not the other, a column a target of each sensor; none
    /// where there are no targets, or too few rows of each and each way.
    fn columns_of_ways(&self) -> Vec<Vec<Vec<f64>>> {
        let (Some(targets), width) = (self.targets(), self.columns_of_targets().len()) else {
            return Vec::new();
        };
        let ways = self.samples.iter().map(|&sample| self.record.direction[sample].signum());
        let ways: Vec<f64> = ways.collect();
        let of = self.visited(&targets);
        let is_met = |target: usize, way: f64| {
            let mut rows = self.samples.iter().zip(&ways);
            rows.any(|(&sample, met)| of[sample] == target && 0.0 < way * met)
        };
        let both = |target: &usize| is_met(*target, 1.0) && is_met(*target, -1.0);
        let both: Vec<usize> = (0..targets.len()).filter(both).collect();
        let visits = VISITS_OF_FEW * (targets.len() + both.len()) * self.sensors.len();
        if width == 0 || both.len() < 2 || self.samples.len() < visits {
            return Vec::new();
        }
        let column = |sensor, target| {
            let own = self.alone(sensor, |sample| f64::from(u8::from(of[sample] == target)));
            own.iter().zip(&ways).map(|(own, way)| own * way).collect()
        };
        let of_sensor = |sensor| both.iter().map(|&target| column(sensor, target)).collect();
        (0..self.sensors.len()).map(of_sensor).collect()
    }

    /// The same but for a reversal that is alike at all.
    #[must_use]
    pub(crate) fn columns_between_ways(&self) -> Vec<Vec<f64>> {
        let besides = |first: &[f64], one: &[f64]| -> Vec<f64> {
            one.iter().zip(first).map(|(one, first)| one - first).collect()
        };
        let of_sensors = self.columns_of_ways();
        let between = of_sensors.iter().filter_map(|columns| columns.split_first());
        between.flat_map(|(first, rest)| rest.iter().map(|one| besides(first, one))).collect()
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
            let mut visited: Vec<f64> = rows.iter().map(|&row| rest[row]).collect();
            let usual = if visited.len() == 4 {
                middle_nearest_zero(&mut visited)
            } else {
                middle(&mut visited)
            };
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

    /// True where what targets show is left free.
    #[must_use]
    pub(crate) fn are_targets_free(&self) -> bool {
        self.starts < self.free.raw.len()
    }

    /// The same with what each target shows one way and not the other, too: of one law, as wide as these scatter about
    /// what is alike at all, so that a reversal is told by their scatter.
    #[must_use]
    pub(crate) fn with_ways_free(&self) -> Self {
        let free = if self.are_targets_free() { self.clone() } else { self.with_targets_free() };
        let of_sensors = free.columns_of_ways();
        let all = Columns::free(of_sensors.concat());
        let fit = settle(&free, &free.free.and(&all), &State::bare(&free).fit.noises);
        let mut sizes = fit.linear.coefficients[free.free.raw.len()..].iter().copied();
        let prior = |ways: &Vec<Vec<f64>>| {
            let sizes: Vec<f64> = sizes.by_ref().take(ways.len()).collect();
            vec![Some((0.0, sizes.std_dev())); ways.len()]
        };
        let priors = of_sensors.iter().flat_map(prior).collect();
        free.beside(&Columns { priors, ..all })
    }

    /// True where what each target shows one way and not the other is left free.
    #[must_use]
    pub(crate) fn are_ways_free(&self) -> bool {
        self.free.priors.iter().any(Option::is_some)
    }

    /// What each target shows one way and not the other, where it is left free.
    #[must_use]
    pub(crate) fn free_ways(&self) -> Columns {
        let sized =
            self.free.raw.iter().zip(&self.free.priors).filter(|(_, prior)| prior.is_some());
        Columns::free(sized.map(|(column, _)| column.clone()))
    }

    /// Columns of a model without these.
    #[must_use]
    pub(crate) fn without_ways(&self, model: &Columns) -> Columns {
        let kept = model.raw.len() - self.free.priors.iter().flatten().count();
        Columns {
            raw: model.raw[..kept].to_vec(),
            priors: model.priors[..kept].to_vec(),
            fixed: model.fixed.clone(),
        }
    }

    /// The same problem with some columns more that every model may follow.
    #[must_use]
    pub(crate) fn beside(&self, columns: &Columns) -> Self {
        Self { free: self.free.and(columns), ..self.clone() }
    }
}
