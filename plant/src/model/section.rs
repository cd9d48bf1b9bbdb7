//! One table of a machine file, read key by key; every complaint names its place.

use std::ops::{Range, RangeInclusive};
use std::path::Path;

use toml_edit::{Item, TableLike, Value};

use helixlock_traces::At;

use crate::error::{MachineError, place};
use crate::units::{QuantityError, Unit, read_quantity, spellings};

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

/// A table with its name.
#[derive(Clone)]
pub(crate) struct Section<'a> {
    pub(crate) source: Source<'a>,
    name: String,
    table: &'a dyn TableLike,
    span: Option<Range<usize>>,
}

type Result<T> = std::result::Result<T, MachineError>;

impl<'a> Section<'a> {
    /// The whole file.
    pub(crate) fn root(source: Source<'a>, table: &'a toml_edit::Table) -> Self {
        Self { source, name: String::new(), table, span: None }
    }

    /// Refuses keys that are not in `keys`.
    pub(crate) fn only(&self, keys: &[&str]) -> Result<()> {
        let unknown = self.table.iter().map(|(key, _)| key).find(|key| !keys.contains(key));
        unknown.map_or(Ok(()), |found| {
            let table = if self.name.is_empty() { "the file" } else { &self.name };
            Err(MachineError::UnknownKey {
                at: self.key_at(found),
                table: table.into(),
                found: found.into(),
                expected: keys.join(", ").into(),
            })
        })
    }

    /// A table below this one, when it is there.
    pub(crate) fn section(&self, key: &str) -> Result<Option<Self>> {
        let Some(item) = self.table.get(key) else { return Ok(None) };
        let name = self.path_of(key);
        let table = item
            .as_table_like()
            .ok_or_else(|| self.value_error(key, item, &format!("a table `[{name}]`")))?;
        let span = item.span().or_else(|| self.table.key(key).and_then(toml_edit::Key::span));
        Ok(Some(Self { source: self.source, name, table, span }))
    }

    /// A table below this one that has no default.
    pub(crate) fn required_section(&self, key: &str, example: &str) -> Result<Self> {
        self.section(key)?.ok_or_else(|| self.missing(key, example))
    }

    /// The tables of an array `[[key]]`.
    pub(crate) fn sections(&self, key: &str) -> Result<Vec<Self>> {
        let Some(item) = self.table.get(key) else { return Ok(Vec::new()) };
        let name = self.path_of(key);
        let refuse = || self.value_error(key, item, &format!("tables `[[{name}]]`"));
        if let Some(array) = item.as_array_of_tables() {
            return Ok(array.iter().map(|table| self.below(&name, table, table.span())).collect());
        }
        let array = item.as_array().ok_or_else(refuse)?;
        array
            .iter()
            .map(|value| {
                let table = value.as_inline_table().ok_or_else(refuse)?;
                Ok(self.below(&name, table, table.span()))
            })
            .collect()
    }

    fn below(&self, name: &str, table: &'a dyn TableLike, span: Option<Range<usize>>) -> Self {
        Self { source: self.source, name: name.into(), table, span }
    }

    /// Keys in this table.
    pub(crate) fn keys(&self) -> Vec<&'a str> {
        self.table.iter().map(|(key, _)| key).collect()
    }

    /// A quantity with a unit, inside a range given in that unit.
    pub(crate) fn quantity(
        &self,
        key: &str,
        unit: &Unit,
        range: RangeInclusive<f64>,
    ) -> Result<Option<f64>> {
        let Some(item) = self.table.get(key) else { return Ok(None) };
        let units = spellings(unit.dimension);
        let expected = format!("a quantity in quotes with one of the units {units}");
        let text = item.as_str().ok_or_else(|| self.value_error(key, item, &expected))?;
        let value = read_quantity(text, unit).map_err(|error| {
            let reason = match error {
                QuantityError::NoNumber => format!("a number and one of the units {units}"),
                QuantityError::NotFinite => "a finite number".into(),
                QuantityError::Comma => "a decimal point, not a comma".into(),
                _ => format!("one of the units {units}"),
            };
            self.value_error(key, item, &reason)
        })?;
        if range.contains(&value) {
            return Ok(Some(value));
        }
        let (low, high) = (range.start(), range.end());
        Err(self.value_error(key, item, &format!("{low} to {high} {unit}")))
    }

    /// A number without a unit, inside a range.
    pub(crate) fn number(&self, key: &str, range: RangeInclusive<f64>) -> Result<Option<f64>> {
        let Some(item) = self.table.get(key) else { return Ok(None) };
        #[expect(clippy::cast_precision_loss, reason = "the range keeps it below 2⁵³")]
        let value = item.as_float().or_else(|| item.as_integer().map(|whole| whole as f64));
        let value = value.ok_or_else(|| self.value_error(key, item, "a number without unit"))?;
        if range.contains(&value) {
            return Ok(Some(value));
        }
        Err(self.value_error(key, item, &format!("{} to {}", range.start(), range.end())))
    }

    /// A whole number inside a range.
    pub(crate) fn whole(&self, key: &str, range: RangeInclusive<i64>) -> Result<Option<i64>> {
        let Some(item) = self.table.get(key) else { return Ok(None) };
        let expected = format!("a whole number from {} to {}", range.start(), range.end());
        item.as_integer()
            .filter(|value| range.contains(value))
            .map(Some)
            .ok_or_else(|| self.value_error(key, item, &expected))
    }

    /// True or false.
    pub(crate) fn flag(&self, key: &str) -> Result<Option<bool>> {
        let Some(item) = self.table.get(key) else { return Ok(None) };
        item.as_bool().map(Some).ok_or_else(|| self.value_error(key, item, "true or false"))
    }

    /// A text in quotes.
    pub(crate) fn text(&self, key: &str) -> Result<Option<&'a str>> {
        let Some(item) = self.table.get(key) else { return Ok(None) };
        item.as_str().map(Some).ok_or_else(|| self.value_error(key, item, "a text in quotes"))
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
