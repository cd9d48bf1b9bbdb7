//! Parquet: columns with names, numbers only.

use std::path::Path;

use helixlock_traces::parquet::read_parquet;

use crate::error::{ImportError, Place};
use crate::grid::Grid;
use crate::limits;

/// Reads the columns as a grid with one row of names.
pub(crate) fn grid(file: &str, bytes: &[u8]) -> Result<Grid, ImportError> {
    let table = read_parquet(bytes.to_vec(), Path::new(file)).map_err(|error| {
        let text = error.to_string();
        let (found, expected) = text
            .strip_prefix(file)
            .unwrap_or(&text)
            .trim_start_matches(": ")
            .split_once(", expected ")
            .unwrap_or((text.as_str(), "Parquet"));
        ImportError::found(Place::file(file), found.trim_start_matches("found "), expected)
    })?;
    if limits::CELLS < table.rows().saturating_mul(table.columns.len()) {
        return Err(ImportError::found(
            Place::file(file),
            "more cells",
            format!("up to {}", limits::CELLS),
        ));
    }
    let mut grid = Grid::of_sheet(file, "parquet");
    grid.start_row(1, false);
    for (index, name) in table.names().enumerate() {
        grid.push(name, index + 1)?;
    }
    for row in 0..table.rows() {
        grid.start_row(row + 2, false);
        for (index, column) in table.columns.iter().enumerate() {
            let value = column.values[row];
            grid.push(&if value.is_nan() { String::new() } else { value.to_string() }, index + 1)?;
        }
    }
    Ok(grid)
}
