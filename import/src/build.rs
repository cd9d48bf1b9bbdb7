//! From samples and rules to the table of measured data.

mod anew;
mod directions;
mod figures;
mod instants;
mod runs;
mod table;

use helixlock_traces::Column;

use crate::data;
use crate::decide::Decisions;
use crate::error::{ImportError, quoted};
use crate::grid::Grid;
use crate::header::Header;
use crate::outline::Outline;
use crate::recipe::ColumnRule;
use crate::rules::{NONE, by_column};
use crate::runs::{counts_rows, direction_of, run_of};
use crate::samples::{Holds, Samples, rows};
use figures::{difference, micro, whole};
use instants::{decide_clock, decide_order, decide_zone, of_calendar, of_stopwatch};
use table::in_order;

pub(crate) use figures::rounded;
pub(crate) use table::{check, joined};

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
                "pass" => self.passes(index)?,
                "direction" => self.ways(index, rule)?,
                _ if self.samples[index].holds == Holds::Instants => {
                    let (values, origin) = self.instants(index, rule, decisions)?;
                    origin_s = origin;
                    values
                }
                _ => self.values(index, rule, decisions)?,
            };
            columns.push(Column { name: to.to_owned(), values });
        }
        self.directed(&mut columns, decisions)?;
        let mut columns = self.with_runs(columns, decisions)?;
        self.within_runs(&mut columns, decisions);
        Ok(Built { columns: in_order(columns), origin_s })
    }

    /// Directions, which a recipe may turn.
    fn ways(&self, index: usize, rule: &ColumnRule) -> Result<Vec<f64>, ImportError> {
        let expected = "a direction: 1, -1, or a word for it";
        let mut ways = match self.two_words(index) {
            Some(ways) => ways,
            None => self.named(index, direction_of, expected)?,
        };
        if rule.sign == Some(-1) {
            for way in &mut ways {
                *way = 0.0 - *way;
            }
        }
        Ok(ways)
    }

    /// Numbers of the runs; a counter of rows says nothing of runs.
    fn passes(&self, index: usize) -> Result<Vec<f64>, ImportError> {
        let values = self.named(index, |cell| run_of(cell)?.number.map(whole), "a run number")?;
        if counts_rows(&values) {
            let name = quoted(&self.headers[index].name);
            let place = self.grid.place(self.outline.header.first().copied().unwrap_or(0), None);
            let found = format!("a run for almost every row in column {name}");
            let error = ImportError::found(place, found, "runs of two rows or more");
            return Err(error.hinted("`to = \"none\"` for a column that counts the rows"));
        }
        Ok(values)
    }

    /// Values of a column in our unit.
    fn values(
        &self,
        index: usize,
        rule: &ColumnRule,
        decisions: &mut Decisions<'_>,
    ) -> Result<Vec<f64>, ImportError> {
        let mut values = self.numbers(index)?.to_vec();
        if rule.to.as_deref() == Some("time_s") {
            self.counted_on(index, &mut values, decisions);
        }
        if let Some(minus) = &rule.minus {
            let other = self.find(minus, &rule.from)?;
            let turned = if self.rules[other].sign == Some(-1) { -1.0 } else { 1.0 };
            let scale = turned * self.scale_between(other, index, rule);
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
        let minutes = clock.is_none() && decide_clock(&cells, &self.headers[index], decisions);
        let read = if minutes { of_stopwatch } else { of_calendar };
        let (mut values, day) = read(&cells, (order, zone), self.missing).map_err(|at| {
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

    /// The column that becomes one of ours.
    fn index_of(&self, target: &str) -> Option<usize> {
        self.rules.iter().position(|rule| rule.to.as_deref() == Some(target))
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
            let unit = unit.and_then(|unit| data::unit_with_factor(&unit, kind));
            unit.map_or(1.0, |unit| unit.scale)
        };
        scale(unit(from)) / scale(rule.unit.clone().or(unit(to)))
    }

    /// Factor and offset from the unit of the file to ours.
    fn conversion(
        &self,
        index: usize,
        unit: &str,
        kind: &str,
        ours: &str,
    ) -> Result<(f64, f64), ImportError> {
        let known = |spelling: &str| {
            data::unit_with_factor(spelling, kind).filter(|_| !data::is_doubtful(spelling))
        };
        let (Some(from), Some(to)) = (known(unit), known(ours)) else {
            let place =
                self.grid.place(self.outline.header.last().copied().unwrap_or(0), Some(index));
            let found = format!(
                "the unit {} for column {}",
                quoted(unit),
                quoted(&self.headers[index].name)
            );
            let error = ImportError::found(place, found, format!("a unit of {kind}"));
            let hint = match kind {
                "angle" if data::is_doubtful(unit) => "`deg`, or `gon` of 400 a turn",
                "angle" if data::unit(unit, "count").is_some() => {
                    "one of 4096 counts a turn is `unit = \"1/4096 rev\"`"
                }
                "length" => "a multiple of one is a unit, too: `unit = \"2.5 um\"`",
                _ => "",
            };
            return Err(error.hinted(hint));
        };
        Ok((from.scale / to.scale, (from.offset - to.offset) / to.scale))
    }
}
