//! Periodic error of a worm as EQMOD and `PECPrep` keep it: a turn of the worm, second by second.
//!
//! `#` begins a comment, `!WormPeriod=` and `!StepsPerWorm=` say seconds and motor steps of a turn, and every
//! other line has seconds, motor position and error in seconds of arc, blanks between.
//! Format: EQMOD (`EQASCOM`), module `PEC.bas`, procedure `Export`.

use helixlock_traces::Column;

use crate::build::Built;
use crate::decide::Decisions;
use crate::error::{ImportError, quoted};
use crate::number::number;
use crate::place::Place;

/// Columns of a row.
const CELLS: [&str; 3] = ["seconds", "motor position", "error in seconds of arc"];
/// Mean time of a turn of the sky, s: what a worm's period is a part of.
const SIDEREAL_DAY_S: f64 = 86_164.1;

/// True for the words of such a file.
pub(crate) fn fits(line: &str) -> bool {
    line.starts_with("!WormPeriod") || line.starts_with("!StepsPerWorm")
}

/// Reads a curve.
pub(crate) fn read(lines: &[&str], decisions: &mut Decisions<'_>) -> Result<Built, ImportError> {
    let file = decisions.file();
    let (mut time_s, mut error) = (Vec::new(), Vec::new());
    for (index, line) in lines.iter().enumerate() {
        let place = |word: &str| Place::word(file, index + 1, line, word);
        let line = line.trim();
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        if let Some(setting) = line.strip_prefix('!') {
            setting_of(setting, place, decisions)?;
            continue;
        }
        let row = row(line, place)?;
        if time_s.last().is_some_and(|last| row[0] <= *last) {
            let found = format!("{} s behind a later second", row[0]);
            return Err(ImportError::found(place(line), found, "seconds that rise"));
        }
        time_s.push(row[0]);
        error.push(row[2]);
    }
    if time_s.len() < 2 {
        let found = format!("{} rows", time_s.len());
        return Err(ImportError::found(Place::file(file), found, "seconds, position, error"));
    }
    let columns = [("time_s", time_s), ("error_arcsec", error)];
    let columns = columns.map(|(name, values)| Column { name: name.into(), values });
    Ok(Built { columns: columns.into(), origin_s: None })
}

fn setting_of(
    setting: &str,
    place: impl Fn(&str) -> Place,
    decisions: &mut Decisions<'_>,
) -> Result<(), ImportError> {
    let Some((name, value)) = setting.split_once('=') else {
        return Err(ImportError::found(place(setting), quoted(setting), "`!Name=value`"));
    };
    let word = value.trim();
    let Some(value) = number(word, '.').filter(|value| 0.0 < *value) else {
        return Err(ImportError::found(place(word), quoted(word), "a number above 0"));
    };
    if name.trim() == "WormPeriod" {
        let order = (SIDEREAL_DAY_S / value * 100.0).round() / 100.0;
        decisions.note(format!(
            "the worm turns in {value} s: order {order} of a polar axis, for `[[gear]]` in the machine file"
        ));
    }
    Ok(())
}

fn row(line: &str, place: impl Fn(&str) -> Place) -> Result<[f64; 3], ImportError> {
    let cells: Vec<&str> = line.split([' ', '\t']).filter(|cell| !cell.is_empty()).collect();
    if cells.len() != CELLS.len() {
        let found = format!("{} cells", cells.len());
        return Err(ImportError::found(place(line), found, format!("three: {}", CELLS.join(", "))));
    }
    let mut row = [0.0; 3];
    for ((value, cell), name) in row.iter_mut().zip(&cells).zip(CELLS) {
        // Visual Basic writes the decimal sign of its country.
        let read = number(cell, '.').or_else(|| number(cell, ','));
        *value = read.ok_or_else(|| {
            ImportError::found(place(cell), format!("{} for {name}", quoted(cell)), "a number")
        })?;
    }
    Ok(row)
}
