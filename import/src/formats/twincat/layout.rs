//! Where in an export the channels stand, and what its header says of them.

use crate::decide::Decisions;
use crate::error::{ImportError, quoted};
use crate::grid::{Delimiter, Grid};
use crate::number::number;
use crate::place::Place;

/// What stands in the first cell of the line of names, and above every column of times.
const NAME: &str = "Name";

/// A channel, as the header has it.
#[derive(Clone, Debug)]
pub(super) struct Head {
    /// With its unit, where it has one.
    pub(super) name: String,
    pub(super) sample_time_ms: Option<f64>,
    /// Text, which is no measurement.
    words: bool,
    /// The scope was told to multiply it, or to add to it.
    scaled: bool,
}

/// Channels side by side under one column of times, or one channel that has none.
#[derive(Clone, Debug)]
pub(super) struct Track {
    /// Column of the times.
    pub(super) time: Option<usize>,
    /// Columns of the values, and the head of each; none for a channel of text.
    pub(super) values: Vec<(usize, Option<usize>)>,
}

/// Columns of an export, and where its rows begin.
#[derive(Clone, Debug)]
pub(super) struct Layout {
    pub(super) heads: Vec<Head>,
    pub(super) tracks: Vec<Track>,
    /// First row behind the header.
    pub(super) first: usize,
    /// Cells of a full row.
    pub(super) width: usize,
    left_out: Vec<String>,
}

/// What parts the cells, by the line of names, and that line.
pub(super) fn delimiter(lines: &[&str]) -> Option<(Delimiter, usize)> {
    let behind = |line: &str| {
        let rest = line.strip_prefix("\"Name\"").or_else(|| line.strip_prefix(NAME))?;
        rest.chars().next().filter(|c| !c.is_alphanumeric() && !"_[\"".contains(*c))
    };
    let mut names = lines.iter().enumerate().rev();
    names.find_map(|(index, line)| Some((Delimiter::Char(behind(line)?), index + 1)))
}

impl Layout {
    /// Takes the header apart.
    pub(super) fn find(cells: &Grid, decimal: char) -> Result<Self, ImportError> {
        let names = names(cells)?;
        let is_end =
            |row: &usize| cells.is_blank(*row) || number(cells.cell(*row, 0), decimal).is_some();
        let end = (names + 1..cells.rows()).find(is_end).unwrap_or(cells.rows());
        let first = (end..cells.rows()).find(|row| !cells.is_blank(*row));
        let Some(first) = first.filter(|row| !is_eof(cells, *row)) else {
            let place = cells.place(names, None);
            return Err(ImportError::found(place, "no rows below the header", "times and values"));
        };
        let header = Header { cells, decimal, names, end };
        let width = cells.used_width(names);
        let is_time = |column: usize| cells.cell(names, column) == NAME;
        let channels: Vec<usize> = (0..width).filter(|column| !is_time(*column)).collect();
        let mut found = Self { heads: vec![], tracks: vec![], first, width, left_out: vec![] };
        let widest = (first..cells.rows()).map(|row| cells.used_width(row)).max();
        if widest == Some(channels.len()) {
            found.without_times(&header, &channels)?;
        } else {
            found.under_times(&header, &channels, is_time);
        }
        Ok(found)
    }

    /// Every channel belongs to the nearest column of times on its left.
    fn under_times(
        &mut self,
        header: &Header,
        channels: &[usize],
        is_time: impl Fn(usize) -> bool,
    ) {
        for column in channels {
            let time = (0..*column).rev().find(|left| is_time(*left));
            if self.tracks.last().is_none_or(|track| track.time != time) {
                self.tracks.push(Track { time, values: Vec::new() });
            }
            let head = self.headed(header.head(*column));
            if let Some(track) = self.tracks.last_mut() {
                track.values.push((*column, head));
            }
        }
    }

    /// Rows hold values alone: the k-th of a channel comes k sample times after its first.
    fn without_times(&mut self, header: &Header, channels: &[usize]) -> Result<(), ImportError> {
        for (at, column) in channels.iter().enumerate() {
            let head = header.head(*column);
            if head.sample_time_ms.is_none() {
                let place = header.cells.place(header.names, Some(*column));
                let found =
                    format!("no column of times, and no sample time of {}", quoted(&head.name));
                return Err(ImportError::found(place, found, "one of the two"));
            }
            let head = self.headed(head);
            self.tracks.push(Track { time: None, values: vec![(at, head)] });
        }
        self.width = channels.len();
        Ok(())
    }

    fn headed(&mut self, head: Head) -> Option<usize> {
        if head.words {
            self.left_out.push(quoted(&head.name));
            return None;
        }
        self.heads.push(head);
        Some(self.heads.len() - 1)
    }

    /// What a user should know of the header.
    pub(super) fn tell(&self, decisions: &mut Decisions<'_>) {
        if !self.left_out.is_empty() {
            decisions.note(format!("left out, as they hold text: {}", self.left_out.join(", ")));
        }
        let scaled = self.heads.iter().filter(|head| head.scaled);
        let scaled: Vec<String> = scaled.map(|head| quoted(&head.name)).collect();
        if !scaled.is_empty() {
            decisions.note(format!(
                "taken as written, as the file does not tell whether the scale and offset of the scope are in them: {}",
                scaled.join(", ")
            ));
        }
        if self.tracks.iter().all(|track| track.time.is_none()) {
            decisions.note("the file has no times: its sample times count the rows");
        }
    }
}

/// The row of the channels' names: the last of that key, for the scope's own name has it too.
fn names(cells: &Grid) -> Result<usize, ImportError> {
    let is_name = |row: &usize| cells.cell(*row, 0) == NAME;
    let below = |row: usize| (row + 1..cells.rows()).find(|row| !cells.is_blank(*row));
    let of_scope = |row: usize| below(row).is_some_and(|row| cells.cell(row, 0) == "File");
    let last = (0..cells.rows()).rev().find(is_name);
    last.filter(|row| !of_scope(*row) && 1 < cells.used_width(*row)).ok_or_else(|| {
        let place = last.map_or_else(|| cells.place(0, None), |row| cells.place(row, None));
        ImportError::found(
            Place { sheet: None, ..place },
            "no names of channels",
            "a line with `Name` and the name of each channel",
        )
    })
}

/// True for the line that ends an export.
pub(super) fn is_eof(cells: &Grid, row: usize) -> bool {
    cells.cell(row, 0) == "EOF"
}

/// Lines of the header of the channels, each with its key in front.
struct Header<'a> {
    cells: &'a Grid,
    decimal: char,
    names: usize,
    end: usize,
}

impl Header<'_> {
    fn cell(&self, key: &str, column: usize) -> &str {
        let mut rows = self.names..self.end;
        let row = rows.find(|row| self.cells.cell(*row, 0).trim_end_matches("[ms]").trim() == key);
        row.map_or("", |row| self.cells.cell(row, column))
    }

    /// A number of the header, which may have the sign of the computer where the values have a point.
    fn number(&self, key: &str, column: usize) -> Option<f64> {
        let cell = self.cell(key, column);
        number(cell, self.decimal).or_else(|| number(&cell.replace(',', "."), '.'))
    }

    fn head(&self, column: usize) -> Head {
        let unlike = |key: &str, neutral: f64| {
            self.number(key, column).is_some_and(|number| 0.0 < (number - neutral).abs())
        };
        let name = self.cell(NAME, column);
        let unit = unit(self.cell("Unit", column));
        let sample_time = self.number("SampleTime", column);
        Head {
            name: if unit.is_empty() { name.to_owned() } else { format!("{name} [{unit}]") },
            sample_time_ms: sample_time
                .or_else(|| self.number("Sample Time", column))
                .filter(|time| 0.0 < *time),
            words: self.cell("Data-Type", column).contains("STRING"),
            scaled: unlike("ScaleFactor", 1.0)
                || unlike("Offset", 0.0)
                || unlike("Unit ScaleFactor", 1.0)
                || unlike("Unit Offset", 0.0),
        }
    }
}

/// `mm` of `mm (Length)`; nothing of `(None)`.
fn unit(cell: &str) -> &str {
    cell.split('(').next().unwrap_or_default().trim()
}
