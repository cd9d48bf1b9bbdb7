//! Rows of an export: what each channel was, and when.

use super::clock::Clock;
use super::layout::{Layout, Track, is_eof};
use crate::error::{ImportError, quoted};
use crate::formats::channels::Channel;
use crate::grid::Grid;
use crate::number::{Reading, read};

/// The rows, with what was read of them.
pub(super) struct Rows<'a> {
    cells: &'a Grid,
    decimal: char,
    layout: &'a Layout,
    missing: [String; 1],
    clock: Clock,
    channels: Vec<Channel>,
    /// Last time of each track.
    last_s: Vec<f64>,
}

impl<'a> Rows<'a> {
    pub(super) fn new(cells: &'a Grid, decimal: char, layout: &'a Layout) -> Self {
        let channel = |name: &String| Channel { name: name.clone(), ..Channel::default() };
        Self {
            cells,
            decimal,
            layout,
            missing: ["NaN".to_owned()],
            clock: Clock::default(),
            channels: layout.heads.iter().map(|head| channel(&head.name)).collect(),
            last_s: vec![f64::NEG_INFINITY; layout.tracks.len()],
        }
    }

    /// Channels whose times count from the earliest, and the second since 1970 that this is.
    pub(super) fn read(mut self) -> Result<(Vec<Channel>, Option<f64>), ImportError> {
        let rows = self.layout.first..self.cells.rows();
        let mut used = rows.filter(|row| !self.cells.is_blank(*row));
        for index in 0.. {
            let Some(row) = used.next() else { break };
            if is_eof(self.cells, row) {
                break;
            }
            self.row(row, index)?;
        }
        if let Some(row) = used.next() {
            let place = self.cells.place(row, Some(0));
            let found = format!("{} below `EOF`", quoted(self.cells.cell(row, 0)));
            return Err(ImportError::found(place, found, "the end of the file"));
        }
        let times = || self.channels.iter().filter_map(|channel| channel.time_s.first());
        let first_s = times().copied().fold(f64::INFINITY, f64::min);
        let origin_s = self.clock.origin_s().map(|origin_s| origin_s + first_s);
        for time_s in self.channels.iter_mut().flat_map(|channel| &mut channel.time_s) {
            *time_s -= first_s;
        }
        Ok((self.channels, origin_s))
    }

    fn row(&mut self, row: usize, index: usize) -> Result<(), ImportError> {
        let (used, width) = (self.cells.used_width(row), self.layout.width);
        if width < used {
            let place = self.cells.place(row, Some(width));
            let found = format!("{used} cells");
            let expected = format!("up to {width}, as the names of the channels have it");
            return Err(ImportError::found(place, found, expected));
        }
        let layout = self.layout;
        for (at, track) in layout.tracks.iter().enumerate() {
            let columns = || track.values.iter().map(|(column, _)| *column).chain(track.time);
            if columns().all(|column| self.cells.cell(row, column).is_empty()) {
                continue; // a channel with longer steps than the others
            }
            let time_s = track.time.map(|time| self.time_s(row, time, at)).transpose()?;
            self.is_whole(row, track)?;
            for (column, head) in &track.values {
                if let Some(head) = *head {
                    self.value(row, (*column, head), (time_s, index))?;
                }
            }
        }
        Ok(())
    }

    fn time_s(&mut self, row: usize, column: usize, track: usize) -> Result<f64, ImportError> {
        let cell = self.cells.cell(row, column);
        let place = self.cells.place(row, Some(column));
        let Some(time_s) = self.clock.seconds(cell, self.decimal) else {
            let found = if cell.is_empty() { "an empty cell".to_owned() } else { quoted(cell) };
            return Err(ImportError::found(place, found, self.clock.expected()));
        };
        // Equal ones are let pass: a scope that fills gaps repeats what came before.
        if time_s < self.last_s[track] {
            let found = format!("{} behind a later time", quoted(cell));
            return Err(ImportError::found(place, found, "times that rise"));
        }
        self.last_s[track] = time_s;
        Ok(time_s)
    }

    /// Empty cells may end a row, and shorter channels; a time without the cells behind it does not.
    fn is_whole(&self, row: usize, track: &Track) -> Result<(), ImportError> {
        let found = self.cells.width(row);
        let wanted = 1 + track.values.last().map_or(0, |(column, _)| *column);
        if wanted <= found {
            return Ok(());
        }
        let place = self.cells.place(row, Some(found - 1));
        let cells = if found == 1 { "1 cell".to_owned() } else { format!("{found} cells") };
        let expected = format!("{wanted}, as the names of the channels have it");
        let error = ImportError::found(place, cells, expected);
        let last = (row + 1..self.cells.rows()).all(|row| self.cells.is_blank(row));
        Err(if last {
            error.hinted("the last line is cut off: was the recording stopped?")
        } else {
            error
        })
    }

    /// Reads a value; `when` is its time, or the number of its row.
    fn value(
        &mut self,
        row: usize,
        (column, head): (usize, usize),
        when: (Option<f64>, usize),
    ) -> Result<(), ImportError> {
        let cell = self.cells.cell(row, column);
        let place = || self.cells.place(row, Some(column));
        let value = match read(cell, self.decimal, &self.missing) {
            Reading::Number(value) => value,
            Reading::Missing => return Ok(()),
            Reading::Words => {
                let name = quoted(&self.channels[head].name);
                let expected = format!("a number for {name}");
                return Err(ImportError::found(place(), quoted(cell), expected));
            }
        };
        let time_s = match when {
            (Some(time_s), _) => time_s,
            (None, index) if index == self.channels[head].values.len() => {
                self.counted_s(head, index)
            }
            (None, _) => {
                let found = format!("{} below an empty cell", quoted(cell));
                let expected = "a value in every row, as no column tells the time";
                return Err(ImportError::found(place(), found, expected));
            }
        };
        self.channels[head].time_s.push(time_s);
        self.channels[head].values.push(value);
        Ok(())
    }

    fn counted_s(&self, head: usize, index: usize) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "rows are far below 2⁵³")]
        let samples = index as f64;
        samples * self.layout.heads[head].sample_time_ms.unwrap_or(1.0) / 1e3
    }
}
