//! One table of a machine file, read key by key; every complaint names its place.
//!
//! Reading goes on after a complaint, so that one run tells all of them: what a table cannot give is
//! `None`, and why lies with the complaints.

use std::cell::RefCell;
use std::ops::{Range, RangeInclusive};
use std::path::Path;

use toml_edit::{Item, TableLike, Value};

use helixlock_traces::At;

use super::keys::{Absent, Key, Kind, Table};
use crate::error::{MachineError, place};
use crate::lead::Lead;
use crate::nearest::one_of;
use crate::units::{QuantityError, Unit, read_quantity, spellings};

/// Most gears, and most effects; machines have some ten of either.
const MOST_TABLES: usize = 500;

/// The text a machine was read from.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Source<'a> {
    pub(crate) path: &'a Path,
    pub(crate) text: &'a str,
    /// Where in the text another file begins, and its path.
    pub(crate) behind: Option<(usize, &'a Path)>,
}

impl Source<'_> {
    pub(crate) fn at(&self, span: Option<Range<usize>>) -> At {
        span.map_or_else(
            || At::file(self.path),
            |span| match self.behind.filter(|(from, _)| *from <= span.start) {
                Some((from, path)) => place(path, &self.text[from..], span.start - from),
                None => place(self.path, self.text, span.start),
            },
        )
    }

    fn quoted(&self, span: Option<Range<usize>>) -> String {
        let raw = span.and_then(|span| self.text.get(span)).unwrap_or("");
        format!("`{}`", raw.lines().next().unwrap_or("").trim())
    }
}

/// What is wrong with a file so far.
pub(crate) type Complaints = RefCell<Vec<MachineError>>;

/// A table with its name.
#[derive(Clone)]
pub(crate) struct Section<'a> {
    pub(crate) source: Source<'a>,
    complaints: &'a Complaints,
    name: String,
    table: &'a dyn TableLike,
    span: Option<Range<usize>>,
}

impl<'a> Section<'a> {
    /// The whole file.
    pub(crate) fn root(
        source: Source<'a>,
        table: &'a toml_edit::Table,
        complaints: &'a Complaints,
    ) -> Self {
        Self { source, complaints, name: String::new(), table, span: None }
    }

    /// Notes what is wrong; there is nothing to give.
    pub(crate) fn refuse<T>(&self, error: MachineError) -> Option<T> {
        self.complaints.borrow_mut().push(error);
        None
    }

    /// Refuses keys that are not in `keys`.
    pub(crate) fn only(&self, keys: &[&str]) {
        for found in self.keys().into_iter().filter(|key| !keys.contains(key)) {
            let table = if self.name.is_empty() { "the file" } else { &self.name };
            self.refuse::<()>(MachineError::UnknownKey {
                at: self.key_at(found),
                table: table.into(),
                found: found.into(),
                expected: one_of(found, keys).into(),
            });
        }
    }

    /// A table below this one, when it is there.
    pub(crate) fn section(&self, key: &str) -> Option<Self> {
        let item = self.table.get(key)?;
        let name = self.path_of(key);
        let Some(table) = item.as_table_like() else {
            return self.refuse(self.value_error(key, item, &format!("a table `[{name}]`")));
        };
        let span = item.span().or_else(|| self.table.key(key).and_then(toml_edit::Key::span));
        Some(Self { name, table, span, ..self.clone() })
    }

    /// A section of the list, when it is there, with none but its keys.
    pub(crate) fn part(&self, part: &Table) -> Option<Self> {
        let section = self.section(part.name)?;
        section.only(&part.keys.iter().map(|key| key.name).collect::<Vec<_>>());
        Some(section)
    }

    /// The tables of an array `[[key]]`.
    pub(crate) fn sections(&self, key: &str) -> Vec<Self> {
        let Some(item) = self.table.get(key) else { return Vec::new() };
        let name = self.path_of(key);
        let refuse = || self.refuse(self.value_error(key, item, &format!("tables `[[{name}]]`")));
        let below = |table: &'a dyn TableLike, span| Self {
            name: name.clone(),
            table,
            span,
            ..self.clone()
        };
        let tables = item.as_array_of_tables().map_or(0, toml_edit::ArrayOfTables::len);
        if MOST_TABLES < tables.max(item.as_array().map_or(0, toml_edit::Array::len)) {
            let found = format!("more than {MOST_TABLES} tables").into();
            let (at, key) = (self.key_at(key), name.as_str().into());
            let many = MachineError::Value { at, key, found, expected: "fewer".into() };
            return self.refuse(many).unwrap_or_default();
        }
        if let Some(array) = item.as_array_of_tables() {
            return array.iter().map(|table| below(table, table.span())).collect();
        }
        let Some(array) = item.as_array() else { return refuse().unwrap_or_default() };
        let tables = array.iter().map(|value| {
            let table = value.as_inline_table()?;
            Some(below(table, table.span()))
        });
        tables.collect::<Option<_>>().or_else(refuse).unwrap_or_default()
    }

    /// Keys in this table.
    pub(crate) fn keys(&self) -> Vec<&'a str> {
        self.table.iter().map(|(key, _)| key).collect()
    }

    /// True when something stands at `key`, right or wrong.
    pub(crate) fn has(&self, key: &str) -> bool {
        self.table.get(key).is_some()
    }

    /// The number of a key of the list, or what holds when it is not there.
    pub(crate) fn number_of(&self, key: &Key, unit: Option<&Unit>) -> Option<f64> {
        let found = match (&key.kind, unit) {
            (Kind::Quantity(own, range), unit) => {
                self.quantity(key.name, unit.unwrap_or(own), range.clone())
            }
            (Kind::Number(range), _) => self.number(key.name, range.clone()),
            _ => None,
        };
        found.or_else(|| match key.absent {
            Absent::Number(number) if !self.has(key.name) => Some(number),
            _ => self.missing_key(key),
        })
    }

    /// The whole number of a key of the list.
    pub(crate) fn whole_of<T: TryFrom<i64>>(&self, key: &Key) -> Option<T> {
        let Kind::Whole(range) = &key.kind else { return None };
        let found = self.whole(key.name, range.clone());
        found.and_then(|whole| T::try_from(whole).ok()).or_else(|| self.missing_key(key))
    }

    /// The lead of a key of the list.
    pub(crate) fn lead_of(&self, key: &Key) -> Option<Lead> {
        if !self.has(key.name) {
            return self.missing_key(key);
        }
        let expected = "a lead from 0.001 mm to 1000 mm in at most nine digits such as \"6 mm\", \"1/6 in\" or \"0.5 pi mm\"";
        let lead = self.text(key.name)?.parse();
        lead.map_or_else(|_| self.refuse(self.wrong(key.name, expected)), Some)
    }

    /// The text of a key of the list.
    pub(crate) fn text_of(&self, key: &Key) -> Option<&'a str> {
        self.text(key.name).or_else(|| self.missing_key(key))
    }

    /// Refuses that a key is not there, where the section cannot do without it.
    fn missing_key<T>(&self, key: &Key) -> Option<T> {
        let missing = matches!(key.absent, Absent::Refused) && !self.has(key.name);
        if missing { self.refuse(self.missing(key.name, &key.line())) } else { None }
    }

    /// A quantity with a unit, inside a range given in that unit.
    pub(crate) fn quantity(
        &self,
        key: &str,
        unit: &Unit,
        range: RangeInclusive<f64>,
    ) -> Option<f64> {
        let item = self.table.get(key)?;
        let units = spellings(unit.dimension);
        let refuse = |expected: &str| self.refuse(self.value_error(key, item, expected));
        let Some(text) = item.as_str() else {
            return refuse(&format!("a quantity in quotes with one of the units {units}"));
        };
        match read_quantity(text, unit) {
            Ok(value) if range.contains(&value) => Some(value),
            Ok(_) => refuse(&format!("{} to {} {unit}", range.start(), range.end())),
            Err(QuantityError::NoNumber) => {
                refuse(&format!("a number and one of the units {units}"))
            }
            Err(QuantityError::NotFinite) => refuse("a finite number"),
            Err(QuantityError::Comma) => refuse("a decimal point, not a comma"),
            Err(_) => refuse(&format!("one of the units {units}")),
        }
    }

    /// A number without a unit, inside a range.
    pub(crate) fn number(&self, key: &str, range: RangeInclusive<f64>) -> Option<f64> {
        let item = self.table.get(key)?;
        #[expect(clippy::cast_precision_loss, reason = "the range keeps it below 2⁵³")]
        let value = item.as_float().or_else(|| item.as_integer().map(|whole| whole as f64));
        let Some(value) = value else {
            return self.refuse(self.value_error(key, item, "a number without unit"));
        };
        if range.contains(&value) {
            return Some(value);
        }
        let expected = format!("{} to {}", range.start(), range.end());
        self.refuse(self.value_error(key, item, &expected))
    }

    /// A whole number inside a range.
    fn whole(&self, key: &str, range: RangeInclusive<i64>) -> Option<i64> {
        let item = self.table.get(key)?;
        let value = item.as_integer().filter(|value| range.contains(value));
        value.or_else(|| {
            let expected = format!("a whole number from {} to {}", range.start(), range.end());
            self.refuse(self.value_error(key, item, &expected))
        })
    }

    /// True or false.
    pub(crate) fn flag(&self, key: &str) -> Option<bool> {
        let item = self.table.get(key)?;
        item.as_bool().or_else(|| self.refuse(self.value_error(key, item, "true or false")))
    }

    /// A text in quotes.
    pub(crate) fn text(&self, key: &str) -> Option<&'a str> {
        let item = self.table.get(key)?;
        item.as_str().or_else(|| self.refuse(self.value_error(key, item, "a text in quotes")))
    }

    /// What stands at `key` cannot be; `expected` says what could.
    pub(crate) fn wrong(&self, key: &str, expected: &str) -> MachineError {
        self.table.get(key).map_or_else(
            || self.missing(key, expected),
            |item| self.value_error(key, item, expected),
        )
    }

    /// What stands at `key` goes against something else.
    pub(crate) fn conflict(&self, key: &str, conflict: &str) -> MachineError {
        let span = self.table.get(key).and_then(value_span);
        MachineError::Conflict {
            at: self.value_at(key),
            key: self.path_of(key).into(),
            found: self.source.quoted(span).into(),
            conflict: conflict.into(),
        }
    }

    /// `key` is not there and has no default.
    pub(crate) fn missing(&self, key: &str, example: &str) -> MachineError {
        MachineError::Missing {
            at: self.at(),
            key: self.path_of(key).into(),
            example: example.into(),
        }
    }

    /// Where the table begins.
    pub(crate) fn at(&self) -> At {
        self.source.at(self.span.clone())
    }

    /// Where a value stands, or its table.
    pub(crate) fn value_at(&self, key: &str) -> At {
        let span = self.table.get(key).and_then(value_span);
        self.source.at(span.or_else(|| self.span.clone()))
    }

    /// Name of a key with its table.
    pub(crate) fn path_of(&self, key: &str) -> String {
        if self.name.is_empty() { key.into() } else { format!("{}.{key}", self.name) }
    }

    fn key_at(&self, key: &str) -> At {
        let span = self.table.key(key).and_then(toml_edit::Key::span);
        let span = span.or_else(|| self.table.get(key).and_then(value_span));
        self.source.at(span.or_else(|| self.span.clone()))
    }

    fn value_error(&self, key: &str, item: &Item, expected: &str) -> MachineError {
        let span = value_span(item).or_else(|| self.table.key(key).and_then(toml_edit::Key::span));
        let found = match item {
            Item::Table(_) => "a table".to_owned(),
            Item::ArrayOfTables(_) => "an array of tables".into(),
            _ => self.source.quoted(span.clone()),
        };
        MachineError::Value {
            at: self.source.at(span),
            key: self.path_of(key).into(),
            found: found.into(),
            expected: expected.into(),
        }
    }
}

fn value_span(item: &Item) -> Option<Range<usize>> {
    item.as_value().map_or_else(|| item.span(), Value::span)
}
