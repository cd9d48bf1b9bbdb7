//! Columns of a grid as numbers.

use crate::grid::Grid;
use crate::instant::{Order, is_instant, order_of, parse};
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
