//! Tables of which a part would be lost, or taken for another column, without a word.

use std::collections::BTreeMap;
use std::ops::Range;

use super::{Look, Looks};
use crate::decide::Decisions;
use crate::error::ImportError;
use crate::recipe::Value;

/// Rows of numbers that are a table, and no remarks above one.
const TABLE: usize = 3;
/// How many times longer the table below may be, for them to matter.
const LONGER: usize = 10;

impl Looks<'_> {
    /// Refuses data above the header: a table of other columns, unless a recipe leaves them out.
    pub(super) fn check_above(
        &self,
        preamble: usize,
        data: Range<usize>,
        decisions: &Decisions<'_>,
    ) -> Result<(), ImportError> {
        let is_data = |row: &usize| {
            1 < self.count(*row, Look::Number)
                && self.count(*row, Look::Words) == 0
                && !self.grid.is_comment(*row)
        };
        let mut widths = BTreeMap::<usize, Vec<usize>>::new();
        for row in (0..preamble).filter(is_data) {
            widths.entry(self.grid.used_width(row)).or_default().push(row);
        }
        let Some((width, rows)) = widths.into_iter().max_by_key(|(_, rows)| rows.len()) else {
            return Ok(());
        };
        if rows.len() < TABLE
            || LONGER * rows.len() < data.len()
            || decisions.is_told("table", "preamble")
        {
            return Ok(());
        }
        let found = format!("{} rows of {width} numbers above another table", rows.len());
        let error = ImportError::found(self.grid.place(rows[0], None), found, "one table a file");
        Err(error.hinted(format!("`[table] preamble = {preamble}` leaves them out")))
    }

    /// Refuses whole numbers between commas below too few names: `1,5,0,2` may be 1.5 and 0.2.
    pub(super) fn check_names(
        &self,
        header: &[usize],
        data: Range<usize>,
        decisions: &Decisions<'_>,
    ) -> Result<(), ImportError> {
        let commas = decisions.given("text", "delimiter") == Some(&Value::Text(",".into()));
        let names = header.iter().map(|row| self.grid.used_width(*row)).max().unwrap_or(0);
        let rows: Vec<usize> = data.filter(|row| self.is_data(*row)).collect();
        let filled = self.filled(&rows);
        let points =
            || rows.iter().any(|row| self.grid.cells_of(*row).any(|cell| cell.contains('.')));
        if !commas
            || names == 0
            || filled <= names
            || decisions.is_told("text", "decimal")
            || points()
        {
            return Ok(());
        }
        let place = self.grid.place(rows[0], Some(names));
        let found = format!("rows of {filled} cells below {names} names");
        Err(ImportError::found(place, found, "a name for every cell").hinted(
            "are the commas decimal signs? then cells are parted by `;` or tabs; \
             `[text] decimal = \".\"` in a recipe if they are not",
        ))
    }
}
