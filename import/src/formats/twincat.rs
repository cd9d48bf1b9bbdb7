//! What the scope of `TwinCAT` exports as text: a header, then a time and a value for each channel.
//!
//! Beckhoff Information System, `TE13xx`, "Export in csv": times are milliseconds from the start, or counts of
//! 100 ns since 1601 (FILETIME); every channel may have a column of time of its own.

use super::channels::{self, Channel};
use crate::decide::Decisions;
use crate::delimited;
use crate::error::{ImportError, quoted};
use crate::grid::Grid;
use crate::number::{Reading, read};
use crate::place::Place;

/// Counts of 100 ns; a millisecond offset never gets this large.
const FILETIME: f64 = 1e15;

/// True for the header of a scope.
pub(crate) fn fits(lines: &[&str]) -> bool {
    let begins = |word: &str| {
        lines.iter().take(60).any(|line| line.trim_start_matches('"').starts_with(word))
    };
    begins("Name")
        && (begins("SampleTime")
            || begins("Sample Time")
            || begins("StartRecord")
            || begins("Start of Export"))
}

/// Channels side by side.
pub(crate) fn grid(lines: &[&str], decisions: &mut Decisions<'_>) -> Result<Grid, ImportError> {
    let file = decisions.file();
    let cells = delimited::grid(lines, decisions)?;
    let decimal = decisions.text("text", "decimal", || (".".into(), String::new()));
    let decimal = if decimal == "," { ',' } else { '.' };
    let is_number = |row: usize, column: usize| {
        matches!(read(cells.cell(row, column), decimal, &[]), Reading::Number(_))
    };
    let first = (1..cells.rows()).find(|row| is_number(*row, 0) && is_number(*row, 1));
    let Some(first) = first else {
        return Err(ImportError::found(
            Place::file(file),
            "no rows of times and values",
            "an export of a TwinCAT scope",
        ));
    };
    let names = names(&cells, first);
    let mut channels: Vec<Channel> =
        names.into_iter().map(|name| Channel { name, ..Channel::default() }).collect();
    let mut origin = f64::INFINITY;
    for row in first..cells.rows() {
        if cells.is_blank(row) || cells.cell(row, 0).trim() == "EOF" {
            continue;
        }
        for (index, channel) in channels.iter_mut().enumerate() {
            let (at, value) = (2 * index, 2 * index + 1);
            let number = |column: usize| match read(cells.cell(row, column), decimal, &[]) {
                Reading::Number(number) => Ok(Some(number)),
                Reading::Missing => Ok(None),
                Reading::Words => Err(ImportError::found(
                    cells.place(row, Some(column)),
                    quoted(cells.cell(row, column)),
                    "a number",
                )),
            };
            if let (Some(time), Some(value)) = (number(at)?, number(value)?) {
                let time_s = if FILETIME < time { time * 1e-7 } else { time * 1e-3 };
                origin = origin.min(time_s);
                channel.time_s.push(time_s);
                channel.values.push(value);
            }
        }
    }
    channels.iter_mut().flat_map(|channel| &mut channel.time_s).for_each(|time| *time -= origin);
    channels::grid(channels, decisions)
}

/// Names of the channels: the last row above the data that begins with `Name`.
fn names(cells: &Grid, first: usize) -> Vec<String> {
    let count = cells.used_width(first).div_ceil(2);
    let row = (0..first).rev().find(|row| cells.cell(*row, 0).trim() == "Name");
    let name = |index: usize| {
        let own = row.map_or("", |row| cells.cell(row, 2 * index + 1));
        if own.is_empty() { format!("channel {}", index + 1) } else { own.to_owned() }
    };
    (0..count).map(name).collect()
}
