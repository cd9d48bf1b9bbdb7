//! What begins anew from one row to the next: a counter of a clock, an angle after a turn, a clock that is
//! set back. The first two are counted on, where the step over their end is as long as the others; what else
//! goes back is told.

use std::ops::Range;

use helixlock_traces::Column;

use super::Understood;
use super::figures::rounded;
use crate::decide::Decisions;
use crate::error::quoted;
use crate::place::Place;
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
        let runs = runs(columns, count);
        for column in columns.iter_mut().filter(|column| column.values.len() == count) {
            match column.name.as_str() {
                "angle_rev" => self.turned_on(&mut column.values, &runs, decisions),
                "time_s" => self.tell_of_clock(&column.values, &runs, decisions),
                _ => {}
            }
        }
    }

    fn turned_on(&self, angle: &mut [f64], runs: &[Range<usize>], decisions: &mut Decisions<'_>) {
        let (mut first_run, mut first_place) = (None, None);
        for run in runs {
            let angle = &mut angle[run.clone()];
            if let Some(place) = count_turns(angle) {
                first_place.get_or_insert(run.start + place);
                // Of whole turns between runs nothing is known: they lie where the first one does.
                let apart =
                    first_run.map_or(0.0, |middle: f64| (middle - middle_of(angle)).round());
                for value in angle.iter_mut() {
                    *value = rounded(*value + apart);
                }
            }
            first_run = first_run.or(Some(middle_of(angle)).filter(|middle| middle.is_finite()));
        }
        if let Some(row) = first_place {
            let place = self.place_of("angle_rev", row);
            decisions.note(format!("the angle begins anew at {place}: counted on after a turn"));
        }
    }

    fn tell_of_clock(&self, time_s: &[f64], runs: &[Range<usize>], decisions: &mut Decisions<'_>) {
        let places = |run: &Range<usize>| {
            let back = steps::back(&time_s[run.clone()]).into_iter();
            back.map(|(at, back_s)| (run.start + at, back_s)).collect::<Vec<_>>()
        };
        let places: Vec<(usize, f64)> = runs.iter().flat_map(places).collect();
        let Some(&(at, back_s)) = places.first() else { return };
        let place = self.place_of("time_s", at);
        let usual_s = steps::usual(time_s).unwrap_or(0.0);
        let over = |whole_s: f64| steps::is_over_the_end(back_s, usual_s, whole_s);
        let index = self.index_of("time_s");
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

    fn place_of(&self, target: &str, row: usize) -> Place {
        self.grid.place(rows(self.outline)[row], self.index_of(target))
    }
}

/// Counts an angle on over the end of a turn; the first place where it begins anew, if it does.
fn count_turns(angle: &mut [f64]) -> Option<usize> {
    let usual = steps::usual(angle).filter(|usual| *usual < CLOSE_REV)?;
    let mut places = steps::back(angle);
    places.retain(|(_, back)| steps::is_over_the_end(*back, usual, 1.0));
    let places: Vec<usize> = places.into_iter().map(|(at, _)| at).collect();
    steps::unroll(angle, &places, 1.0);
    places.first().copied()
}

fn middle_of(angle: &[f64]) -> f64 {
    let low = angle.iter().copied().fold(f64::INFINITY, f64::min);
    let high = angle.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    f64::midpoint(low, high)
}

/// Rows that belong to one run and one way.
fn runs(columns: &[Column], count: usize) -> Vec<Range<usize>> {
    let tell = |name: &&Column| ["pass", "direction"].contains(&&*name.name);
    let told: Vec<&Column> = columns.iter().filter(tell).collect();
    let change = |row: &usize| {
        told.iter().any(|column| {
            let pair =
                [row - 1, *row].map(|row| column.values.get(row).map(|value| value.to_bits()));
            pair[0] != pair[1]
        })
    };
    let starts = std::iter::once(0).chain((1..count).filter(change));
    let mut bounds: Vec<usize> = starts.collect();
    bounds.push(count);
    bounds.windows(2).map(|pair| pair[0]..pair[1]).collect()
}
