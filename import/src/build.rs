//! From samples and rules to the table of measured data.

use helixlock_traces::{Column, Table};

use crate::data;
use crate::decide::Decisions;
use crate::error::{ImportError, quoted};
use crate::grid::Grid;
use crate::header::Header;
use crate::instant::Order;
use crate::layout::{self, Runs};
use crate::outline::Outline;
use crate::recipe::{ColumnRule, Value};
use crate::rules::{COORDINATES, NONE, OBSERVED, by_column};
use crate::runs::{direction_of, run_of};
use crate::samples::{Holds, Samples, date_order, rows, seconds};

/// Order of our columns in the table; others follow.
const ORDER: [&str; 9] = [
    "time_s",
    "position_mm",
    "angle_rev",
    "error_um",
    "error_arcsec",
    "lead_error_um",
    "steps",
    "pass",
    "direction",
];

/// A grid that is understood.
pub(crate) struct Understood<'a> {
    pub(crate) grid: &'a Grid,
    pub(crate) outline: &'a Outline,
    pub(crate) headers: &'a [Header],
    pub(crate) samples: &'a [Samples],
    pub(crate) rules: &'a [ColumnRule],
    pub(crate) missing: &'a [String],
}

/// A table, and the second since 1970 from which its time counts, where a date is known.
#[derive(Clone, Debug)]
pub(crate) struct Built {
    pub(crate) columns: Vec<Column>,
    pub(crate) origin_s: Option<f64>,
}

impl Understood<'_> {
    /// Makes the table.
    pub(crate) fn build(&self, decisions: &mut Decisions<'_>) -> Result<Built, ImportError> {
        let mut columns = Vec::new();
        let mut origin_s = None;
        for (index, rule) in self.rules.iter().enumerate() {
            let to = rule.to.as_deref().unwrap_or(NONE);
            if to == NONE || rule.pass.is_some() {
                continue;
            }
            let values = match to {
                "pass" => {
                    self.named(index, |cell| run_of(cell)?.number.map(whole), "a run number")?
                }
                "direction" => {
                    self.named(index, direction_of, "a direction: 1, -1, or a word for it")?
                }
                _ if self.samples[index].holds == Holds::Instants => {
                    let (values, origin) = self.instants(index, rule, decisions)?;
                    origin_s = origin;
                    values
                }
                _ => self.values(index, rule)?,
            };
            columns.push(Column { name: to.to_owned(), values });
        }
        let columns = self.with_runs(columns, decisions)?;
        Ok(Built { columns: in_order(columns), origin_s })
    }

    /// Values of a column in our unit.
    fn values(&self, index: usize, rule: &ColumnRule) -> Result<Vec<f64>, ImportError> {
        let mut values = self.numbers(index)?.to_vec();
        if let Some(minus) = &rule.minus {
            let other = self.find(minus, &rule.from)?;
            let scale = self.scale_between(other, index, rule);
            for (value, subtract) in values.iter_mut().zip(self.numbers(other)?) {
                *value = difference(*value, rounded(subtract * scale));
            }
        }
        let target = rule.to.as_deref().and_then(by_column);
        let (scale, offset) = match (target, rule.unit.as_deref()) {
            (Some(target), Some(unit)) if !target.kind.is_empty() => {
                self.conversion(index, unit, target.kind, target.unit)?
            }
            _ => (1.0, 0.0),
        };
        if rule.sign == Some(-1) {
            for value in &mut values {
                *value = 0.0 - *value;
            }
        }
        let same = (scale - 1.0).abs() <= 0.0 && offset.abs() <= 0.0;
        if !same || rule.minus.is_some() {
            for value in &mut values {
                *value = rounded(*value * scale + offset);
            }
        }
        Ok(values)
    }

    /// The column's numbers; a word among them is refused with its place.
    fn numbers(&self, index: usize) -> Result<&[f64], ImportError> {
        let samples = &self.samples[index];
        match samples.first_word {
            None => Ok(&samples.values),
            Some(row) => {
                let cell = self.grid.cell(row, index);
                let found =
                    format!("{} in column {}", quoted(cell), quoted(&self.headers[index].name));
                let hint = format!(
                    "`[table] missing = [{}]` if it stands for a missing value",
                    toml_edit::Value::from(cell)
                );
                Err(ImportError::found(self.grid.place(row, Some(index)), found, "a number")
                    .hinted(hint))
            }
        }
    }

    /// Cells read as numbers or as words.
    fn named(
        &self,
        index: usize,
        word: impl Fn(&str) -> Option<f64>,
        expected: &str,
    ) -> Result<Vec<f64>, ImportError> {
        let samples = &self.samples[index];
        let read = |(row, value): (usize, &f64)| {
            let cell = self.grid.cell(row, index);
            let found = word(cell).or_else(|| value.is_finite().then_some(*value));
            match found {
                Some(value) => Ok(value),
                None if cell.is_empty() => Ok(f64::NAN),
                None => Err(ImportError::found(
                    self.grid.place(row, Some(index)),
                    quoted(cell),
                    expected,
                )),
            }
        };
        rows(self.outline).into_iter().zip(&samples.values).map(read).collect()
    }

    fn instants(
        &self,
        index: usize,
        rule: &ColumnRule,
        decisions: &mut Decisions<'_>,
    ) -> Result<(Vec<f64>, Option<f64>), ImportError> {
        let clock = rule.with.as_ref().map(|with| self.find(with, &rule.from)).transpose()?;
        let rows = rows(self.outline);
        let cells: Vec<String> = rows
            .iter()
            .map(|row| {
                let cell = self.grid.cell(*row, index);
                clock.map_or_else(
                    || cell.to_owned(),
                    |clock| format!("{cell} {}", self.grid.cell(*row, clock)),
                )
            })
            .collect();
        let order = decide_order(&cells, decisions);
        let zone = decide_zone(&cells, decisions)?;
        let (mut values, day) = seconds(&cells, order, zone, self.missing).map_err(|at| {
            let place = self.grid.place(rows[at], Some(index));
            ImportError::found(place, quoted(&cells[at]), "an instant as in the rows before")
        })?;
        let first = values.iter().copied().find(|value| value.is_finite()).unwrap_or(0.0);
        for value in &mut values {
            *value = micro(*value - first);
        }
        let origin = (0 < day).then(|| whole(day) * 86_400.0 + first);
        Ok((values, origin))
    }

    fn find(&self, name: &str, from: &str) -> Result<usize, ImportError> {
        let found = self.headers.iter().position(|header| header.name == name);
        found.ok_or_else(|| {
            let place = self.grid.place(self.outline.header.first().copied().unwrap_or(0), None);
            let found = format!("no column {} that {} refers to", quoted(name), quoted(from));
            let names: Vec<_> = self.headers.iter().map(|header| quoted(&header.name)).collect();
            ImportError::found(place, found, format!("one of {}", names.join(", ")))
        })
    }

    /// How many of the unit of `to` one of `from` is.
    fn scale_between(&self, from: usize, to: usize, rule: &ColumnRule) -> f64 {
        let unit = |index: usize| {
            let rule = &self.rules[index];
            rule.unit.as_deref().or(self.headers[index].unit.as_deref()).map(ToOwned::to_owned)
        };
        let kind = if rule.to.as_deref() == Some("error_arcsec") { "angle" } else { "length" };
        let scale = |unit: Option<String>| {
            unit.and_then(|unit| data::unit(&unit, kind)).map_or(1.0, |unit| unit.scale)
        };
        scale(unit(from)) / scale(rule.unit.clone().or(unit(to)))
    }

    fn conversion(
        &self,
        index: usize,
        unit: &str,
        kind: &str,
        ours: &str,
    ) -> Result<(f64, f64), ImportError> {
        let known = |spelling: &str| data::unit(spelling, kind);
        let (Some(from), Some(to)) = (known(unit), known(ours)) else {
            let place =
                self.grid.place(self.outline.header.last().copied().unwrap_or(0), Some(index));
            let found = format!(
                "the unit {} for column {}",
                quoted(unit),
                quoted(&self.headers[index].name)
            );
            return Err(ImportError::found(place, found, format!("a unit of {kind}")));
        };
        Ok((from.scale / to.scale, (from.offset - to.offset) / to.scale))
    }

    fn with_runs(
        &self,
        columns: Vec<Column>,
        decisions: &mut Decisions<'_>,
    ) -> Result<Vec<Column>, ImportError> {
        let count = rows(self.outline).len();
        let own = |name: &str| columns.iter().any(|column| column.name == name);
        let path = COORDINATES.iter().filter(|name| **name != "time_s").find_map(|name| {
            columns
                .iter()
                .find(|column| column.name == *name)
                .map(|column| column.values.as_slice())
        });
        let clock = columns
            .iter()
            .find(|column| column.name == "time_s")
            .map(|column| column.values.as_slice());
        let held = self.rules.iter().filter(|rule| rule.pass.is_some()).count();
        let found = decisions.text("table", "runs", || {
            let ways = path.map(layout::sweeps).unwrap_or_default();
            let text = |word: &str, reason: String| (word.to_owned(), reason);
            if 0 < held {
                text("columns", format!("{held} columns hold a run each"))
            } else if own("pass") {
                text("one", "a column tells the runs".into())
            } else if self.restart(path.or(clock)) {
                text("blocks", format!("{} blocks, one below the other", self.outline.blocks.len()))
            } else if 1 < ways.len() {
                text(
                    "sweeps",
                    format!("the position goes {} ways, each over most of its range", ways.len()),
                )
            } else {
                text("one", "nothing starts anew".into())
            }
        });
        let runs = match found.as_str() {
            "columns" => return self.unpivot(&columns),
            "blocks" => layout::of_blocks(&self.outline.blocks, path),
            "sweeps" => layout::of_sweeps(&path.map(layout::sweeps).unwrap_or_default(), count),
            _ => Runs::default(),
        };
        let mut columns = columns;
        for (name, values) in [("pass", runs.pass), ("direction", runs.direction)] {
            let told = values.iter().any(|value| value.is_finite());
            if told && values.len() == count && !columns.iter().any(|column| column.name == name) {
                columns.push(Column { name: name.to_owned(), values });
            }
        }
        Ok(columns)
    }

    /// True when blocks begin anew, and a stray blank line is not all there is.
    fn restart(&self, path: Option<&[f64]>) -> bool {
        let blocks = &self.outline.blocks;
        if blocks.len() < 2 {
            return false;
        }
        let headed = blocks.iter().skip(1).all(|block| run_of(&block.heading).is_some());
        let Some(path) = path else { return headed };
        let starts = blocks.iter().scan(0, |start, block| {
            *start += block.rows.len();
            Some(*start)
        });
        let inner: Vec<usize> = starts.filter(|start| *start < path.len()).collect();
        let back = |start: &usize| {
            let before = (2..=*start).find_map(|back| {
                (0.0 < (path[*start - 1] - path[*start - back]).abs())
                    .then(|| path[*start - 1] - path[*start - back])
            });
            let step = path[*start] - path[*start - 1];
            before.is_none_or(|before| before * step <= 0.0)
        };
        headed || inner.iter().all(back)
    }

    /// One row a target and run, run after run.
    fn unpivot(&self, shared: &[Column]) -> Result<Vec<Column>, ImportError> {
        let mut keys: Vec<(i64, i64)> = self
            .rules
            .iter()
            .filter_map(|rule| Some((rule.pass?, rule.direction.unwrap_or(0))))
            .collect();
        keys.sort_by_key(|(pass, direction)| (*pass, -direction));
        keys.dedup();
        let both = keys.iter().any(|(_, direction)| *direction != 0);
        let count = rows(self.outline).len();
        let mut columns: Vec<Column> = shared
            .iter()
            .map(|column| Column { name: column.name.clone(), values: Vec::new() })
            .collect();
        let mut held: Vec<Column> = Vec::new();
        let (mut passes, mut directions) = (Vec::new(), Vec::new());
        for (pass, direction) in &keys {
            let order: Vec<usize> =
                if *direction < 0 { (0..count).rev().collect() } else { (0..count).collect() };
            for (column, from) in columns.iter_mut().zip(shared) {
                column.values.extend(order.iter().map(|row| from.values[*row]));
            }
            for (index, rule) in self.rules.iter().enumerate() {
                if rule.pass != Some(*pass) || rule.direction.unwrap_or(0) != *direction {
                    continue;
                }
                let (name, values) =
                    (rule.to.clone().unwrap_or_default(), self.values(index, rule)?);
                let column =
                    if let Some(at) = held.iter_mut().position(|column| column.name == name) {
                        &mut held[at]
                    } else {
                        held.push(Column { name, values: Vec::new() });
                        held.last_mut().expect("it was just pushed")
                    };
                column.values.resize(passes.len(), f64::NAN);
                column.values.extend(order.iter().map(|row| values[*row]));
            }
            passes.extend(std::iter::repeat_n(whole(*pass), count));
            directions.extend(std::iter::repeat_n(whole(*direction), count));
        }
        for column in &mut held {
            column.values.resize(passes.len(), f64::NAN);
        }
        columns.extend(held);
        columns.push(Column { name: "pass".into(), values: passes });
        if both {
            columns.push(Column { name: "direction".into(), values: directions });
        }
        Ok(columns)
    }
}

fn decide_order(cells: &[String], decisions: &mut Decisions<'_>) -> Order {
    if let Some(Value::Text(order)) = decisions.given("table", "date_order") {
        return Order::named(order);
    }
    let cells: Vec<&str> = cells.iter().map(String::as_str).collect();
    let order = date_order(&cells).unwrap_or_else(|| {
        let text = format!("{} may begin with the day or the month", quoted(cells[0]));
        decisions.ask(
            "table",
            "date_order",
            &text,
            &[("day", "the day comes first"), ("month", "the month comes first")],
        );
        Order::Day
    });
    let name = match order {
        Order::Day => "day",
        Order::Month => "month",
        Order::Year => "year",
    };
    decisions
        .text("table", "date_order", || (name.to_owned(), format!("as in {}", quoted(cells[0]))));
    order
}

fn decide_zone(cells: &[String], decisions: &mut Decisions<'_>) -> Result<i64, ImportError> {
    let named = cells.first().is_some_and(|cell| {
        crate::instant::parse(cell, Order::Day).is_some_and(|instant| instant.zone_min.is_some())
    });
    let zone = decisions.text("table", "zone", || {
        let reason = if named {
            "the times name their own"
        } else {
            "no time names one; only differences count"
        };
        ("UTC".to_owned(), reason.to_owned())
    });
    crate::instant::offset(&zone).ok_or_else(|| {
        let place = crate::error::Place::file(decisions.file());
        ImportError::found(place, format!("`zone = {}`", quoted(&zone)), "a zone such as `+02:00`")
    })
}

/// Ours in their order, then the others as in the file.
fn in_order(mut columns: Vec<Column>) -> Vec<Column> {
    let place = |name: &str| ORDER.iter().position(|known| *known == name).unwrap_or(ORDER.len());
    columns.sort_by_key(|column| place(&column.name));
    columns
}

/// What the table cannot do without.
pub(crate) fn check(columns: &[Column], file: &str) -> Result<(), ImportError> {
    let has = |names: &[&str]| {
        columns.iter().any(|column| {
            names.contains(&column.name.as_str())
                && column.values.iter().any(|value| value.is_finite())
        })
    };
    let names: Vec<_> = columns.iter().map(|column| quoted(&column.name)).collect();
    let found = if names.is_empty() {
        "no columns".to_owned()
    } else {
        format!("the columns {}", names.join(", "))
    };
    for wanted in [&OBSERVED[..], &COORDINATES[..]] {
        if !has(wanted) {
            let place = crate::error::Place::file(file);
            return Err(ImportError::found(
                place,
                found,
                format!("one of `{}`", wanted.join("`, `")),
            ));
        }
    }
    Ok(())
}

/// One table after the other: runs go on counting, times count from the first origin.
pub(crate) fn joined(parts: Vec<Built>) -> Table {
    let origin_s = parts.first().and_then(|part| part.origin_s);
    let several = 1 < parts.len();
    let mut columns: Vec<Column> = Vec::new();
    let (mut rows, mut passes) = (0, 0.0);
    for mut part in parts {
        let count = part.columns.first().map_or(0, |column| column.values.len());
        if several && !part.columns.iter().any(|column| column.name == "pass") {
            part.columns.push(Column { name: "pass".into(), values: vec![1.0; count] });
        }
        let later_s = origin_s.zip(part.origin_s).map_or(0.0, |(first, own)| own - first);
        let mut most = passes;
        for column in part.columns {
            let shift = match column.name.as_str() {
                "pass" => passes,
                "time_s" => later_s,
                _ => 0.0,
            };
            let at =
                columns.iter().position(|known| known.name == column.name).unwrap_or_else(|| {
                    columns
                        .push(Column { name: column.name.clone(), values: vec![f64::NAN; rows] });
                    columns.len() - 1
                });
            let exact = shift.abs() <= 0.0;
            columns[at].values.extend(
                column.values.iter().map(|value| if exact { *value } else { micro(value + shift) }),
            );
            if column.name == "pass" {
                most = columns[at]
                    .values
                    .iter()
                    .copied()
                    .filter(|value| value.is_finite())
                    .fold(most, f64::max);
            }
        }
        rows += count;
        passes = most;
        for column in &mut columns {
            column.values.resize(rows, f64::NAN);
        }
    }
    Table::new(in_order(columns))
}

#[expect(clippy::cast_precision_loss, reason = "runs and days are few")]
fn whole(number: i64) -> f64 {
    number as f64
}

/// To a microsecond: what is left of a difference of two instants.
fn micro(value: f64) -> f64 {
    (value * 1e6).round() / 1e6
}

/// To fifteen digits, so that 0.1 mm is 100 µm and not 100.00000000000001.
fn rounded(value: f64) -> f64 {
    format!("{value:.14e}").parse().unwrap_or(value)
}

/// A difference with no more decimals than its terms have.
fn difference(value: f64, subtract: f64) -> f64 {
    const MOST: usize = 12;
    let decimals =
        |number: f64| format!("{number}").split_once('.').map_or(0, |(_, rest)| rest.len());
    let most = decimals(value).max(decimals(subtract)).min(MOST);
    format!("{:.most$}", value - subtract).parse().unwrap_or(value - subtract)
}
