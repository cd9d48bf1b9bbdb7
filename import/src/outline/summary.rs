//! Rows below a table that sum it up, and are no data.

use super::{Look, Looks};
use crate::number::number;
use crate::statistic;

/// How near to the mean of a column a mean is that was rounded, as part of the column's range.
const ROUNDED: f64 = 0.005;

impl Looks<'_> {
    /// The row behind the data: above the rows at the end that sum the table up, if there are any.
    pub(super) fn end(&self, body: usize) -> usize {
        let mut filled =
            (body..self.grid.rows()).rev().filter(|row| !self.grid.is_blank(*row)).peekable();
        if let Some(last) = filled.next_if(|row| self.is_mean(*row, body)) {
            return last;
        }
        filled.take_while(|row| self.sums_up(*row, body)).last().unwrap_or(self.grid.rows())
    }

    /// A word such as `Mittelwert` in a column of other things than words.
    fn sums_up(&self, row: usize, body: usize) -> bool {
        self.first_filled(row).is_some_and(|(at, cell)| {
            statistic::begins_with(cell) && self.look(self.grid.cell(body, at)) != Look::Words
        })
    }

    pub(super) fn first_filled(&self, row: usize) -> Option<(usize, &str)> {
        let mut cells = self.grid.cells_of(row).map(str::trim).enumerate();
        cells.find(|(_, cell)| !cell.is_empty())
    }

    /// A row of numbers behind a blank one, each the mean of its column.
    fn is_mean(&self, row: usize, body: usize) -> bool {
        let apart = row.checked_sub(1).is_some_and(|above| self.grid.is_blank(above));
        let numbers = |at: usize| {
            let cells = (body..row).map(move |above| self.grid.cell(above, at));
            cells.filter_map(|cell| number(cell, self.decimal))
        };
        let is_mean = |(at, cell): (usize, &str)| {
            let (mut sum, mut count, mut low, mut high) =
                (0.0, 0.0, f64::INFINITY, f64::NEG_INFINITY);
            for value in numbers(at) {
                (sum, count) = (sum + value, count + 1.0);
                (low, high) = (f64::min(low, value), f64::max(high, value));
            }
            number(cell, self.decimal).is_some_and(|value| {
                2.0 < count && low < high && (value - sum / count).abs() < ROUNDED * (high - low)
            })
        };
        apart && 1 < self.grid.width(row) && self.grid.cells_of(row).enumerate().all(is_mean)
    }
}
