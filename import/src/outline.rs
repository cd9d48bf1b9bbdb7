//! Where in a grid the header stands, and where the rows of data are.

mod refused;
mod summary;

use std::ops::Range;

use crate::decide::Decisions;
use crate::error::{ImportError, quoted};
use crate::grid::Grid;
use crate::header;
use crate::instant::is_instant;
use crate::number::{MISSING, Reading, read};
use crate::place::Place;
use crate::recipe::Value;
use crate::runs;

/// Rows of names and units, and stretches of rows of data.
#[derive(Clone, Debug)]
pub(crate) struct Outline {
    /// Rows of the header, from the top.
    pub(crate) header: Vec<usize>,
    /// Rows of data, block by block, with the heading of each.
    pub(crate) blocks: Vec<Block>,
    /// Rows above the header.
    pub(crate) preamble: Vec<usize>,
    /// Cells of a full row.
    pub(crate) width: usize,
}

/// Rows of data without an interruption.
#[derive(Clone, Debug, Default)]
pub(crate) struct Block {
    /// What stands above it: `Run 2`, `rückwärts`; empty for a blank line.
    pub(crate) heading: String,
    /// Its rows.
    pub(crate) rows: Vec<usize>,
}

/// How a cell looks, without knowing its column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Look {
    Blank,
    Number,
    Words,
}

/// Finds preamble, header and data.
pub(crate) fn outline(
    grid: &Grid,
    decimal: char,
    decisions: &mut Decisions<'_>,
) -> Result<Outline, ImportError> {
    let looks = Looks { grid, decimal };
    let Some(found) = looks.find() else {
        let place = Place::file(decisions.file());
        return Err(ImportError::found(place, "no rows of numbers", "a table of measured data"));
    };
    let first = match decisions.given("table", "header") {
        Some(Value::Whole(told)) if found.header == 0 => looks.told_header(&found, *told),
        _ => found.first,
    };
    let preamble = decisions.whole("table", "preamble", || (first, looks.preamble_reason(first)));
    let header = decisions.whole("table", "header", || {
        let reason = match found.header {
            0 => "no row of words stands above the numbers",
            1 => "one row of words stands above the numbers",
            _ => "rows of names and units stand above the numbers",
        };
        (found.header, reason.to_owned())
    });
    let filled: Vec<usize> = (preamble..grid.rows())
        .filter(|row| !grid.is_blank(*row) && (header > 0 || !grid.is_comment(*row)))
        .take(header)
        .collect();
    let body = filled.last().map_or(preamble, |last| last + 1);
    let end = looks.end(body);
    if end < grid.rows() {
        let first = quoted(looks.first_filled(end).map_or("", |(_, cell)| cell));
        decisions.note(format!("left out below the table, from {first} on: it sums the table up"));
    }
    looks.check_above(preamble, body..end, decisions)?;
    looks.check_names(&filled, body..end, decisions)?;
    let blocks = looks.blocks(body..end, &found, &filled)?;
    Ok(Outline { header: filled, blocks, preamble: (0..preamble).collect(), width: found.width })
}

struct Looks<'a> {
    grid: &'a Grid,
    decimal: char,
}

struct Found {
    /// First row of the header, or of the data.
    first: usize,
    header: usize,
    width: usize,
    /// Cells of a row, with the empty ones behind the last column.
    cells: usize,
}

impl Looks<'_> {
    fn look(&self, cell: &str) -> Look {
        let missing = |cell: &str| MISSING.iter().any(|word| word.eq_ignore_ascii_case(cell));
        match read(cell, self.decimal, &[]) {
            Reading::Missing => Look::Blank,
            Reading::Number(_) => Look::Number,
            Reading::Words if missing(cell) => Look::Blank,
            Reading::Words if is_instant(cell) => Look::Number,
            Reading::Words => Look::Words,
        }
    }

    fn count(&self, row: usize, look: Look) -> usize {
        self.grid.cells_of(row).filter(|cell| self.look(cell) == look).count()
    }

    /// True for a row in which numbers, dates and empty cells prevail.
    fn is_data(&self, row: usize) -> bool {
        let (numbers, words) = (self.count(row, Look::Number), self.count(row, Look::Words));
        0 < numbers && words <= 2 * numbers && !self.grid.is_comment(row)
    }

    fn find(&self) -> Option<Found> {
        let mut widths = std::collections::BTreeMap::<usize, usize>::new();
        let data: Vec<usize> = (0..self.grid.rows()).filter(|row| self.is_data(*row)).collect();
        for row in &data {
            *widths.entry(self.grid.width(*row)).or_default() += 1;
        }
        let cells = *widths.iter().max_by_key(|(width, rows)| (**rows, **width))?.0;
        let wide: Vec<usize> =
            data.into_iter().filter(|row| self.grid.width(*row) == cells).collect();
        // Behind a separator at the end of every row stands no column, unless it has a name.
        let last = wide.iter().map(|row| self.grid.used_width(*row)).max()?;
        let kinds = self.kinds(&wide, last);
        let fits = |row: usize| {
            (0..last).all(|at| {
                kinds[at] != Look::Number || self.look(self.grid.cell(row, at)) != Look::Words
            })
        };
        let first = wide.iter().copied().find(|row| fits(*row) && !self.numbers_runs(*row))?;
        let header = self.header_above(first, (last, self.filled(&wide)), &kinds);
        let top = header.first().copied().unwrap_or_else(|| wide[0].min(first));
        let named = header.iter().any(|row| last < self.grid.used_width(*row));
        let width = if named { cells } else { last };
        Some(Found { first: top, header: header.len(), width, cells })
    }

    /// Cells up to the last that is filled, in most rows: spreadsheets write empty ones behind them.
    fn filled(&self, rows: &[usize]) -> usize {
        let mut widths = std::collections::BTreeMap::<usize, usize>::new();
        for row in rows {
            *widths.entry(self.grid.used_width(*row)).or_default() += 1;
        }
        widths.into_iter().max_by_key(|(_, rows)| *rows).map_or(0, |(width, _)| width)
    }

    /// What prevails in each column.
    fn kinds(&self, rows: &[usize], width: usize) -> Vec<Look> {
        const SAMPLE: usize = 500;
        let step = rows.len().div_ceil(SAMPLE).max(1);
        let kind = |at: usize| {
            let looks = rows.iter().step_by(step).map(|row| self.look(self.grid.cell(*row, at)));
            let (numbers, words) = looks.fold((0, 0), |(numbers, words), look| match look {
                Look::Number => (numbers + 1, words),
                Look::Words => (numbers, words + 1),
                Look::Blank => (numbers, words),
            });
            if words <= numbers && 0 < numbers { Look::Number } else { Look::Words }
        };
        (0..width).map(kind).collect()
    }

    /// Rows of names, units and groups right above the data, from the top.
    ///
    /// `widths` are the cells of a row, and those up to the last that most rows fill.
    fn header_above(&self, first: usize, widths: (usize, usize), kinds: &[Look]) -> Vec<usize> {
        const MOST: usize = 3;
        let mut header = Vec::new();
        for row in (0..first).rev() {
            if self.grid.is_blank(row) && header.is_empty() || self.is_rule(row) {
                continue;
            }
            let names = self.is_names(row, widths, kinds) || self.numbers_runs(row);
            if header.len() == MOST || !names || self.is_repeated(row, &header) {
                // A broken row of data right under the header is data.
                if header.is_empty() && self.grid.used_width(row) == widths.0 && self.has_digit(row)
                {
                    continue;
                }
                break;
            }
            header.insert(0, row);
            let units = header::is_units(self.grid, row);
            if !units
                && !self.group_above(row, widths.0)
                && !self.is_below_names(row, widths, kinds)
            {
                break;
            }
        }
        header
    }

    /// Where a header begins that only a recipe knows for one: so many rows of words, right above the data.
    fn told_header(&self, found: &Found, rows: i64) -> usize {
        let is_wide = |row: &usize| {
            let used = self.grid.used_width(*row);
            found.width <= 2 * used && used <= 2 * self.count(*row, Look::Words)
        };
        let filled = (0..found.first).rev().filter(|row| !self.grid.is_blank(*row));
        let above = filled.take(usize::try_from(rows).unwrap_or(0)).take_while(is_wide);
        above.last().unwrap_or(found.first)
    }

    fn has_digit(&self, row: usize) -> bool {
        !self.grid.is_comment(row) && 0 < self.count(row, Look::Number)
    }

    fn is_repeated(&self, row: usize, header: &[usize]) -> bool {
        header.iter().any(|other| self.grid.cells_of(row).eq(self.grid.cells_of(*other)))
    }

    /// Words in place of numbers, over about the width of the table.
    fn is_names(&self, row: usize, (width, filled): (usize, usize), kinds: &[Look]) -> bool {
        let used = self.grid.used_width(row);
        let words = self.count(row, Look::Words);
        let numbers: Vec<f64> = self
            .grid
            .cells_of(row)
            .filter_map(|cell| crate::number::number(cell, self.decimal))
            .collect();
        let counting = numbers.windows(2).all(|pair| (0.0..=1.0).contains(&(pair[1] - pair[0])));
        let counted = numbers.iter().all(|number| number.fract() <= 0.0 && *number < 1000.0);
        let wide = used <= width + 1 && filled <= used.max(1) * 2 && (1 < used || filled == 1);
        let differs = (0..width).any(|at| {
            kinds[at] == Look::Number && self.look(self.grid.cell(row, at)) == Look::Words
        });
        wide && 0 < words && differs && counting && counted
    }

    /// True when a cell of the row is a unit of the name above it, as `ms` below `Time`, while others are names.
    fn is_below_names(&self, row: usize, widths: (usize, usize), kinds: &[Look]) -> bool {
        let Some(above) = row.checked_sub(1) else { return false };
        let is_unit = |at| header::is_unit_of(self.grid.cell(above, at), self.grid.cell(row, at));
        self.is_names(above, widths, kinds) && (0..widths.0).any(is_unit)
    }

    /// True when the row above groups columns, such as `Run 1` over two directions.
    fn group_above(&self, row: usize, width: usize) -> bool {
        let Some(above) = row.checked_sub(1) else { return false };
        let cells = self.grid.cells_of(above).filter(|cell| !cell.is_empty());
        2 < width && 1 < cells.filter(|cell| runs::run_of(cell).is_some()).count()
    }

    /// True for numbers of runs below a row that groups them, `forward` and `backward` over 1 to 5 each:
    /// no reading, as nothing stands where its target would.
    fn numbers_runs(&self, row: usize) -> bool {
        let mut cells = self.grid.cells_of(row);
        let empty = cells.next().is_some_and(str::is_empty);
        let numbers: Vec<&str> = cells.filter(|cell| !cell.is_empty()).collect();
        let numbers: Option<Vec<u16>> = numbers.iter().map(|cell| cell.parse().ok()).collect();
        let Some(numbers) = numbers.filter(|numbers| 1 < numbers.len()) else { return false };
        let counted = numbers.windows(2).all(|pair| [numbers[0], pair[0] + 1].contains(&pair[1]));
        empty && numbers[0] <= 1 && counted && self.group_above(row, self.grid.width(row))
    }

    /// A line of dashes, as under the header of a Markdown table.
    fn is_rule(&self, row: usize) -> bool {
        let mut cells = self.grid.cells_of(row).peekable();
        cells.peek().is_some()
            && cells.all(|cell| cell.chars().all(|c| "-=:+_".contains(c)))
            && self.grid.cells_of(row).any(|cell| 1 < cell.len())
    }

    fn preamble_reason(&self, rows: usize) -> String {
        if rows == 0 {
            return "the header comes first".to_owned();
        }
        let first = (0..rows).find(|row| !self.grid.is_blank(*row)).unwrap_or(0);
        let lines = if rows == 1 { "line" } else { "lines" };
        format!("{rows} {lines} above the table, from {}", quoted(self.grid.cell(first, 0)))
    }

    /// Rows of data, and what interrupts them.
    fn blocks(
        &self,
        body: Range<usize>,
        found: &Found,
        header: &[usize],
    ) -> Result<Vec<Block>, ImportError> {
        let mut blocks = vec![Block { heading: self.heading_above(header), rows: Vec::new() }];
        let mut pending: Option<String> = None;
        for row in body {
            if self.is_separator(row, header) {
                let text: Vec<&str> =
                    self.grid.cells_of(row).filter(|cell| !cell.is_empty()).collect();
                let repeat = header
                    .iter()
                    .any(|known| self.grid.cells_of(*known).eq(self.grid.cells_of(row)));
                let heading = pending.get_or_insert_default();
                if !repeat && !self.is_rule(row) {
                    heading.push_str(&text.join(" "));
                }
                continue;
            }
            if self.grid.is_comment(row) {
                continue;
            }
            let last = blocks.last_mut().expect("one is there from the start");
            match pending.take() {
                Some(heading) if last.rows.is_empty() => last.heading.push_str(&heading),
                Some(heading) => blocks.push(Block { heading, rows: Vec::new() }),
                None => {}
            }
            self.check_width(row, found)?;
            blocks.last_mut().expect("one is there from the start").rows.push(row);
        }
        blocks.retain(|block| !block.rows.is_empty());
        Ok(blocks)
    }

    /// The line above the header, when it tells a run or a direction.
    fn heading_above(&self, header: &[usize]) -> String {
        let above = header.first().into_iter().flat_map(|first| (0..*first).rev());
        let line = above.map(|row| self.grid.cells_of(row).collect::<Vec<_>>().join(" "));
        let mut near = line.filter(|line| !line.trim().is_empty()).take(2);
        near.find(|line| runs::run_of(line).is_some()).unwrap_or_default()
    }

    fn is_separator(&self, row: usize, header: &[usize]) -> bool {
        let repeat =
            header.iter().any(|known| self.grid.cells_of(*known).eq(self.grid.cells_of(row)));
        let text = || self.grid.cells_of(row).collect::<Vec<_>>().join(" ");
        self.grid.is_blank(row)
            || repeat
            || self.is_rule(row)
            || self.grid.is_comment(row) && runs::run_of(&text()).is_some()
            || self.count(row, Look::Number) < self.count(row, Look::Words)
                && runs::run_of(&text()).is_some()
    }

    fn check_width(&self, row: usize, table: &Found) -> Result<(), ImportError> {
        let (found, used) = (self.grid.width(row), self.grid.used_width(row));
        let fits = table.cells <= found && used <= table.width;
        // The separator behind the last cell may fail; another one would move cells to other columns.
        let unended = found == table.width && used == table.width;
        // A sheet drops empty cells at the end of a row, and may have notes beside its table.
        if self.grid.is_sheet() || fits || unended {
            return Ok(());
        }
        let cells =
            |count: usize| if count == 1 { "1 cell".into() } else { format!("{count} cells") };
        let column = found.checked_sub(1).map(|last| last.min(table.cells));
        let place = self.grid.place(row, column);
        let error = ImportError::found(
            place,
            cells(found),
            format!("{} as in the other rows", table.cells),
        );
        Err(if row + 1 == self.grid.rows() {
            error.hinted("the last line is cut off: was the recording stopped?")
        } else {
            error
        })
    }
}
