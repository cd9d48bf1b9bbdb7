//! Parquet: columns with names, numbers only.

use std::path::Path;

use helixlock_traces::parquet::read_parquet;

use crate::error::ImportError;
use crate::grid::Grid;
use crate::place::Place;

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
    let columns: Vec<(String, &[f64])> =
        table.columns.iter().map(|column| (column.name.clone(), &*column.values)).collect();
    Grid::of_columns(file, "parquet", &columns)
}
