//! Columns of a grid as numbers.

use crate::grid::Grid;
use crate::instant::{Instant, Order, is_instant, order_of, parse};
use crate::number::{Reading, read};
use crate::outline::Outline;

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Holds {
    Nothing,
    Numbers,
    Instants,
    Words,
}

/// A column read as numbers.
#[derive(Clone, Debug)]
pub(crate) struct Samples {
    pub(crate) holds: Holds,
    /// A value for each row of data; NaN when it is missing or no number.
    pub(crate) values: Vec<f64>,
    /// The first row whose cell is no number.
    pub(crate) first_word: Option<usize>,
}

/// Reads every column.
pub(crate) fn samples(
    grid: &Grid,
    outline: &Outline,
    decimal: char,
    missing: &[String],
) -> Vec<Samples> {
    let rows: Vec<usize> = rows(outline);
    let column = |column: usize| {
        let (mut numbers, mut instants, mut words) = (0_usize, 0_usize, 0_usize);
        let mut first_word = None;
        let mut values = Vec::with_capacity(rows.len());
        for row in &rows {
            let cell = grid.cell(*row, column);
            values.push(match read(cell, decimal, missing) {
                Reading::Number(value) => {
                    numbers += 1;
                    value
                }
                Reading::Missing => f64::NAN,
                Reading::Words => {
                    first_word.get_or_insert(*row);
                    words += 1;
                    instants +=
                        usize::from(cell.contains([':', '-', '/', '.', '年']) && is_instant(cell));
                    f64::NAN
                }
            });
        }
        let holds = match (numbers, words) {
            (0, 0) => Holds::Nothing,
            _ if words < 2 * instants && numbers < instants => Holds::Instants,
            _ if words <= numbers => Holds::Numbers,
            _ => Holds::Words,
        };
        Samples { holds, values, first_word }
    };
    (0..outline.width).map(column).collect()
}

/// Rows of data, through all blocks.
pub(crate) fn rows(outline: &Outline) -> Vec<usize> {
    outline.blocks.iter().flat_map(|block| block.rows.iter().copied()).collect()
}

/// What the dates of a column begin with; `None` when day and month could be exchanged.
pub(crate) fn date_order(cells: &[&str]) -> Option<Order> {
    let told = cells.iter().find_map(|cell| order_of(cell));
    let doubtful = |cell: &&str| parse(cell, Order::Day).is_some_and(|instant| instant.ambiguous);
    match told {
        Some(order) => Some(order),
        None if cells.iter().any(doubtful) => None,
        None => Some(Order::Day),
    }
}

/// Instants of a column as seconds since midnight of the first day; rolls over at midnight where no date is
/// written. Gives the index of a cell that is no instant instead.
pub(crate) fn seconds(
    cells: &[String],
    order: Order,
    zone_min: i64,
    missing: &[String],
) -> Result<(Vec<f64>, i64), usize> {
    const DAY_S: f64 = 86_400.0;
    let mut first_day = None;
    let (mut last, mut days_s) = (f64::NAN, 0.0);
    let mut seconds = Vec::with_capacity(cells.len());
    for (index, cell) in cells.iter().enumerate() {
        if cell.trim().is_empty() || missing.iter().any(|word| word == cell) {
            seconds.push(f64::NAN);
            continue;
        }
        let instant: Instant = parse(cell, order).ok_or(index)?;
        let day = *first_day.get_or_insert(instant.day.unwrap_or(0));
        let mut second = instant.since(day, zone_min);
        if instant.day.is_none() {
            if second + days_s < last - DAY_S / 2.0 {
                days_s += DAY_S;
            }
            second += days_s;
        }
        last = second;
        seconds.push(second);
    }
    Ok((seconds, first_day.unwrap_or(0)))
}
