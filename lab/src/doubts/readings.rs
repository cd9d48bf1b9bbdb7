//! Readings that no instrument gives: copied ones, and those cut off at the end of its range.

use std::collections::BTreeMap;
use std::ops::Range;

use super::doubt::{Doubt, said_by};
use crate::measurement::{Measurement, sensor_column};
use crate::model::Problem;
use crate::numerics::{count, spread};
use crate::policy::mistakes::{
    COPIED_ROWS, CUT_OFF_ROWS, CUT_OFF_RUNS, CUT_OFF_VALUES, DIFFERENT, DOUBT, MOST_ROWS_COPIED,
    NEXT_VALUES, OFTENER_THAN_BEFORE,
};
use crate::policy::reading::JITTER_OF_TRAVEL;

/// Rounding of the difference of two numbers, a few units of the last place, against their size.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// All of them that a measurement has.
pub(super) fn of_no_instrument(problem: &Problem) -> Vec<Doubt> {
    let passes = problem.record.passes();
    let measurement = &problem.measurement;
    let mut doubts: Vec<Doubt> = copied_pass(measurement, &passes).into_iter().collect();
    doubts.extend(copied_rows(measurement, &passes));
    doubts.extend(cut_off(problem, &passes));
    doubts
}

/// What every sensor shows in a row, to the bit.
fn readings(measurement: &Measurement, row: usize) -> Vec<u64> {
    measurement.observations.values().map(|values| values[row].to_bits()).collect()
}

/// A pass whose readings are those of an earlier one, in the same order and as far as both go, or those and a constant:
/// which rows of a coarse display are by accident, as often as those of other passes.
fn copied_pass(measurement: &Measurement, passes: &[Range<usize>]) -> Option<Doubt> {
    let mut alike: BTreeMap<_, Vec<&Range<usize>>> = BTreeMap::new();
    let (first, again, apart) =
        passes.iter().filter(|rows| COPIED_ROWS <= rows.len()).find_map(|again| {
            let earlier = alike.entry(begins_with(measurement, again)).or_default();
            let mut first = earlier.iter().copied();
            let found = first.find_map(|first| {
                let copied = again.start..again.start + first.len().min(again.len());
                Some((first, copied.clone(), apart(measurement, first, &copied)?))
            });
            earlier.push(again);
            found.filter(|(_, copied, _)| {
                COPIED_ROWS <= copied.len() && DIFFERENT <= different(measurement, copied)
            })
        })?;
    let evidence = no_accident(measurement, passes, &again)?;
    let name = |rows: &Range<usize>| measurement.pass_names[measurement.pass[rows.start]];
    let (first, name) = (name(first), name(&again));
    Some(Doubt {
        what: "copy",
        evidence,
        says: match apart {
            Apart::Nothing => {
                format!("the readings of pass {name} are those of pass {first} to the last digit")
            }
            Apart::Constant => {
                format!("the readings of pass {name} are those of pass {first} and a constant")
            }
        },
        mend: format!("leave pass {name} out"),
    })
}

/// Evidence of rows that are those of another pass to the last digit, against rows that each are so as often as those
/// of any two other passes, `None` where that is not enough; without such, no oftener than every second time.
fn no_accident(
    measurement: &Measurement,
    passes: &[Range<usize>],
    copy: &Range<usize>,
) -> Option<f64> {
    let others: Vec<&Range<usize>> =
        passes.iter().filter(|rows| rows.start != copy.start).collect();
    let pairs: Vec<(usize, usize)> =
        others.windows(2).flat_map(|pair| pair[0].clone().zip(pair[1].clone())).collect();
    if pairs.is_empty() {
        return Some(said_by(copy.len()));
    }
    let alike = |(one, other): &&(usize, usize)| {
        readings(measurement, *one) == readings(measurement, *other)
    };
    let so = count(pairs.iter().filter(alike).count());
    let share = (so + 1.0) / (count(pairs.len()) + 1.0);
    let looks = count(passes.len() * passes.len());
    let evidence = -2.0 * (count(copy.len()) * libm::log(share) + libm::log(looks));
    (DOUBT < evidence).then_some(evidence)
}

/// First step of a pass, but for its rounding: a copy has the same.
fn begins_with(measurement: &Measurement, rows: &Range<usize>) -> Option<u64> {
    const ROUNDED_BITS: u32 = 24;
    let values = measurement.observations.values().next();
    let step = values.map(|values| values[rows.start + 1] - values[rows.start]);
    step.map(|step| step.to_bits() >> ROUNDED_BITS)
}

/// By what the readings of a pass are off those of another.
enum Apart {
    Nothing,
    Constant,
}

/// That of two passes, as far as the shorter goes, to within what numbers of a table are rounded by; `None` where it
/// varies.
fn apart(measurement: &Measurement, first: &Range<usize>, again: &Range<usize>) -> Option<Apart> {
    let mut by = Apart::Nothing;
    for values in measurement.observations.values() {
        let (first, again) = (&values[first.clone()], &values[again.clone()]);
        let offset = again.first()? - first.first()?;
        let is_offset = |(first, again): (&f64, &f64)| {
            let rounding = ROUNDING * (first.abs() + again.abs());
            (again - first - offset).abs() <= rounding
        };
        if !first.iter().zip(again).all(is_offset) {
            return None;
        }
        if offset != 0.0 {
            by = Apart::Constant;
        }
    }
    Some(by)
}

/// How many of the readings of a pass differ.
fn different(measurement: &Measurement, rows: &Range<usize>) -> usize {
    let mut all: Vec<_> = rows.clone().map(|row| readings(measurement, row)).collect();
    all.sort_unstable();
    all.dedup();
    all.len()
}

/// Rows that are each there as often.
fn copied_rows(measurement: &Measurement, passes: &[Range<usize>]) -> Option<Doubt> {
    if !measurement.timed {
        return None;
    }
    let same = |row: usize, before: usize| {
        let alike = |values: &[f64]| values[row].to_bits() == values[before].to_bits();
        alike(&measurement.time_s)
            && alike(&measurement.angle_rev)
            && readings(measurement, row) == readings(measurement, before)
    };
    let mut groups: Vec<(usize, usize)> = Vec::new();
    for rows in passes {
        for row in rows.clone() {
            match groups.last_mut() {
                Some((_, times)) if row != rows.start && same(row, row - 1) => *times += 1,
                _ => groups.push((row, 1)),
            }
        }
    }
    let times = groups.iter().map(|(_, times)| *times).max().filter(|times| 1 < *times)?;
    let so = groups.iter().filter(|(_, group)| *group == times).count();
    let most = MOST_ROWS_COPIED * count(groups.len()) <= count(so);
    if !most {
        return copied_on_end(measurement, &groups);
    }
    (COPIED_ROWS <= so).then(|| Doubt {
        what: "copy",
        evidence: said_by(so),
        says: format!("every row is there {times} times, to the last digit"),
        mend: "leave the copies out".to_owned(),
    })
}

/// Rows on end that are there twice while the axis moves, of `(row, how many times)`; none that come about by
/// rounding as often as elsewhere in the record.
fn copied_on_end(measurement: &Measurement, groups: &[(usize, usize)]) -> Option<Doubt> {
    let angle = |(row, _): &(usize, usize)| measurement.angle_rev[*row].to_bits();
    let goes_on = |one: &(usize, usize), next: &(usize, usize)| {
        one.1 == 2 && next.1 == 2 && angle(one) != angle(next)
    };
    let copies = groups.chunk_by(goes_on).max_by_key(|run| run.len())?;
    let twice = groups.iter().filter(|(_, times)| 1 < *times).count();
    let others = groups.len() - copies.len();
    let share = (count(twice - copies.len()) + 1.0) / (count(others) + 1.0);
    let looks = 2.0 * libm::log(count(groups.len()));
    let evidence = -2.0 * count(copies.len()) * libm::log(share) - looks;
    (COPIED_ROWS <= copies.len() && DOUBT < evidence).then(|| Doubt {
        what: "copy",
        evidence,
        says: format!(
            "{} rows on end are there twice, to the last digit, from {:.3} s on",
            copies.len(),
            measurement.time_s[copies[0].0]
        ),
        mend: "leave the copies out".to_owned(),
    })
}

/// A column whose largest or smallest reading comes again and again, elsewhere than where passes begin.
fn cut_off(problem: &Problem, passes: &[Range<usize>]) -> Vec<Doubt> {
    let measurement = &problem.measurement;
    let elsewhere = not_where_passes_begin(problem, passes);
    let mut doubts = Vec::new();
    for (sensor, values) in &measurement.observations {
        for sign in [1.0, -1.0] {
            let values: Vec<f64> = values.iter().map(|value| sign * value).collect();
            let Some((most, rows)) = upper_limit(&values, &elsewhere) else { continue };
            let (column, limit) = (sensor_column(*sensor, measurement.rotary), sign * most);
            doubts.push(Doubt {
                what: "cut-off",
                evidence: said_by(rows),
                says: format!("`{column}` is cut off at {limit}: {rows} readings are just that"),
                mend: format!("measure with a wider range, or leave rows of {limit} out"),
            });
        }
    }
    doubts
}

/// Rows at another place than the first of their pass, where readings are often set to zero.
fn not_where_passes_begin(problem: &Problem, passes: &[Range<usize>]) -> Vec<usize> {
    let places: Vec<f64> = problem.record.turns().collect();
    let near = JITTER_OF_TRAVEL * spread(&places);
    let is_elsewhere =
        |pass: &Range<usize>, row: &usize| near < (places[*row] - places[pass.start]).abs();
    passes.iter().flat_map(|pass| pass.clone().filter(|row| is_elsewhere(pass, row))).collect()
}

/// The largest value and its rows, where many are elsewhere than at the start, not all on end, and all more than those
/// of the next values: noise on a lattice has fewer of its largest, and what comes to rest does so once.
fn upper_limit(values: &[f64], elsewhere: &[usize]) -> Option<(f64, usize)> {
    let mut sorted: Vec<f64> = values.iter().copied().filter(|value| value.is_finite()).collect();
    sorted.sort_by(|a, b| b.total_cmp(a));
    let mut numbers: Vec<(f64, usize)> = Vec::new();
    for value in sorted {
        match numbers.last_mut() {
            Some((last, number)) if last.to_bits() == value.to_bits() => *number += 1,
            _ => numbers.push((value, 1)),
        }
    }
    let (&(most, rows), next) = numbers.split_first()?;
    let oftenest_next = next.iter().take(NEXT_VALUES).map(|(_, number)| *number).max()?;
    let at = |row: usize| values[row].to_bits() == most.to_bits();
    let limited: Vec<usize> = elsewhere.iter().copied().filter(|row| at(*row)).collect();
    let runs = limited.iter().filter(|row| **row == 0 || !at(**row - 1)).count();
    let cut = CUT_OFF_VALUES <= numbers.len()
        && CUT_OFF_ROWS <= limited.len()
        && CUT_OFF_RUNS <= runs
        && OFTENER_THAN_BEFORE * oftenest_next < rows;
    cut.then_some((most, rows))
}
