//! What begins anew from one row to the next: a counter of a clock, an angle after a turn, a clock that is
//! set back. The first two are counted on, where the step over their end is as long as the others; what else
//! goes back is told.

use helixlock_traces::Column;

use super::Understood;
use super::figures::rounded;
use crate::decide::Decisions;
use crate::error::quoted;
use crate::samples::{Holds, rows};
use crate::steps;

/// Where counters of 16 and of 32 bits end.
const COUNTERS: [(f64, &str); 2] = [(65_536.0, "2^16"), (4_294_967_296.0, "2^32")];
/// An angle is counted on where rows are closer than this, in turns.
const CLOSE_REV: f64 = 0.25;
const HOUR_S: f64 = 3_600.0;

impl Understood<'_> {
    /// A counter of a clock, counted on over its end.
    pub(super) fn counted_on(
        &self,
        index: usize,
        values: &mut [f64],
        decisions: &mut Decisions<'_>,
    ) {
        let whole = |value: &f64| value.fract().abs() <= 0.0 && 0.0 <= *value;
        let (most, usual) = (values.iter().copied().fold(0.0, f64::max), steps::usual(values));
        let end = COUNTERS.iter().find(|(end, _)| most < *end);
        let (Some((end, word)), Some(usual)) = (end, usual) else { return };
        let places = steps::back(values);
        let over = |(_, back): &(usize, f64)| steps::is_over_the_end(*back, usual, *end);
        let finite = || values.iter().filter(|value| value.is_finite());
        if places.is_empty() || !finite().all(whole) || !places.iter().all(over) {
            return;
        }
        let places: Vec<usize> = places.into_iter().map(|(at, _)| at).collect();
        let place = self.grid.place(rows(self.outline)[places[0]], Some(index));
        let name = quoted(&self.headers[index].name);
        decisions.note(format!("{name} begins anew at {place}: counted on from {word}"));
        steps::unroll(values, &places, *end);
    }

    /// An angle that begins anew within a run after a turn is counted on; a clock that goes back is told.
    pub(super) fn within_runs(&self, columns: &mut [Column], decisions: &mut Decisions<'_>) {
        let count = rows(self.outline).len();
        let bounds = boundaries(columns, count);
        for column in columns.iter_mut().filter(|column| column.values.len() == count) {
            match column.name.as_str() {
                "angle_rev" => self.turned_on(&mut column.values, &bounds, decisions),
                "time_s" => self.tell_of_clock(&column.values, &bounds, decisions),
                _ => {}
            }
        }
    }

    fn turned_on(&self, angle: &mut [f64], bounds: &[usize], decisions: &mut Decisions<'_>) {
        let Some(usual) = steps::usual(angle).filter(|usual| *usual < CLOSE_REV) else { return };
        let over = |(at, back): &(usize, f64)| {
            !bounds.contains(at) && steps::is_over_the_end(*back, usual, 1.0)
        };
        let places: Vec<usize> =
            steps::back(angle).into_iter().filter(over).map(|(at, _)| at).collect();
        let Some(first) = places.first() else { return };
        let place = self.grid.place(rows(self.outline)[*first], self.index_of("angle_rev"));
        decisions.note(format!("the angle begins anew at {place}: counted on after a turn"));
        steps::unroll(angle, &places, 1.0);
        for value in angle {
            *value = rounded(*value);
        }
    }

    fn tell_of_clock(&self, time_s: &[f64], bounds: &[usize], decisions: &mut Decisions<'_>) {
        let mut places = steps::back(time_s);
        places.retain(|(at, _)| !bounds.contains(at));
        let Some(&(at, back_s)) = places.first() else { return };
        let index = self.index_of("time_s");
        let place = self.grid.place(rows(self.outline)[at], index);
        let usual_s = steps::usual(time_s).unwrap_or(0.0);
        let over = |whole_s: f64| steps::is_over_the_end(back_s, usual_s, whole_s);
        let dated = index.is_some_and(|index| self.samples[index].holds == Holds::Instants);
        let why = if dated && over(HOUR_S) {
            "the end of summer time, which a zone with each time would tell"
        } else if dated && over(12.0 * HOUR_S) {
            "a clock of 12 hours, which `am` and `pm` would tell"
        } else {
            "rows out of order, or a clock that was set"
        };
        let often =
            if places.len() == 1 { "once".into() } else { format!("{} times", places.len()) };
        decisions
            .note(format!("the time goes back {often}, first by {back_s} s at {place}: {why}"));
    }
}

/// Rows at which another run or another way begins.
fn boundaries(columns: &[Column], count: usize) -> Vec<usize> {
    let of_runs = columns.iter().filter(|column| ["pass", "direction"].contains(&&*column.name));
    let changes = |column: &Column| {
        let pairs = column.values.iter().take(count).zip(column.values.iter().take(count).skip(1));
        let change = |(at, (one, next)): (usize, (&f64, &f64))| {
            (one.to_bits() != next.to_bits()).then_some(at + 1)
        };
        pairs.enumerate().filter_map(change).collect::<Vec<_>>()
    };
    of_runs.flat_map(changes).collect()
}
