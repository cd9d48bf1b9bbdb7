//! A table whose columns stand upright, and are not too many.

use crate::error::ImportError;
use crate::grid::Grid;
use crate::header;
use crate::limits;
use crate::outline::Outline;
use crate::samples;

/// Refuses a table that lies on its side, with its names in the first column, and too many columns.
pub(crate) fn check(grid: &Grid, outline: &Outline) -> Result<(), ImportError> {
    let rows = samples::rows(outline);
    let lies = rows.len() < outline.width;
    let place = grid.place(rows.first().copied().unwrap_or(0), None);
    let hint = "it lies on its side: turn it, so that each row is a reading";
    if limits::COLUMNS < outline.width {
        let found = match rows.len() {
            1 => format!("one row of {} columns", outline.width),
            rows => format!("{rows} rows of {} columns", outline.width),
        };
        let error = ImportError::found(place, found, format!("up to {} columns", limits::COLUMNS));
        return Err(if lies { error.hinted(hint) } else { error });
    }
    let is_name =
        |row: &usize| header::meaning(&header::read_name(grid.cell(*row, 0)).bare).is_some();
    let named = !rows.is_empty() && outline.header.is_empty() && rows.iter().all(is_name);
    if lies && named {
        let found = format!("{} rows that each begin with a name", rows.len());
        return Err(ImportError::found(place, found, "a row of names").hinted(hint));
    }
    Ok(())
}
