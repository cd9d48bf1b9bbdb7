//! Numbers that stand for no reading, as loggers and instruments write them, and numbers in parentheses.
//!
//! A logger writes nines where it has nothing: `-999`, `9999.0`. They are asked about where no other
//! value of their column comes near them.

use toml_edit::{Array, Value};

use crate::decide::Decisions;
use crate::error::quoted;
use crate::grid::Grid;
use crate::header::Header;
use crate::number::{is_overload, number};
use crate::outline::Outline;
use crate::question::Answer;
use crate::recipe::Value as Word;
use crate::samples::{Holds, Samples, rows};

/// A mark is as far from all others as these are from each other, times this.
const APART: f64 = 10.0;

/// A grid without the parentheses around numbers: accountants write negative ones so, others what does not count.
///
/// `None` where none stands among numbers: a header may count its columns so.
pub(crate) fn without_parentheses(
    grid: &Grid,
    decimal: char,
    decisions: &mut Decisions<'_>,
) -> Option<Grid> {
    let inside = |cell: &str| {
        let inside = cell.strip_prefix('(')?.strip_suffix(')')?.trim();
        let unsigned = inside.starts_with(|c: char| c.is_ascii_digit());
        number(inside, decimal).filter(|_| unsigned).map(|_| inside.to_owned())
    };
    let among_numbers = |row: &usize| {
        let all = || grid.cells_of(*row).filter(|cell| !cell.is_empty());
        all().any(|cell| inside(cell).is_some())
            && all().any(|cell| number(cell, decimal).is_some())
    };
    let rows: Vec<usize> = (0..grid.rows()).filter(among_numbers).collect();
    let first =
        rows.iter().find_map(|row| grid.cells_of(*row).find(|cell| inside(cell).is_some()))?;
    let text = format!("{} stands in parentheses", quoted(first));
    if decisions.given("table", "parentheses").is_none() {
        let words = [("negative", "such numbers are negative"), ("missing", "they do not count")];
        decisions.ask("table", "parentheses", &text, &words);
    }
    let missing = decisions.given("table", "parentheses") == Some(&Word::Text("missing".into()));
    Some(grid.replaced(|row, cell| {
        let inside = inside(cell).filter(|_| rows.binary_search(&row).is_ok())?;
        Some(if missing { String::new() } else { format!("-{inside}") })
    }))
}

/// Says how many cells hold the overload of an instrument, which is read as no value.
pub(crate) fn note_overloads(
    grid: &Grid,
    outline: &Outline,
    (samples, decimal): (&[Samples], char),
    decisions: &mut Decisions<'_>,
) {
    let rows = rows(outline);
    let without_value = |(at, samples): (usize, &Samples)| {
        let nothing = rows.iter().zip(&samples.values).filter(|(_, value)| value.is_nan());
        nothing.map(|(row, _)| (*row, at)).collect::<Vec<_>>()
    };
    let mut overloads = samples
        .iter()
        .enumerate()
        .flat_map(without_value)
        .filter(|(row, at)| is_overload(grid.cell(*row, *at), decimal));
    let Some((row, at)) = overloads.next() else { return };
    let (cell, place) = (quoted(grid.cell(row, at)), grid.place(row, Some(at)));
    let count = match overloads.count() {
        0 => "1 cell holds".to_owned(),
        more => format!("{} cells hold", more + 1),
    };
    decisions.note(format!(
        "{count} the overload of an instrument, first {cell} at {place}: read as missing"
    ));
}

/// Asks about every such number.
pub(crate) fn ask(
    grid: &Grid,
    outline: &Outline,
    (headers, samples): (&[Header], &[Samples]),
    (decimal, missing): (char, &[String]),
    decisions: &mut Decisions<'_>,
) {
    let rows = rows(outline);
    let mut known: Vec<String> = missing.to_vec();
    for (column, samples) in samples.iter().enumerate() {
        let cells = || rows.iter().map(|row| grid.cell(*row, column).trim());
        let mut marks: Vec<&str> = cells().filter(|cell| is_mark(cell)).collect();
        marks.sort_unstable();
        marks.dedup();
        marks.retain(|mark| {
            !known.iter().any(|word| word == mark)
                && number(mark, decimal).is_some_and(|value| is_apart(value, samples))
        });
        for mark in marks {
            let times = cells().filter(|cell| *cell == mark).count();
            let name = &headers[column].name;
            let text = format!(
                "`{mark}` stands {times} times in column `{name}`, and no other value comes near it"
            );
            let read = answer("it is a reading", &known);
            known.push(mark.to_owned());
            let ways = vec![answer("it stands for a missing value", &known), read];
            let row = rows.iter().find(|row| grid.cell(**row, column).trim() == mark);
            let place = grid.place(row.copied().unwrap_or(0), Some(column));
            decisions.question_at(&place, &text, ways);
        }
    }
}

fn answer(label: &str, missing: &[String]) -> Answer {
    let words = Value::from(missing.iter().collect::<Array>());
    Answer { label: label.to_owned(), recipe: format!("[table]\nmissing = {words}") }
}

/// Three nines or more, with a sign or a fraction of zeros or nines.
fn is_mark(cell: &str) -> bool {
    let digits = cell.trim_start_matches(['-', '+', '\u{2212}']);
    let (whole, fraction) = digits.split_once(['.', ',']).unwrap_or((digits, ""));
    let all = |text: &str, of: u8| text.bytes().all(|byte| byte == of);
    2 < whole.len() && all(whole, b'9') && (all(fraction, b'0') || all(fraction, b'9'))
}

/// True when the other values of the column lie together, far from this one.
fn is_apart(mark: f64, samples: &Samples) -> bool {
    if samples.holds != Holds::Numbers {
        return false;
    }
    let others = samples.values.iter().filter(|value| value.is_finite());
    let others = others.filter(|value| value.to_bits() != mark.to_bits());
    let (mut least, mut most, mut count) = (f64::INFINITY, f64::NEG_INFINITY, 0_usize);
    for value in others {
        least = least.min(*value);
        most = most.max(*value);
        count += 1;
    }
    // One value more is no sign of anything: a scale may end there.
    let distance = (mark - most).max(least - mark);
    1 < count && APART * (most - least) < distance
}
