//! Archives of `NumPy`: a ZIP archive that has an array in each of its files.
//!
//! Format: `numpy.savez`, which gives every file the name of its array and the ending `.npy`.

use std::io::Cursor;

use zip::ZipArchive;
use zip::result::ZipError;

use super::arrays::{self, Array};
use super::npy;
use super::unpacked::Room;
use crate::decide::Decisions;
use crate::error::ImportError;
use crate::grid::Grid;
use crate::place::Place;

/// Reads the arrays as a grid with one row of names.
pub(crate) fn grid(bytes: &[u8], decisions: &mut Decisions<'_>) -> Result<Grid, ImportError> {
    let file = decisions.file();
    let refuse = |found: String, expected: &str| {
        ImportError::found(Place::file(file), found, expected.to_owned())
    };
    let broken = |error: ZipError| refuse(error.to_string(), "a whole archive of NumPy");
    let mut archive = ZipArchive::new(Cursor::new(bytes)).map_err(broken)?;
    let (mut found, mut passed_over, mut room) = (Vec::new(), Vec::new(), Room::of_an_archive());
    for index in 0..archive.len() {
        let part = archive.by_index(index).map_err(broken)?;
        let name = part.name().map_err(broken)?.into_owned();
        let Some(name) = name.strip_suffix(".npy").map(str::to_owned) else { continue };
        let data = room.unpack(part).map_err(|error| broken(error.into()))?;
        let data = data.ok_or_else(|| refuse("more numbers".to_owned(), "up to 512 MB of them"))?;
        match npy::columns(&name, &data) {
            Ok(columns) => found.extend(arrays_of(&name, columns)),
            Err(_) => passed_over.push((name, arrays::NO_NUMBERS.to_owned())),
        }
    }
    decisions.pass_over(&passed_over);
    arrays::grid("arrays", &found, decisions)
}

/// An array of all columns without a name, and of each field of records.
fn arrays_of(name: &str, columns: Vec<(String, Vec<f64>)>) -> Vec<Array> {
    let rows = columns.first().map_or(0, |(_, values)| values.len());
    let array = |name: String, values| Array { name, unit: None, rows, values };
    if columns.iter().all(|(field, _)| field.is_empty()) {
        let values = columns.into_iter().flat_map(|(_, values)| values).collect();
        return vec![array(name.to_owned(), values)];
    }
    columns.into_iter().map(|(field, values)| array(format!("{name}/{field}"), values)).collect()
}
