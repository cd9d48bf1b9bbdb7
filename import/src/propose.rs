//! A recipe for a file, and a table by a recipe.

use helixlock_traces::{Column, Table};

use crate::build::{self, Built, Understood};
use crate::data;
use crate::decide::Decisions;
use crate::delimited;
use crate::encoding;
use crate::error::{ImportError, quoted};
use crate::formats;
use crate::fringes;
use crate::grid::Grid;
use crate::header::{self, Header};
use crate::limits;
use crate::marks;
use crate::outline::{Outline, outline};
use crate::place::Place;
use crate::question::Question;
use crate::recipe::{ColumnRule, Recipe, Value};
use crate::rules;
use crate::samples::{Holds, Samples, samples};
use crate::{text, upright};

/// Lines of a file that show how it begins.
const SHOWN: usize = 8;

/// A file in memory.
#[derive(Clone, Copy, Debug)]
pub struct Source<'a> {
    /// Its name, for messages and for what the ending tells.
    pub name: &'a str,
    /// What it holds.
    pub bytes: &'a [u8],
}

/// How a file would be read.
#[derive(Clone, Debug)]
pub struct Proposal {
    /// Every decision, those given and those found out.
    pub recipe: Recipe,
    /// What is open; the recipe holds the likelier answer meanwhile.
    pub questions: Vec<Question>,
    /// What the user should know.
    pub notes: Vec<String>,
    /// How the first file begins, as a reader of its format sees it: lines of a text, rows of a sheet.
    pub beginning: Vec<String>,
    /// The table by that recipe.
    pub table: Table,
}

/// Reads files of one kind by what `given` says, and finds out the rest from the first of them.
///
/// # Errors
///
/// [`ImportError`] with the place of what cannot be read.
pub fn propose(sources: &[Source<'_>], given: &Recipe) -> Result<Proposal, ImportError> {
    rules::check_names(given)?;
    let mut recipe = given.clone();
    let (mut parts, mut questions, mut notes) = (Vec::new(), Vec::new(), Vec::new());
    let (mut headers, mut beginning) = (Vec::new(), Vec::new());
    for (index, source) in sources.iter().enumerate() {
        let mut decisions = Decisions::new(source.name, &recipe);
        let part = read(*source, &mut decisions)?;
        if decisions.questions.is_empty() {
            build::check(&part.columns, source.name, &decisions.left_out)?;
        }
        parts.push(part);
        notes.append(&mut decisions.notes);
        questions.append(&mut decisions.questions);
        headers.append(&mut decisions.headers);
        let made = decisions.made;
        if index == 0 {
            (recipe, beginning) = (made, decisions.beginning);
        }
    }
    all_are_there(given, &headers)?;
    Ok(Proposal { recipe, questions, notes, beginning, table: build::joined(parts) })
}

/// Refuses a rule for a column that no file has: what it says would be lost without a word.
///
/// One that leaves the column out has what it wants.
fn all_are_there(given: &Recipe, headers: &[String]) -> Result<(), ImportError> {
    let lost = |rule: &&ColumnRule| {
        rule.to.as_deref() != Some(rules::NONE) && !headers.contains(&rule.from)
    };
    let Some(rule) = given.columns.iter().find(lost) else { return Ok(()) };
    let mut names: Vec<String> = headers.iter().map(|name| quoted(name)).collect();
    names.dedup();
    let expected = match names.len() {
        0 => "no `[[column]]`, as the format has no columns to name".to_owned(),
        _ => format!("one of {}", names.join(", ")),
    };
    let found = format!("`from` with {}, which no file has as a column", quoted(&rule.from));
    Err(ImportError::found(rule.place.clone(), found, expected))
}

/// Reads files by a recipe.
///
/// # Errors
///
/// [`ImportError`] with the place of what cannot be read; [`ImportError::Unanswered`] when the
/// recipe leaves something open that the file does not tell.
pub fn apply(sources: &[Source<'_>], recipe: &Recipe) -> Result<Table, ImportError> {
    let mut proposal = propose(sources, recipe)?;
    if proposal.questions.is_empty() {
        Ok(proposal.table)
    } else {
        Err(ImportError::Unanswered(Box::new(proposal.questions.swap_remove(0))))
    }
}

fn read(source: Source<'_>, decisions: &mut Decisions<'_>) -> Result<Built, ImportError> {
    if limits::BYTES < source.bytes.len() {
        let place = Place::file(source.name);
        let found = format!("{} bytes", source.bytes.len());
        return Err(ImportError::found(place, found, format!("up to {}", limits::BYTES)));
    }
    if let Some((format, reason)) = formats::binary(source.name, source.bytes)? {
        decisions.text("file", "format", || (format.into(), reason.into()));
        if format == "sigrok" {
            return formats::sigrok::read(source.bytes, decisions);
        }
        let grid = match format {
            "spreadsheet" => formats::spreadsheet::grid(source.bytes, decisions)?,
            "npy" => formats::npy::grid(source.name, source.bytes)?,
            "npz" => formats::npz::grid(source.bytes, decisions)?,
            "arrow" => formats::arrow::grid(source.bytes, decisions)?,
            "matlab" => formats::matlab::grid(source.bytes, decisions)?,
            "hdf5" => formats::hdf5::grid(source.bytes, decisions)?,
            _ => formats::parquet::grid(source.bytes, decisions)?,
        };
        let line = |row: usize| grid.cells_of(row).collect::<Vec<_>>().join("\t");
        decisions.beginning = (0..grid.rows().min(SHOWN)).map(line).collect();
        return understand(&grid, '.', decisions);
    }
    let content = encoding::decode(source.bytes, decisions)?;
    formats::check_text(source.name, &content)?;
    let lines = text::lines(&content);
    decisions.beginning = lines.iter().take(SHOWN).map(|line| (*line).to_owned()).collect();
    let format = decisions.text("file", "format", || {
        let (format, reason) = formats::textual(source.name, &lines);
        (format.into(), reason.into())
    });
    match format.as_str() {
        "phd2" => formats::phd2::read(&lines, decisions),
        "phd2-debug" => formats::phd2_debug::read(&lines, decisions),
        "eqmod" => formats::eqmod::read(&lines, decisions),
        "renishaw" => formats::renishaw::read(&lines, decisions),
        "iso230" => formats::iso230::read(&lines, decisions),
        "linuxcnc-comp" => formats::linuxcnc::read_comp(&lines, decisions),
        "halsampler" => sampled(&lines, decisions),
        "camonitor" => understand(&formats::camonitor::grid(&lines, decisions)?, '.', decisions),
        "twincat" => {
            let (grid, origin_s) = formats::twincat::grid(&lines, decisions)?;
            Ok(Built { origin_s, ..understand(&grid, '.', decisions)? })
        }
        "markdown" => table(&formats::markdown::chosen(&lines, decisions)?, decisions),
        "table" => table(&lines, decisions),
        other => {
            let found = format!("text, while the recipe says `format = \"{other}\"`");
            Err(ImportError::found(Place::file(source.name), found, "a file of that format"))
        }
    }
}

fn table(lines: &[&str], decisions: &mut Decisions<'_>) -> Result<Built, ImportError> {
    let grid = delimited::grid(lines, decisions)?;
    let decimal = decisions.text("text", "decimal", || (".".into(), String::new()));
    understand(&grid, if decimal == "," { ',' } else { '.' }, decisions)
}

/// Samples that are counted: their number and the period of the thread give the time.
fn sampled(lines: &[&str], decisions: &mut Decisions<'_>) -> Result<Built, ImportError> {
    let period_s = decisions.number(
        "halsampler",
        "period_s",
        "the period of the thread that sampled is not told, in seconds",
        &["0.001", "0.0001", "0.01"],
    );
    let lines = formats::linuxcnc::sampler_lines(lines, period_s);
    table(&lines.iter().map(String::as_str).collect::<Vec<_>>(), decisions)
}

/// From cells to a table.
pub(crate) fn understand(
    grid: &Grid,
    decimal: char,
    decisions: &mut Decisions<'_>,
) -> Result<Built, ImportError> {
    let plain = marks::without_parentheses(grid, decimal, decisions);
    let grid = plain.as_ref().unwrap_or(grid);
    let outline = outline(grid, decimal, decisions)?;
    upright::check(grid, &outline)?;
    let told = decisions.given("table", "missing").is_some();
    let missing = delimited::missing_words(grid, decisions);
    let data = outline.blocks.first().and_then(|block| block.rows.first());
    let headers = header::headers(grid, &outline.header, data.copied(), outline.width)?;
    decisions.headers.extend(headers.iter().map(|header| header.name.clone()));
    let samples = samples(grid, &outline, decimal, &missing);
    marks::note_overloads(grid, &outline, (&samples, decimal), decisions);
    if !told {
        marks::ask(grid, &outline, (&headers, &samples), (decimal, &missing), decisions);
    }
    let unit = preamble_unit(grid, &outline);
    let rules = rules::propose(&headers, &samples, unit.as_deref(), decisions);
    decisions.made.columns.clone_from(&rules);
    let left_out = without_numbers(grid, &outline, (&headers, &samples), decisions);
    decisions.left_out.extend(left_out);
    let understood = Understood {
        grid,
        outline: &outline,
        headers: &headers,
        samples: &samples,
        rules: &rules,
        missing: &missing,
    };
    let mut built = understood.build(decisions)?;
    evenly_timed(&mut built, decisions)?;
    if !fringes::are_in(&built.columns) || !decisions.questions.is_empty() {
        return Ok(built);
    }
    Ok(Built { columns: fringes::demodulated(&built.columns, decisions)?, ..built })
}

/// What columns hold that hold no numbers and that no recipe leaves out; names may stand behind the last
/// column that is filled.
fn without_numbers(
    grid: &Grid,
    outline: &Outline,
    (headers, samples): (&[Header], &[Samples]),
    decisions: &Decisions<'_>,
) -> Vec<String> {
    let empty = |name: &str| {
        let why = if grid.is_sheet() { ", were its formulas never computed?" } else { "" };
        format!("column {} is empty{why}", quoted(name))
    };
    let names = outline.header.last().into_iter().flat_map(|row| grid.cells_of(*row));
    let behind = names.skip(outline.width).filter(|name| !name.is_empty()).map(empty);
    let open = |name: &str| decisions.given_column(name).is_none_or(|rule| rule.to.is_none());
    let columns = headers.iter().zip(samples).enumerate();
    let described = |(at, (header, samples)): (usize, (&Header, &Samples))| match samples.holds {
        Holds::Words => {
            let row = samples.first_word?;
            let (cell, place) = (quoted(grid.cell(row, at)), grid.place(row, Some(at)));
            let name = quoted(&header.name);
            Some(format!("column {name} holds words, first {cell} at {place}"))
        }
        Holds::Nothing => Some(empty(&header.name)),
        Holds::Numbers | Holds::Instants => None,
    };
    let described = columns.filter(|(_, (header, _))| open(&header.name)).filter_map(described);
    described.chain(behind).collect()
}

/// Counts the time from row to row, where a recipe says how long that takes.
fn evenly_timed(built: &mut Built, decisions: &Decisions<'_>) -> Result<(), ImportError> {
    let Some(Value::Number(period_s)) = decisions.given("table", "period_s") else { return Ok(()) };
    let place = Place::file(decisions.file());
    if *period_s <= 0.0 {
        let found = format!("`period_s = {period_s}`");
        return Err(ImportError::found(place, found, "a time from row to row, in seconds"));
    }
    if built.columns.iter().any(|column| column.name == "time_s") {
        let found = "a column of times, while the recipe says `period_s`";
        return Err(ImportError::found(place, found, "one of the two"));
    }
    let rows = built.columns.first().map_or(0, |column| column.values.len());
    #[expect(clippy::cast_precision_loss, reason = "rows are far below 2⁵³")]
    let values = (0..rows).map(|row| build::rounded(row as f64 * period_s)).collect();
    built.columns.insert(0, Column { name: "time_s".to_owned(), values });
    Ok(())
}

/// The unit of `Unit: mm` above the table.
fn preamble_unit(grid: &Grid, outline: &Outline) -> Option<String> {
    const WORDS: [&str; 6] = ["unit", "units", "einheit", "einheiten", "单位", "unité"];
    outline.preamble.iter().find_map(|row| {
        let line =
            grid.cells_of(*row).collect::<Vec<_>>().join(" ").to_lowercase().replace('：', ":");
        let (word, rest) = line.split_once([':', '=']).or_else(|| line.split_once(' '))?;
        let unit = rest.trim().trim_matches(['[', ']', '"']).trim();
        (WORDS.contains(&word.trim()) && data::unit(unit, "").is_some()).then(|| unit.to_owned())
    })
}
