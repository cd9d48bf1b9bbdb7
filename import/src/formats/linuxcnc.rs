//! LinuxCNC: screw compensation files, and what `halsampler` prints.
//!
//! A compensation file has nominal, forward and reverse position a line (`COMP_FILE_TYPE = 0`), or nominal
//! and two trims (`1`); `halsampler -t` puts the number of a sample before its values, and says `overrun`
//! where samples were lost (LinuxCNC documentation: "INI configuration", `halsampler(1)`).

use helixlock_traces::Column;

use crate::build::Built;
use crate::data;
use crate::decide::Decisions;
use crate::error::{ImportError, quoted};
use crate::number::number;
use crate::place::Place;

/// True when lines hold three numbers each, comments aside.
pub(crate) fn is_comp(lines: &[&str]) -> bool {
    let mut rows = lines
        .iter()
        .map(|line| line.trim())
        .filter(|line| !line.is_empty() && !line.starts_with(['#', ';']));
    let three = |line: &str| {
        let words: Vec<&str> = line.split_whitespace().collect();
        words.len() == 3 && words.iter().all(|word| number(word, '.').is_some())
    };
    rows.next().is_some_and(three)
}

/// True when each line begins with a number that counts up by one.
pub(crate) fn is_sampler(lines: &[&str]) -> bool {
    const LOOKED_AT: usize = 50;
    let rows: Vec<&str> = lines
        .iter()
        .map(|line| line.trim())
        .filter(|line| !line.is_empty() && *line != "overrun")
        .take(LOOKED_AT)
        .collect();
    let first = |line: &&str| line.split([' ', '\t']).next()?.parse::<u64>().ok();
    let counts: Option<Vec<u64>> = rows.iter().map(first).collect();
    let wide = rows
        .iter()
        .all(|row| 2 < row.split_whitespace().count() && !row.contains([',', ';', '\t']));
    let overrun = lines.iter().any(|line| line.trim() == "overrun");
    let Some(counts) = counts.filter(|counts| 3 < counts.len() && wide) else { return false };
    overrun && counts.windows(2).all(|pair| pair[0] < pair[1])
        || counts.windows(2).all(|pair| pair[1] == pair[0] + 1)
}

/// Lines of a sampler as a table with a header and times; a lost stretch is a blank line.
pub(crate) fn sampler_lines(lines: &[&str], period_s: f64) -> Vec<String> {
    let width = lines.iter().map(|line| line.split_whitespace().count()).max().unwrap_or(0);
    let names: Vec<String> = (1..width).map(|pin| format!("pin.{}", pin - 1)).collect();
    let header = format!("time_s {}", names.join(" "));
    let tick = |line: &str| line.split_whitespace().next().and_then(|word| number(word, '.'));
    let first = lines.iter().find_map(|line| tick(line)).unwrap_or(0.0);
    let timed = |line: &&str| {
        let line = line.trim();
        let (Some(tick), Some((_, rest))) = (tick(line), line.split_once([' ', '\t'])) else {
            return if line == "overrun" { String::new() } else { line.to_owned() };
        };
        format!("{} {rest}", ((tick - first) * period_s * 1e9).round() / 1e9)
    };
    std::iter::once(header).chain(lines.iter().map(timed)).collect()
}

/// Reads a compensation file.
pub(crate) fn read_comp(
    lines: &[&str],
    decisions: &mut Decisions<'_>,
) -> Result<Built, ImportError> {
    let file = decisions.file();
    let rows = triplets(file, lines)?;
    if decisions.given("calibration", "unit").is_none() {
        let text = "a compensation file is in the units of its machine, which it does not tell";
        decisions.ask(
            "calibration",
            "unit",
            text,
            &[("mm", "millimetres"), ("inch", "inches"), ("deg", "degrees")],
        );
    }
    let unit = decisions.text("calibration", "unit", || ("mm".into(), "not sure".into()));
    let follows = rows.iter().all(|row| (row[1] - row[0]).abs() <= 0.1 * (row[0].abs() + 1.0))
        && rows.iter().any(|row| 1.0 < row[0].abs());
    let kind = decisions.text("calibration", "values", || {
        if follows {
            (
                "positions".into(),
                "they go along with the nominal position (`COMP_FILE_TYPE = 0`)".into(),
            )
        } else {
            (
                "trims".into(),
                "they do not go along with the nominal position (`COMP_FILE_TYPE = 1`)".into(),
            )
        }
    });
    let Some(scale) = data::unit(&unit, "length").or_else(|| data::unit(&unit, "angle")) else {
        return Err(ImportError::found(
            Place::file(file),
            format!("the unit {}", quoted(&unit)),
            "a unit of length or angle",
        ));
    };
    let angular = scale.kind == "angle";
    let names = if angular {
        ["angle_rev", "error_arcsec", "pass", "direction"]
    } else {
        ["position_mm", "error_um", "pass", "direction"]
    };
    let mut columns: Vec<Column> =
        names.into_iter().map(|name| Column { name: name.into(), values: Vec::new() }).collect();
    let per_unit = if angular { 1_296_000.0 } else { 1000.0 };
    let there = rows.iter().map(|row| (row, 1, 1.0));
    for (row, place, direction) in there.chain(rows.iter().rev().map(|row| (row, 2, -1.0))) {
        let error = if kind == "positions" { row[0] - row[place] } else { row[place] };
        let cells = [
            row[0] * scale.scale / per_unit,
            (error * scale.scale * 1e6).round() / 1e6,
            1.0,
            direction,
        ];
        columns.iter_mut().zip(cells).for_each(|(column, value)| column.values.push(value));
    }
    Ok(Built { columns, origin_s: None })
}

fn triplets(file: &str, lines: &[&str]) -> Result<Vec<[f64; 3]>, ImportError> {
    let mut rows: Vec<[f64; 3]> = Vec::new();
    for (index, line) in lines.iter().enumerate() {
        let text = line.trim();
        if text.is_empty() || text.starts_with(['#', ';']) {
            continue;
        }
        let words: Vec<&str> = text.split_whitespace().collect();
        let mut row = [0.0; 3];
        if words.len() != row.len() {
            return Err(ImportError::found(
                Place::line(file, index + 1),
                format!("{} numbers", words.len()),
                "nominal, forward and reverse",
            ));
        }
        for (value, word) in row.iter_mut().zip(&words) {
            let place = Place::word(file, index + 1, line, word);
            *value = number(word, '.')
                .ok_or_else(|| ImportError::found(place, quoted(word), "a number"))?;
        }
        if rows.last().is_some_and(|last| row[0] <= last[0]) {
            return Err(ImportError::found(
                Place::word(file, index + 1, line, words[0]),
                format!("the position {}", row[0]),
                "a larger one than before",
            ));
        }
        rows.push(row);
    }
    Ok(rows)
}
