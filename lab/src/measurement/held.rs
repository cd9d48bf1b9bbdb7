//! Logged quantities that a slow instrument read now and then, each reading held until the next.
//!
//! Where a column changes only at the ticks of a clock, the value behind a tick is what was read
//! there, and nothing is known between. A straight line from reading to reading is as true to the
//! log as the staircase, and does not lag behind the truth by half a tick.

use std::f64::consts::TAU;

use helixlock_plant::{Bridging, Column, LOGGED_COLUMNS, LoggedColumn};

use super::Measurement;
use crate::numerics::{count, median};
use crate::policy::reading::{AT_A_TICK, BY_ACCIDENT, ROWS_A_READING};

/// How well a tick is known, in the usual interval of rows.
const SLACK: f64 = 0.25;

/// When an instrument was read: at `start` and every `period` before and after.
#[derive(Debug, Clone, Copy)]
struct Clock {
    start: f64,
    period: f64,
}

/// The last instant with one value and the first with another.
type Change = [f64; 2];

impl Measurement {
    /// True for a log that repeats its readings, by no clock that would tell when they were taken.
    pub(crate) fn holds(&self, name: &str) -> bool {
        let steady = |column: &LoggedColumn| column.bridging != Bridging::Never;
        let values =
            self.covariates.get(name).filter(|_| LoggedColumn::named(name).is_some_and(steady));
        values.is_some_and(|values| {
            ROWS_A_READING * changes(&self.time_s, &[values]).len() < values.len()
                && !self.rests_with_the_axis(values)
        })
    }

    fn rests_with_the_axis(&self, values: &Column) -> bool {
        rests_with([&self.position_mm, &self.angle_rev], values)
    }

    /// The same with held readings joined by straight lines, and a note on each.
    ///
    /// One instrument reads several quantities at a time: a column of few changes follows the clock
    /// that all of them follow together.
    pub(super) fn without_holds(mut self) -> Self {
        let is_read = |column: &&LoggedColumn| {
            column.bridging != Bridging::Never
                && self
                    .covariates
                    .get(column.name)
                    .is_some_and(|values| !self.rests_with_the_axis(values))
        };
        let read: Vec<&LoggedColumn> = LOGGED_COLUMNS.iter().filter(is_read).collect();
        let logged: Vec<&Column> =
            read.iter().map(|column| &self.covariates[column.name]).collect();
        let common = Clock::of(&self.time_s, &logged);
        for LoggedColumn { name, bridging, .. } in read {
            let goes_on = *bridging != Bridging::WithinPasses;
            let values = &self.covariates[*name];
            let shared = || common.filter(|clock| clock.is_kept(&self.time_s, values));
            let Some(clock) = Clock::of(&self.time_s, &[values]).or_else(shared) else { continue };
            let mut joined = Vec::with_capacity(values.len());
            while joined.len() < values.len() {
                let from = joined.len();
                let same = |pass: &&usize| goes_on || **pass == self.pass[from];
                let rows = from..from + self.pass[from..].iter().take_while(same).count();
                joined.extend(clock.joined(&self.time_s[rows.clone()], &values[rows]));
            }
            self.notes.push(format!(
                "column `{name}` repeats each reading for {:.3} s: between readings it is interpolated",
                clock.period
            ));
            self.samples.covariates.insert((*name).to_owned(), joined.into());
        }
        self
    }
}

/// Most ticks from one change to the next that changes usually: a reading may equal the last.
const MOST_TICKS: u8 = 4;

/// Changes that a clock is looked for in before the others settle it.
const FIRST: usize = 64;

/// Clocks tried where two of them come apart by a tick over those changes, and most of all.
const STEPS_A_CELL: f64 = 8.0;
const MOST_STEPS: f64 = 1e5;

/// Share of the highest peak that a slower one needs.
const AS_HIGH: f64 = 0.9;

/// Ticks before the fit is better than the first guess.
const ENOUGH: usize = 4;

impl Clock {
    /// The clock that columns follow together; `None` when they change at other times, or at every
    /// row.
    fn of(time: &[f64], columns: &[&Column]) -> Option<Self> {
        if time.windows(2).any(|pair| pair[1] < pair[0]) {
            return None;
        }
        let changes = changes(time, columns);
        if changes.len() < 2 || time.len() < ROWS_A_READING * changes.len() {
            return None;
        }
        let interval = interval(time);
        let clocks = Self::of_changes(&changes)?.into_iter();
        clocks.filter_map(|clock| clock.near(&changes)).find(|one| one.explains(&changes, interval))
    }

    /// True when a column hardly changes anywhere but at a tick.
    fn is_kept(&self, time: &[f64], values: &Column) -> bool {
        let changes = changes(time, &[values]);
        !changes.is_empty() && self.at_ticks(&changes, interval(time)).is_some()
    }

    /// Clocks whose ticks the first changes lie closest to, slowest first.
    fn of_changes(changes: &[Change]) -> Option<Vec<Self>> {
        let mut gaps: Vec<f64> =
            changes.windows(2).map(|pair| middle(&pair[1]) - middle(&pair[0])).collect();
        gaps.sort_by(f64::total_cmp);
        let usual = *gaps.get(gaps.len() / 4)?;
        // What changed while nobody looked, as between two passes, tells no phase.
        let told = changes.iter().filter(|[before, after]| after - before <= 0.5 * usual);
        let first: Vec<f64> = told.take(FIRST).map(middle).collect();
        if first.len() < 2 {
            return None;
        }
        let lasts = first[first.len() - 1] - first[0];
        let step = STEPS_A_CELL.recip() / lasts;
        let (low, high) = (0.8 / usual, f64::from(MOST_TICKS) / usual);
        if !(0.0 < step && (high - low) / step < MOST_STEPS) {
            return None;
        }
        let together = |frequency: f64| {
            let waves = first.iter().map(|at| libm::sincos(TAU * frequency * (at - first[0])));
            waves.fold((0.0, 0.0), |sum, wave| (sum.0 + wave.0, sum.1 + wave.1))
        };
        let steps = std::iter::successors(Some(low), |last| Some(last + step));
        let tried: Vec<f64> = steps.take_while(|frequency| *frequency <= high).collect();
        let size = |frequency: &f64| {
            let (across, along) = together(*frequency);
            libm::hypot(across, along)
        };
        let sizes: Vec<f64> = tried.iter().map(size).collect();
        let clock = |peak: usize| {
            let (across, along) = together(tried[peak]);
            let start = first[0] + libm::atan2(across, along) / (TAU * tried[peak]);
            Self { start, period: tried[peak].recip() }
        };
        Some(peaks(&sizes).into_iter().map(clock).collect())
    }

    /// The clock near this one that the changes follow best, found from one to the next; each
    /// counts as it is known.
    fn near(self, changes: &[Change]) -> Option<Self> {
        let told = changes.iter().filter(|[before, after]| after - before <= 0.5 * self.period);
        let mut clock = self;
        // Sums of weight, number, number², instant and number × instant, against the start.
        let (mut n, mut k, mut kk, mut t, mut kt) = (0.0, 0.0, 0.0, 0.0, 0.0);
        for (place, change) in told.enumerate() {
            let weight = (change[1] - change[0]).max(f64::MIN_POSITIVE).powi(-2);
            let (number, since) =
                (clock.number(middle(change)).round(), middle(change) - self.start);
            (n, k, kk) = (n + weight, k + weight * number, kk + weight * number * number);
            (t, kt) = (t + weight * since, kt + weight * number * since);
            let spread = n * kk - k * k;
            if ENOUGH <= place + 1 && 0.0 < spread {
                clock.period = (n * kt - k * t) / spread;
                clock.start = self.start + (t - clock.period * k) / n;
            }
        }
        (0.0 < clock.period).then_some(clock)
    }

    /// True when hardly a change lies anywhere but at a tick, of those that might, and changes at
    /// any time would not.
    fn explains(&self, changes: &[Change], interval: f64) -> bool {
        let Some(mut logs) = self.at_ticks(changes, interval) else { return false };
        logs.sort_by(f64::total_cmp);
        // Start and period suit two changes at least.
        let by_accident: f64 = logs.iter().skip(2).sum();
        let looks =
            libm::log(f64::from(MOST_TICKS) * STEPS_A_CELL * count(changes.len().min(FIRST)));
        by_accident + looks < libm::log(BY_ACCIDENT)
    }

    /// Logarithms of the chances of the changes that lie at ticks to do so by accident; `None` when
    /// too many lie elsewhere, of those that might.
    fn at_ticks(&self, changes: &[Change], interval: f64) -> Option<Vec<f64>> {
        let (mut might, mut elsewhere) = (0.0, 0.0);
        let mut logs: Vec<f64> = Vec::new();
        for change in changes {
            let reach = 0.5 * (change[1] - change[0]) + SLACK * interval;
            let number = self.number(middle(change));
            let chance = (2.0 * reach / self.period).min(1.0);
            might += 1.0 - chance;
            if reach < self.period * (number - number.round()).abs() {
                elsewhere += 1.0;
            } else {
                logs.push(libm::log(chance));
            }
        }
        (elsewhere < (1.0 - AT_A_TICK) * might).then_some(logs)
    }

    /// Ticks since the start, and parts of one.
    fn number(&self, time: f64) -> f64 {
        (time - self.start) / self.period
    }

    /// Straight lines from reading to reading; after the last one its value.
    fn joined(&self, time: &[f64], values: &[f64]) -> Vec<f64> {
        let readings = self.readings(time, values);
        let at = |time: &f64| {
            let next = readings.partition_point(|reading| reading[0] <= *time);
            match (next.checked_sub(1).and_then(|last| readings.get(last)), readings.get(next)) {
                (Some([t0, v0]), Some([t1, v1])) => v0 + (v1 - v0) * (time - t0) / (t1 - t0),
                (Some([_, value]), None) | (None, Some([_, value])) => *value,
                (None, None) => f64::NAN,
            }
        };
        time.iter().map(at).collect()
    }

    /// Instant and value of every reading: that of the middle row until the next tick.
    fn readings(&self, time: &[f64], values: &[f64]) -> Vec<[f64; 2]> {
        let number = |row: usize| self.number(time[row]).floor();
        let mut readings = Vec::new();
        let mut from = 0;
        for row in 1..=time.len() {
            if row == time.len() || number(from) < number(row) {
                readings.push([
                    self.start + self.period * number(from),
                    values[usize::midpoint(from, row)],
                ]);
                from = row;
            }
        }
        readings
    }
}

/// Peaks nearly as high as any: a clock of half the period ticks at each tick, too, and one that
/// loses a tick from pass to pass hardly less often.
fn peaks(sizes: &[f64]) -> Vec<usize> {
    let highest = sizes.iter().copied().fold(0.0, f64::max);
    let size = |place: usize| sizes.get(place).copied().unwrap_or(0.0);
    let is_peak = |&at: &usize| {
        AS_HIGH * highest <= sizes[at]
            && size(at.wrapping_sub(1)) <= sizes[at]
            && size(at + 1) < sizes[at]
    };
    (0..sizes.len()).filter(is_peak).collect()
}

/// Where any of some columns has another value than in the row before.
fn changes(time: &[f64], columns: &[&Column]) -> Vec<Change> {
    let changed = |row: &usize| columns.iter().any(|values| differs(values, *row));
    (1..time.len()).filter(changed).map(|row| [time[row - 1], time[row]]).collect()
}

/// True when a column has another value than in the row before.
fn differs(values: &Column, row: usize) -> bool {
    values[row].to_bits() != values[row - 1].to_bits()
}

/// True for a log that changes where an axis moves, which rests in between, and hardly anywhere else: what follows
/// the travel then rests as well, and no instrument held it.
fn rests_with(axis: [&Column; 2], values: &Column) -> bool {
    let moves = |row: &usize| axis.iter().any(|column| differs(column, *row));
    let rows = 1..values.len();
    let steps = count(rows.clone().filter(moves).count());
    let share = steps / count(rows.len().max(1));
    let changes: Vec<usize> = rows.filter(|&row| differs(values, row)).collect();
    let with_it = count(changes.iter().filter(|row| moves(row)).count());
    let by_accident = with_it * libm::log(share);
    AT_A_TICK * steps.max(count(changes.len())) <= with_it && by_accident < libm::log(BY_ACCIDENT)
}

/// Usual interval of rows.
fn interval(time: &[f64]) -> f64 {
    let mut intervals: Vec<f64> = time.windows(2).map(|pair| pair[1] - pair[0]).collect();
    median(&mut intervals)
}

fn middle([before, after]: &Change) -> f64 {
    0.5 * (before + after)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn clock_of(time: &[f64], values: &[f64]) -> Option<Clock> {
        Clock::of(time, &[&values.to_vec().into()])
    }

    /// An axis that rests for five rows at each of forty targets.
    #[test]
    fn what_follows_an_axis_rests_with_it() {
        let place = |row: usize| count(row / 5);
        let column = |of: &dyn Fn(usize) -> f64| (0..200).map(of).collect::<Column>();
        let (steps, moving) = (column(&place), column(&count));
        let pitch = column(&|row| libm::sin(place(row)));
        let thermometer = column(&|row| truth(count(row / 7)));
        let at_each_second_target = column(&|row| truth(count(row / 10)));
        assert!(rests_with([&steps, &steps], &pitch));
        assert!(!rests_with([&steps, &steps], &thermometer));
        assert!(!rests_with([&steps, &steps], &at_each_second_target));
        assert!(!rests_with([&moving, &moving], &pitch));
    }

    /// 1200 rows at uneven instants within 900 s.
    fn instants() -> Vec<f64> {
        (0..1200).map(|i| 0.75 * (f64::from(i) + 0.4 * libm::sin(1.7 * f64::from(i)))).collect()
    }

    fn truth(time: f64) -> f64 {
        20.0 + libm::sin(time / 60.0)
    }

    fn worst(time: &[f64], values: &[f64]) -> f64 {
        time.iter().zip(values).map(|(t, v)| (v - truth(*t)).abs()).fold(0.0, f64::max)
    }

    /// A reading held for 15 s is up to 0.25 behind a slope of 1/60; a chord leaves h²/8 of the
    /// bend, 0.008, and rounding 0.005. The last reading is held as it was.
    #[test]
    fn held_readings_are_joined() {
        let time = instants();
        let round = |value: f64| (value / 0.01).round() * 0.01;
        let held: Vec<f64> = time.iter().map(|t| round(truth(15.0 * (t / 15.0).floor()))).collect();
        let clock = clock_of(&time, &held).expect("a clock");
        assert!((clock.period - 15.0).abs() < 0.02, "{clock:?}");
        let joined = clock.joined(&time, &held);
        let until = time.partition_point(|t| *t < 885.0);
        assert!(0.2 < worst(&time, &held));
        let worst = worst(&time[..until], &joined[..until]);
        assert!(worst < 0.03, "{worst}");
    }

    /// A reading every 300 s, one of which equals the last and one of which comes while the table
    /// returns, is told by six changes.
    #[test]
    fn few_readings_are_held_all_the_same() {
        let time: Vec<f64> = (0..480)
            .map(|i| 5.6 * f64::from(i) + 0.9 * libm::sin(1.7 * f64::from(i)))
            .filter(|t| !(601.0..670.0).contains(t))
            .collect();
        let levels = [20.3, 20.5, 20.7, 20.8, 20.8, 20.6, 20.4, 20.2, 20.0];
        let reading = |t: &f64| levels.iter().zip(1_u8..).find(|(_, k)| *t < 300.0 * f64::from(*k));
        let held: Vec<f64> = time.iter().map(|t| *reading(t).expect("a level").0).collect();
        let clock = clock_of(&time, &held).expect("a clock");
        assert!((clock.period - 300.0).abs() < 3.0, "{clock:?}");
    }

    /// Hours between two passes say nothing of how well a tick is known.
    #[test]
    fn a_clock_goes_on_between_passes() {
        let instant = |i: u32| {
            let pass = f64::from(i / 90);
            4.0 * f64::from(i % 90) + libm::sin(1.7 * f64::from(i)) + 3800.0 * pass
        };
        let time: Vec<f64> = (0..540).map(instant).collect();
        let held: Vec<f64> = time.iter().map(|t| truth(30.0 * (t / 30.0).floor())).collect();
        let clock = clock_of(&time, &held).expect("a clock");
        assert!((clock.period - 30.0).abs() < 0.02, "{clock:?}");
    }

    /// Changes at any time follow a clock once in 2000 logs.
    #[test]
    fn changes_at_any_time_follow_no_clock() {
        let time: Vec<f64> = (0..500).map(f64::from).collect();
        let follows = |seed: u32| {
            let at = |k: u32| {
                500.0 * f64::from((seed * 7919 + k * k * 104_729 + k * 31) % 9973) / 9973.0
            };
            let changes = 5 + seed % 20;
            let value = |t: &f64| f64::from((0..changes).filter(|k| at(*k) <= *t).sum::<u32>());
            clock_of(&time, &time.iter().map(value).collect::<Vec<_>>()).is_some()
        };
        let accidents = (0..2000).filter(|seed| follows(*seed)).count();
        assert!(accidents < 8, "{accidents}");
    }

    #[test]
    fn rounded_and_continuous_logs_follow_no_clock() {
        let time = instants();
        let of = |value: fn(f64) -> f64| time.iter().map(|t| value(*t)).collect::<Vec<_>>();
        assert!(clock_of(&time, &of(truth)).is_none(), "changes at every row");
        let rounded = of(|t| (truth(t) / 0.1).round() * 0.1);
        assert!(clock_of(&time, &rounded).is_none(), "changes where the truth crosses a step");
        assert!(clock_of(&time, &of(|_| 20.0)).is_none(), "constant");
    }
}
