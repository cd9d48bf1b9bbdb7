//! Arrays with names, as MATLAB and HDF5 hold them: those of one length are the columns of a table.

use std::collections::BTreeMap;

use crate::decide::Decisions;
use crate::error::ImportError;
use crate::grid::{Cells, Grid};
use crate::place::Place;
use crate::question::Answer;
use crate::recipe::Value;

/// What an array holds that is passed over.
pub(crate) const NO_NUMBERS: &str = "no numbers";

/// Numbers with a name, column by column.
pub(crate) struct Array {
    pub(crate) name: String,
    /// Its unit, where the file tells it beside the name.
    pub(crate) unit: Option<String>,
    pub(crate) rows: usize,
    pub(crate) values: Vec<f64>,
}

/// Rows and columns of an array: one that lies stands up, and further dimensions are of length 1.
///
/// `None` for more dimensions, which are no columns.
pub(crate) fn upright(shape: &[usize]) -> Option<(usize, usize)> {
    let long: Vec<usize> = shape.iter().copied().filter(|length| *length != 1).collect();
    match long[..] {
        [] => Some((1, 1)),
        [rows] => Some((rows, 1)),
        [rows, columns] => Some((rows, columns)),
        _ => None,
    }
}

/// Arrays of the length that the recipe names, or of the one that most numbers are in.
pub(crate) fn grid(
    sheet: &str,
    arrays: &[Array],
    decisions: &mut Decisions<'_>,
) -> Result<Grid, ImportError> {
    let file = decisions.file();
    let mut numbers: BTreeMap<usize, usize> = BTreeMap::new();
    for array in arrays.iter().filter(|array| 1 < array.rows) {
        *numbers.entry(array.rows).or_default() += array.values.len();
    }
    let rows = chosen(&numbers, decisions);
    let of_length = |array: &&Array| Some(array.rows) == rows;
    let chosen: Vec<&Array> = arrays.iter().filter(of_length).collect();
    let Some(rows) = rows.filter(|_| !chosen.is_empty()) else {
        let found = format!("{} arrays, none of several numbers of that length", arrays.len());
        return Err(ImportError::found(Place::file(file), found, "columns of measured data"));
    };
    let left_out: Vec<&str> =
        arrays.iter().filter(|array| !of_length(array)).map(|array| &*array.name).collect();
    if !left_out.is_empty() {
        let (number, first) = (left_out.len(), left_out[0]);
        decisions.note(format!("{number} arrays of another length are left out, first `{first}`"));
    }
    let named = chosen.iter().map(|array| (array, short_name(&array.name, &chosen)));
    let columns: Vec<(String, &[f64])> =
        named.flat_map(|(array, name)| array.columns(name, rows)).collect();
    let columns = columns.iter().map(|(name, values)| (&**name, Cells::Numbers(values)));
    Grid::of_columns(file, sheet, &columns.collect::<Vec<_>>())
}

/// A name without the groups that it stands in, where no other has the same.
fn short_name(name: &str, all: &[&Array]) -> String {
    let last = |name: &str| name.rsplit('/').next().unwrap_or_default().to_owned();
    let short = last(name);
    let alike = all.iter().filter(|other| last(&other.name) == short).count();
    if alike == 1 { short } else { name.replace('/', " ") }
}

impl Array {
    /// A column each, numbered where there are several.
    fn columns(&self, name: String, rows: usize) -> impl Iterator<Item = (String, &[f64])> {
        let many = rows < self.values.len();
        self.values.chunks(rows).enumerate().map(move |(index, values)| {
            let number = if many { format!(" {}", index + 1) } else { String::new() };
            let unit = self.unit.as_ref().map_or(String::new(), |unit| format!(" [{unit}]"));
            (format!("{name}{number}{unit}"), values)
        })
    }
}

/// The length of the columns; asks where another one has half as many numbers.
fn chosen(numbers: &BTreeMap<usize, usize>, decisions: &mut Decisions<'_>) -> Option<usize> {
    if let Some(Value::Whole(rows)) = decisions.given("arrays", "rows") {
        return usize::try_from(*rows).ok();
    }
    let (rows, most) = numbers.iter().max_by_key(|(_, numbers)| **numbers)?;
    let rivals: Vec<usize> =
        numbers.iter().filter(|(_, one)| *most < 2 * **one).map(|(rows, _)| *rows).collect();
    if 1 < rivals.len() {
        let answer = |rows: &usize| Answer {
            label: format!("arrays of {rows} numbers"),
            recipe: format!("[arrays]\nrows = {rows}"),
        };
        let text = "arrays of several lengths hold about as much";
        decisions.question(text, rivals.iter().map(answer).collect());
    }
    Some(*rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arrays_that_lie_stand_up() {
        assert_eq!(upright(&[1, 5]), Some((5, 1)));
        assert_eq!(upright(&[5, 1]), Some((5, 1)));
        assert_eq!(upright(&[5]), Some((5, 1)));
        assert_eq!(upright(&[5, 3]), Some((5, 3)));
        assert_eq!(upright(&[1, 1]), Some((1, 1)));
        assert_eq!(upright(&[2, 3, 4]), None);
    }
}
