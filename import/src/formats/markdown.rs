//! Tables of a Markdown report: those with one header belong together, and a report has others beside.
//!
//! Format: GitHub Flavored Markdown, section 4.10: a line of names, a line of dashes, lines of cells.

use crate::decide::Decisions;
use crate::error::ImportError;
use crate::header;
use crate::place::Place;
use crate::question::Answer;

/// A table: where its names stand, and the line behind its last row.
struct Table {
    names: usize,
    end: usize,
}

/// True when a line of dashes follows a line of names.
pub(crate) fn fits(lines: &[&str]) -> bool {
    !tables(lines).is_empty()
}

/// The tables with the header that the recipe names, or the one with most rows of those that say where and
/// what, and the headings above them; every other line is empty, so that all keep their numbers.
pub(crate) fn chosen<'a>(
    lines: &[&'a str],
    decisions: &mut Decisions<'_>,
) -> Result<Vec<&'a str>, ImportError> {
    let tables = tables(lines);
    let mut headers: Vec<(&str, usize)> = Vec::new();
    for table in &tables {
        let header = lines[table.names].trim();
        let rows = table.end - table.names;
        match headers.iter_mut().find(|(known, _)| *known == header) {
            Some((_, all)) => *all += rows,
            None => headers.push((header, rows)),
        }
    }
    if headers.iter().any(|(header, _)| is_measurement(header)) {
        headers.retain(|(header, _)| is_measurement(header));
    }
    headers.sort_by_key(|(_, rows)| std::cmp::Reverse(*rows));
    if let [(_, most), (_, next), ..] = headers[..]
        && most < 2 * next
        && decisions.given("markdown", "header").is_none()
    {
        let answer = |(header, rows): &(&str, usize)| Answer {
            label: format!("tables of {rows} lines"),
            recipe: format!("[markdown]\nheader = {}", toml_edit::Value::from(*header)),
        };
        decisions.question(
            "tables of several headers hold about as much",
            headers.iter().take(6).map(answer).collect(),
        );
    }
    let most = headers.first().map_or("", |(header, _)| header);
    let header = decisions.text("markdown", "header", || {
        (most.to_owned(), format!("of {} tables, those with most measurements", tables.len()))
    });
    let mut kept = vec![""; lines.len()];
    for table in tables.iter().filter(|table| lines[table.names].trim() == header) {
        let heading = (0..table.names).rev().find(|at| lines[*at].trim_start().starts_with('#'));
        for at in heading.into_iter().chain(table.names..table.end) {
            kept[at] = if is_rule(lines[at]) { "" } else { lines[at] };
        }
    }
    if kept.iter().all(|line| line.is_empty()) {
        let found = format!("no table below `{header}`");
        return Err(ImportError::found(Place::file(decisions.file()), found, "one of its tables"));
    }
    Ok(kept)
}

/// True for names of which two and more are known, as place and error are.
fn is_measurement(header: &str) -> bool {
    let known = |name: &str| {
        let meaning = header::meaning(&header::read_name(name.trim()).bare);
        meaning.filter(|word| !["number", "pass", "direction"].contains(&word.meaning))
    };
    1 < header.split('|').filter_map(known).count()
}

fn tables(lines: &[&str]) -> Vec<Table> {
    let names = (0..lines.len().saturating_sub(1))
        .filter(|at| is_rule(lines[at + 1]) && is_row(lines[*at]) && !is_rule(lines[*at]));
    names
        .map(|names| {
            let rows = lines[names..].iter().take_while(|line| is_row(line)).count();
            Table { names, end: names + rows }
        })
        .collect()
}

fn is_row(line: &str) -> bool {
    line.contains('|')
}

fn is_rule(line: &str) -> bool {
    is_row(line) && line.contains("---") && line.chars().all(|c| "-:| \t".contains(c))
}
