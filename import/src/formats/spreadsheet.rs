//! Workbooks of Excel and `LibreOffice`: a sheet as a grid.

mod meant;

use std::io::Cursor;

use calamine::{Data, DataRef, ExcelDateTime, Reader, Sheets, open_workbook_auto_from_rs};

use crate::decide::Decisions;
use crate::error::ImportError;
use crate::grid::Grid;
use crate::limits;
use crate::place::Place;
use crate::question::Answer;
use crate::recipe::Value;
use meant::{unmerge, with_points};

/// A cell that is not empty: row and column from 1, what it shows, and whether that is a text.
struct Cell {
    row: usize,
    column: usize,
    shown: String,
    is_text: bool,
}

/// Reads the sheet that the recipe names, or the one with the most cells.
pub(crate) fn grid(bytes: &[u8], decisions: &mut Decisions<'_>) -> Result<Grid, ImportError> {
    let file = decisions.file();
    let broken = |error: calamine::Error| {
        let found = format!("a workbook that cannot be opened ({error})");
        ImportError::found(Place::file(file), found, "an xlsx, ods or xls workbook")
    };
    guard(file, bytes)?;
    let mut book = open_workbook_auto_from_rs(Cursor::new(bytes.to_vec())).map_err(broken)?;
    let names = book.sheet_names();
    let chosen = match decisions.given("sheet", "name") {
        Some(Value::Text(name)) => Some(name.clone()),
        _ => None,
    };
    if let Some(name) = chosen.as_ref().filter(|name| !names.contains(name)) {
        let expected = format!("one of `{}`", names.join("`, `"));
        return Err(ImportError::found(Place::file(file), format!("no sheet `{name}`"), expected));
    }
    let wanted = names.iter().filter(|name| chosen.as_ref().is_none_or(|chosen| chosen == *name));
    let mut sheets: Vec<(String, Vec<Cell>)> = Vec::new();
    for name in wanted {
        let cells = cells(&mut book, name, file)?;
        sheets.push((name.clone(), cells));
    }
    choose(&sheets, decisions);
    let best = sheets
        .into_iter()
        .reduce(|best, next| if best.1.len() < next.1.len() { next } else { best });
    let Some((name, mut cells)) = best.filter(|(_, cells)| !cells.is_empty()) else {
        return Err(ImportError::found(
            Place::file(file),
            "empty sheets",
            "a table of measured data",
        ));
    };
    with_points(&mut cells, decisions);
    to_grid(file, &name, cells)
}

/// Writes down which sheet is read; asks when another one is about as full.
fn choose(sheets: &[(String, Vec<Cell>)], decisions: &mut Decisions<'_>) {
    let Some(most) = sheets.iter().map(|(_, cells)| cells.len()).max() else { return };
    let rivals: Vec<&String> = sheets
        .iter()
        .filter(|(_, cells)| most < 2 * cells.len() && 8 < cells.len())
        .map(|(name, _)| name)
        .collect();
    if 1 < rivals.len() {
        let answer = |name: &&String| Answer {
            label: format!("sheet `{name}`"),
            recipe: format!("[sheet]\nname = {}", toml_edit::Value::from(name.as_str())),
        };
        decisions
            .question("several sheets hold about as much", rivals.iter().map(answer).collect());
    }
    let best =
        sheets.iter().reduce(|best, next| if best.1.len() < next.1.len() { next } else { best });
    let Some((name, _)) = best else { return };
    decisions.text("sheet", "name", || (name.clone(), format!("the fullest of {}", sheets.len())));
}

fn cells(
    book: &mut Sheets<Cursor<Vec<u8>>>,
    name: &str,
    file: &str,
) -> Result<Vec<Cell>, ImportError> {
    let mut cells = Vec::new();
    let broken = |error: String| {
        let mut place = Place::file(file);
        place.sheet = Some(name.to_owned());
        ImportError::found(place, format!("a sheet that cannot be read ({error})"), "cells")
    };
    let too_many = || {
        let found =
            ImportError::found(Place::file(file), "more cells", format!("up to {}", limits::CELLS));
        Err(found)
    };
    if let Sheets::Xlsx(book) = book {
        let merged =
            book.merge_cells_by_sheet_name(name).map_err(|error| broken(error.to_string()))?;
        let mut reader =
            book.worksheet_cells_reader(name).map_err(|error| broken(error.to_string()))?;
        while let Some(cell) = reader.next_cell().map_err(|error| broken(error.to_string()))? {
            let (row, column) = cell.get_position();
            let is_text = matches!(cell.get_value(), DataRef::String(_) | DataRef::SharedString(_));
            push(&mut cells, (row, column), shown_ref(cell.get_value()), is_text);
            if limits::CELLS < cells.len() {
                return too_many();
            }
        }
        unmerge(&mut cells, &merged);
        return if limits::CELLS < cells.len() { too_many() } else { Ok(cells) };
    }
    let range = book.worksheet_range(name).map_err(|error| broken(error.to_string()))?;
    let (top, left) = range.start().unwrap_or_default();
    for (row, column, value) in range.used_cells() {
        let at = |first: u32, offset: usize| {
            first.saturating_add(u32::try_from(offset).unwrap_or(u32::MAX))
        };
        let is_text = matches!(value, Data::String(_));
        push(&mut cells, (at(top, row), at(left, column)), shown(value), is_text);
    }
    Ok(cells)
}

fn push(cells: &mut Vec<Cell>, (row, column): (u32, u32), shown: String, is_text: bool) {
    let from_one = |index: u32| usize::try_from(index).map_or(usize::MAX, |index| index + 1);
    if !shown.is_empty() {
        cells.push(Cell { row: from_one(row), column: from_one(column), shown, is_text });
    }
}

/// Rows without a cell are left out; they count for nothing.
fn to_grid(file: &str, name: &str, mut cells: Vec<Cell>) -> Result<Grid, ImportError> {
    cells.sort_by_key(|cell| (cell.row, cell.column));
    let left = cells.iter().map(|cell| cell.column).min().unwrap_or(1);
    let mut grid = Grid::of_sheet(file, name);
    let mut last_row = 0;
    let mut next = left;
    for Cell { row, column, shown, .. } in cells {
        if limits::COLUMNS < column {
            let mut place = Place::line(file, row);
            (place.at.column, place.sheet) = (Some(column), Some(name.to_owned()));
            return Err(ImportError::found(
                place,
                "a cell",
                format!("cells in the first {} columns", limits::COLUMNS),
            ));
        }
        if row != last_row {
            if 0 < last_row && last_row + 1 < row {
                grid.start_row(last_row + 1, false);
            }
            grid.start_row(row, false);
            (last_row, next) = (row, left);
        }
        for empty in next..column {
            grid.push("", empty)?;
        }
        grid.push(shown.trim(), column)?;
        next = column + 1;
    }
    Ok(grid)
}

fn shown(value: &Data) -> String {
    match value {
        Data::Empty => String::new(),
        Data::String(text) | Data::DateTimeIso(text) | Data::DurationIso(text) => text.clone(),
        Data::Int(whole) => whole.to_string(),
        Data::Float(number) => number.to_string(),
        Data::Bool(truth) => truth.to_string(),
        Data::Error(error) => error.to_string(),
        Data::DateTime(instant) => date(instant),
    }
}

fn shown_ref(value: &DataRef<'_>) -> String {
    match value {
        DataRef::SharedString(text) => (*text).to_owned(),
        value => shown(&Data::from(value.clone())),
    }
}

/// An instant of the calendar, a time of day where there is no date, or the seconds of a duration.
fn date(instant: &ExcelDateTime) -> String {
    const DAY_S: f64 = 86_400.0;
    if instant.is_duration() {
        return (instant.as_f64() * DAY_S).to_string();
    }
    let (year, month, day, hour, minute, second, milli) = instant.to_ymd_hms_milli();
    let time = format!("{hour:02}:{minute:02}:{second:02}.{milli:03}");
    let is_dated = 1.0 <= instant.as_f64();
    if is_dated { format!("{year:04}-{month:02}-{day:02} {time}") } else { time }
}

/// Refuses archives that unpack to more than a measurement can be, before anything is built of them.
fn guard(file: &str, bytes: &[u8]) -> Result<(), ImportError> {
    if !bytes.starts_with(b"PK") {
        return Ok(());
    }
    let broken = |error: &dyn std::fmt::Display| {
        ImportError::found(Place::file(file), format!("a broken archive ({error})"), "a workbook")
    };
    let mut archive = zip::ZipArchive::new(Cursor::new(bytes)).map_err(|error| broken(&error))?;
    let mut left = limits::UNPACKED;
    for index in 0..archive.len() {
        let mut entry = archive.by_index(index).map_err(|error| broken(&error))?;
        let mut counter = Repeats::default();
        let size = copy_bounded(&mut entry, &mut counter, left).map_err(|error| broken(&error))?;
        if left <= size {
            let expected = format!("up to {} bytes", limits::UNPACKED);
            return Err(ImportError::found(
                Place::file(file),
                "an archive that unpacks to more",
                expected,
            ));
        }
        left -= size;
        if counter.cells > limits::CELLS {
            let found = ImportError::found(
                Place::file(file),
                "repeated cells that fill more",
                format!("up to {} cells", limits::CELLS),
            );
            return Err(found);
        }
    }
    Ok(())
}

fn copy_bounded(
    from: &mut impl std::io::Read,
    into: &mut Repeats,
    most: usize,
) -> std::io::Result<usize> {
    let mut buffer = vec![0; 1 << 16];
    let mut total = 0;
    while total < most {
        let count = from.read(&mut buffer)?;
        if count == 0 {
            break;
        }
        total += count;
        into.look(&buffer[..count]);
    }
    Ok(total)
}

/// What repetitions in `OpenDocument` would unfold to.
#[derive(Default)]
struct Repeats {
    tag: Vec<u8>,
    open: bool,
    rows: usize,
    row_cells: usize,
    cells: usize,
}

impl Repeats {
    fn look(&mut self, bytes: &[u8]) {
        const LONGEST: usize = 4096;
        for byte in bytes {
            match byte {
                b'<' => {
                    self.tag.clear();
                    self.open = true;
                }
                b'>' if self.open => {
                    self.open = false;
                    self.finish();
                }
                byte if self.open && self.tag.len() < LONGEST => self.tag.push(*byte),
                _ => {}
            }
        }
    }

    fn finish(&mut self) {
        let tag = String::from_utf8_lossy(&self.tag).into_owned();
        let repeat = |name: &str| {
            let rest = tag.split(name).nth(1)?.strip_prefix("=\"")?;
            rest.split('"').next()?.parse::<usize>().ok()
        };
        if tag.starts_with("table:table-row") {
            self.rows = repeat("number-rows-repeated").unwrap_or(1);
            self.row_cells = 0;
        } else if tag.starts_with("table:table-cell") && tag.contains("office:value") {
            self.row_cells =
                self.row_cells.saturating_add(repeat("number-columns-repeated").unwrap_or(1));
        } else if tag.starts_with("/table:table-row") {
            self.cells = self.cells.saturating_add(self.rows.saturating_mul(self.row_cells));
        }
    }
}
