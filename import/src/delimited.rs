//! Text in cells: what stands between them, and the decimal sign.

use crate::decide::Decisions;
use crate::error::{ImportError, quoted};
use crate::grid::{Delimiter, Grid};
use crate::instant::is_instant;
use crate::number::{MISSING, number};
use crate::place::Place;

/// Lines looked at to find the delimiter.
const SAMPLE: usize = 600;

/// Candidates, the likelier first where two fit alike.
const CANDIDATES: [Delimiter; 6] = [
    Delimiter::Char('\t'),
    Delimiter::Char(';'),
    Delimiter::Char('|'),
    Delimiter::Char(','),
    Delimiter::Blanks,
    Delimiter::Char(':'),
];

/// Splits a text into cells.
pub(crate) fn grid(lines: &[&str], decisions: &mut Decisions<'_>) -> Result<Grid, ImportError> {
    let file = decisions.file();
    if lines.iter().all(|line| line.trim().is_empty()) {
        return Err(ImportError::found(
            Place::file(file),
            "an empty file",
            "a table of measured data",
        ));
    }
    let name = decisions.text("text", "delimiter", || {
        let (delimiter, reason) = detect_delimiter(file, lines);
        (delimiter.name(), reason)
    });
    let Some(delimiter) = Delimiter::named(&name) else {
        let found = format!("`delimiter = {}`", quoted(&name));
        return Err(ImportError::found(
            Place::file(file),
            found,
            "one character, `tab` or `blanks`",
        ));
    };
    let grid = Grid::split(file, lines, delimiter)?;
    let cells = (0..grid.rows()).flat_map(|row| grid.cells_of(row));
    decide_decimal(cells, delimiter != Delimiter::Char(','), decisions);
    Ok(grid)
}

fn detect_delimiter(file: &str, lines: &[&str]) -> (Delimiter, String) {
    let step = lines.len().div_ceil(SAMPLE).max(1);
    // A broken line must not tip the balance; it is refused later, with its place.
    let sample: Vec<&str> = lines
        .iter()
        .step_by(step)
        .copied()
        .filter(|line| line.matches('"').count() % 2 == 0)
        .collect();
    let mut best =
        (Delimiter::Char(','), 0.0, String::from("nothing stands between cells: one column"));
    for delimiter in CANDIDATES {
        let Ok(grid) = Grid::split(file, &sample, delimiter) else { continue };
        let (score, width, rows) = fit(&grid);
        if best.1 < score {
            let reason =
                format!("{rows} of {} lines looked at have {width} cells with it", sample.len());
            best = (delimiter, score, reason);
        }
    }
    (best.0, best.2)
}

/// How well cells fit a table: the share of readable cells in rows of the commonest width.
fn fit(grid: &Grid) -> (f64, usize, usize) {
    let readable =
        |cell: &str| number(cell, '.').is_some() || number(cell, ',').is_some() || is_instant(cell);
    let mut widths = std::collections::BTreeMap::<usize, (usize, usize)>::new();
    let (mut used, mut hits) = (0, 0);
    for row in (0..grid.rows()).filter(|row| !grid.is_blank(*row)) {
        let good = grid.cells_of(row).filter(|cell| readable(cell)).count();
        used += 1;
        let full = grid.cells_of(row).filter(|cell| !cell.is_empty()).count();
        if 0 < good && full <= 3 * good {
            let entry = widths.entry(grid.width(row)).or_default();
            *entry = (entry.0 + 1, entry.1 + good);
            hits += 1;
        }
    }
    let commonest =
        widths.iter().filter(|(width, _)| 1 < **width).max_by_key(|(_, (rows, _))| *rows);
    let Some((width, (rows, good))) = commonest else { return (0.0, 0, 0) };
    #[expect(clippy::cast_precision_loss, reason = "a sample is small")]
    let share = |part: usize, whole: usize| part as f64 / whole.max(1) as f64;
    (share(*rows, hits) * share(*rows, used) * share(*good, rows * width), *width, *rows)
}

/// The decimal sign of texts; `is_open` says that a mark before three digits is asked about, which commas
/// between cells leave to the point.
pub(crate) fn decide_decimal<'a>(
    cells: impl Iterator<Item = &'a str>,
    is_open: bool,
    decisions: &mut Decisions<'_>,
) {
    if decisions.given("text", "decimal").is_some() {
        return;
    }
    let (mut points, mut commas, mut marked) = (0_usize, 0_usize, None);
    for cell in cells.filter(|cell| cell.contains(['.', ','])) {
        let (point, comma) = (number(cell, '.').is_some(), number(cell, ',').is_some());
        // What reads either way, as `1.125`, tells nothing.
        points += usize::from(point && !comma);
        commas += usize::from(comma && !point);
        if point && comma && marked.is_none() {
            marked = Some(cell.to_owned());
        }
    }
    let (sign, reason) = match points.cmp(&commas) {
        std::cmp::Ordering::Greater => {
            (".", format!("{points} numbers read only with a point, {commas} only with a comma"))
        }
        std::cmp::Ordering::Less => {
            (",", format!("{commas} numbers read only with a comma, {points} only with a point"))
        }
        std::cmp::Ordering::Equal if marked.is_some() && is_open => {
            (ask_decimal(&marked.unwrap_or_default(), decisions), "not sure".to_owned())
        }
        std::cmp::Ordering::Equal => (".", "no number has a fraction".to_owned()),
    };
    decisions.text("text", "decimal", || (sign.to_owned(), reason));
}

/// Asks what a mark before three digits is; it is more often a fraction's.
fn ask_decimal(cell: &str, decisions: &mut Decisions<'_>) -> &'static str {
    let text =
        format!("`{cell}` may be a fraction or thousands, and nothing in the file tells which");
    let answers: [(&'static str, &str); 2] = if cell.contains(',') {
        [(",", "the comma is the decimal sign"), (".", "the comma groups thousands")]
    } else {
        [(".", "the point is the decimal sign"), (",", "the point groups thousands")]
    };
    decisions.ask("text", "decimal", &text, &answers);
    answers[0].0
}

/// Words for missing values that occur in the file.
pub(crate) fn missing_words(grid: &Grid, decisions: &mut Decisions<'_>) -> Vec<String> {
    decisions.list("table", "missing", || {
        let mut words: Vec<String> = Vec::new();
        for row in 0..grid.rows() {
            for cell in grid.cells_of(row) {
                let known =
                    cell.len() < 8 && MISSING.iter().any(|word| word.eq_ignore_ascii_case(cell));
                if known && !words.iter().any(|word| word.eq_ignore_ascii_case(cell)) {
                    words.push(cell.to_owned());
                }
            }
        }
        let reason =
            if words.is_empty() { "empty cells only" } else { "these occur and are no numbers" };
        (words, reason.to_owned())
    })
}
