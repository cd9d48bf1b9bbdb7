//! What cells mean and do not hold: numbers typed as texts, and merged cells.

use std::collections::BTreeMap;

use calamine::Dimensions;

use super::Cell;
use crate::decide::Decisions;
use crate::delimited::decide_decimal;
use crate::limits;
use crate::number::number;
use crate::recipe::Value;

/// Numbers that were typed as texts, with the decimal comma of a country, as all others stand in a grid.
pub(super) fn with_points(cells: &mut [Cell], decisions: &mut Decisions<'_>) {
    let is_number = |cell: &&Cell| {
        let marked = cell.is_text && cell.shown.contains(',');
        marked && (number(&cell.shown, ',').is_some() || number(&cell.shown, '.').is_some())
    };
    if !cells.iter().any(|cell| is_number(&cell)) {
        return;
    }
    let texts = cells.iter().filter(|cell| cell.is_text).map(|cell| cell.shown.as_str());
    decide_decimal(texts, true, decisions);
    if decisions.given("text", "decimal") != Some(&Value::Text(",".into())) {
        return;
    }
    for cell in cells.iter_mut().filter(|cell| cell.is_text) {
        if let Some(value) = number(&cell.shown, ',') {
            cell.shown = value.to_string();
        }
    }
}

/// A number in a cell merged over several rows is that of each of them, and words over several columns
/// beside others are above each of them; a title alone in its row stays where it stands.
pub(super) fn unmerge(cells: &mut Vec<Cell>, merged: &[Dimensions]) {
    across(cells, merged);
    let from_one = |index: u32| usize::try_from(index).map_or(usize::MAX, |index| index + 1);
    let last = cells.iter().map(|cell| cell.row).max().unwrap_or(0);
    let places: BTreeMap<(usize, usize), usize> =
        cells.iter().enumerate().map(|(at, cell)| ((cell.row, cell.column), at)).collect();
    for region in merged {
        let (row, column) = (from_one(region.start.0), from_one(region.start.1));
        let Some(first) = places.get(&(row, column)).map(|at| &cells[*at]) else { continue };
        if first.is_text || number(&first.shown, '.').is_none() {
            continue;
        }
        let shown = first.shown.clone();
        for row in (row + 1..=from_one(region.end.0).min(last))
            .filter(|row| !places.contains_key(&(*row, column)))
        {
            cells.push(Cell { row, column, shown: shown.clone(), is_text: false });
        }
        if limits::CELLS < cells.len() {
            return;
        }
    }
}

/// Words in a cell merged over several columns, as a heading of each.
fn across(cells: &mut Vec<Cell>, merged: &[Dimensions]) {
    let from_one = |index: u32| usize::try_from(index).map_or(usize::MAX, |index| index + 1);
    let places: BTreeMap<(usize, usize), usize> =
        cells.iter().enumerate().map(|(at, cell)| ((cell.row, cell.column), at)).collect();
    let last = cells.iter().map(|cell| cell.column).max().unwrap_or(0);
    for region in merged {
        let (row, column) = (from_one(region.start.0), from_one(region.start.1));
        let beyond = from_one(region.end.1).min(last) + 1;
        let Some(first) = places.get(&(row, column)).map(|at| &cells[*at]) else { continue };
        let outside =
            places.range((row, 0)..(row + 1, 0)).any(|((_, at), _)| *at < column || beyond <= *at);
        if !first.is_text || !outside {
            continue;
        }
        let shown = first.shown.clone();
        let empty = (column + 1..beyond).filter(|at| !places.contains_key(&(row, *at)));
        for column in empty {
            cells.push(Cell { row, column, shown: shown.clone(), is_text: true });
        }
        if limits::CELLS < cells.len() {
            return;
        }
    }
}
