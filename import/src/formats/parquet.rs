//! Parquet: columns of numbers, of instants and of words, with names.

use std::path::Path;

use helixlock_traces::parquet::{Foreign, read_foreign_parquet};

use crate::decide::Decisions;
use crate::error::{ImportError, quoted};
use crate::grid::{Cells, Grid};
use crate::place::Place;

/// Reads the columns as a grid with one row of names.
pub(crate) fn grid(bytes: &[u8], decisions: &mut Decisions<'_>) -> Result<Grid, ImportError> {
    let file = decisions.file();
    let Foreign { table, words } =
        read_foreign_parquet(bytes.to_vec(), Path::new(file)).map_err(|error| {
            let text = error.to_string();
            let (found, expected) = text
                .strip_prefix(file)
                .unwrap_or(&text)
                .trim_start_matches(": ")
                .split_once(", expected ")
                .unwrap_or((text.as_str(), "Parquet"));
            ImportError::found(Place::file(file), found.trim_start_matches("found "), expected)
        })?;
    let what = |first: &str| match first {
        "" => "no numbers".to_owned(),
        first => format!("words, first {}", quoted(first)),
    };
    let others = table.text.iter().map(|column| (column.name.clone(), what(&column.first)));
    decisions.pass_over(&others.collect::<Vec<_>>());
    let numbers =
        table.columns.iter().map(|column| (&*column.name, Cells::Numbers(&column.values)));
    let words = words.iter().map(|column| (&*column.name, Cells::Words(&column.words)));
    Grid::of_columns(file, "parquet", &numbers.chain(words).collect::<Vec<_>>())
}
