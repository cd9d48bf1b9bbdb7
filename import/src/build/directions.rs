//! Directions in numbers or words of their own, 1 and 2 or CW and CCW: which of them is back, the positions show.

use std::collections::BTreeSet;

use helixlock_traces::Column;

use super::Understood;
use crate::decide::Decisions;
use crate::error::{ImportError, quoted};
use crate::runs::direction_of;
use crate::samples::rows;

/// Of the steps under one number so many go the same way, at least.
const MOST: f64 = 0.8;

impl Understood<'_> {
    /// Two words of a column, one of which at least names no direction, as 1 and 2.
    pub(super) fn two_words(&self, index: usize) -> Option<Vec<f64>> {
        let cells: Vec<&str> =
            rows(self.outline).into_iter().map(|row| self.grid.cell(row, index).trim()).collect();
        let words: BTreeSet<&str> = cells.iter().copied().filter(|cell| !cell.is_empty()).collect();
        let unknown = |word: &&str| direction_of(word).is_none() && word.parse::<f64>().is_err();
        let [one, other] = words.iter().copied().collect::<Vec<&str>>()[..] else { return None };
        let number = |cell: &str| match cell {
            cell if cell == one => 1.0,
            cell if cell == other => 2.0,
            _ => f64::NAN,
        };
        [one, other].iter().any(unknown).then(|| cells.into_iter().map(number).collect())
    }

    /// Makes them 1 and −1; refuses those that the positions do not tell.
    pub(super) fn directed(
        &self,
        columns: &mut [Column],
        decisions: &mut Decisions<'_>,
    ) -> Result<(), ImportError> {
        let values = |name: &str| columns.iter().position(|column| column.name == name);
        let Some(at) = values("direction") else { return Ok(()) };
        let found = columns[at].values.clone();
        let mut numbers: Vec<f64> =
            found.iter().copied().filter(|value| value.is_finite()).collect();
        numbers.sort_by(f64::total_cmp);
        numbers.dedup();
        let has = |number: f64| numbers.iter().any(|value| is(*value, number));
        let are_ours = numbers.iter().all(|value| value.abs() <= 1.0 && value.fract().abs() <= 0.0);
        if are_ours && (has(-1.0) || !has(0.0)) {
            return Ok(());
        }
        let path = values("position_mm").or_else(|| values("angle_rev"));
        let path = path.map_or(&[][..], |path| &columns[path].values);
        let way = |number: f64| way(&found, path, number);
        if let [one, other] = numbers[..]
            && let (Some(first), Some(second)) = (way(one), way(other))
            && !is(first, second)
        {
            let back = if first < 0.0 { one } else { other };
            let row = found.iter().position(|value| is(*value, back)).unwrap_or(0);
            let word =
                self.grid.cell(rows(self.outline)[row], self.index_of("direction").unwrap_or(0));
            decisions.note(format!("direction {} is back, as the positions go", quoted(word)));
            let ours = |value: f64| {
                if value.is_nan() {
                    value
                } else if is(value, back) {
                    -1.0
                } else {
                    1.0
                }
            };
            columns[at].values = found.into_iter().map(ours).collect();
            return Ok(());
        }
        let rests = are_ours && !path.is_empty() && way(0.0).is_none();
        if rests { Ok(()) } else { Err(self.no_direction(&found)) }
    }

    fn no_direction(&self, found: &[f64]) -> ImportError {
        let index = self.index_of("direction");
        let ours = |value: &f64| value.is_nan() || is(value.abs(), 1.0);
        let row = rows(self.outline)[found.iter().position(|value| !ours(value)).unwrap_or(0)];
        let cell = quoted(self.grid.cell(row, index.unwrap_or(0)));
        let error = ImportError::found(
            self.grid.place(row, index),
            format!("the direction {cell}, which the positions do not tell"),
            "1, -1, or a word for it",
        );
        error.hinted("`to = \"none\"` leaves the column out")
    }
}

/// The way that positions go while the direction is a number; `None` where they go both ways, or rest.
fn way(directions: &[f64], path: &[f64], number: f64) -> Option<f64> {
    let both = directions.windows(2).zip(path.windows(2));
    let steps = both.filter(|(pair, _)| pair.iter().all(|value| is(*value, number)));
    let (mut forward, mut back) = (0.0, 0.0);
    for (_, pair) in steps {
        if pair[0] < pair[1] {
            forward += 1.0;
        } else if pair[1] < pair[0] {
            back += 1.0;
        }
    }
    let all = MOST * (forward + back);
    if all <= 0.0 {
        return None;
    }
    if all <= forward { Some(1.0) } else { (all <= back).then_some(-1.0) }
}

fn is(value: f64, number: f64) -> bool {
    (value - number).abs() <= 0.0
}
