//! One TOML table after another, each complaint with its line.

use std::ops::Range;
use std::path::Path;

use anyhow::{anyhow, bail};
use helixlock_metrology::uncertainty::{Acts, Distribution, Source};
use helixlock_plant::units::{Unit, read_quantity, spellings};
use helixlock_traces::At;
use toml_edit::{Item, TableLike};

/// A difference of temperatures, whose zero is zero.
pub(super) const KELVIN: Unit = Unit::difference("K");

/// No uncertainty in any of the units reaches this.
const LARGEST: f64 = 1e9;
const SPREAD: [&str; 5] = ["expanded", "standard", "range", "k", "degrees_of_freedom"];

/// The text that is read, for the places of what is wrong.
pub(super) struct Reader<'a> {
    pub(super) path: &'a Path,
    pub(super) text: &'a str,
}

impl Reader<'_> {
    pub(super) fn at(&self, span: Option<Range<usize>>) -> At {
        let before = self.text.get(..span.map_or(0, |span| span.start)).unwrap_or("");
        At::file(self.path).on_line(1 + before.matches('\n').count())
    }

    pub(super) fn only(
        &self,
        table: &dyn TableLike,
        name: &str,
        keys: &[&str],
    ) -> anyhow::Result<()> {
        let Some((found, _)) = table.iter().find(|(key, _)| !keys.contains(key)) else {
            return Ok(());
        };
        let place = self.at(table.key(found).and_then(toml_edit::Key::span));
        let expected =
            if keys.is_empty() { "none".into() } else { format!("one of `{}`", keys.join("`, `")) };
        bail!("{place}: unknown key `{found}` in {name}, expected {expected}")
    }

    /// A table below another, with none but its keys.
    pub(super) fn table<'a>(
        &self,
        root: &'a dyn TableLike,
        name: &str,
        keys: &[&str],
    ) -> anyhow::Result<Option<&'a dyn TableLike>> {
        let Some(table) = self.section(root, name)? else { return Ok(None) };
        self.only(table, &format!("`[{name}]`"), keys)?;
        Ok(Some(table))
    }

    /// A table below another, whatever is in it.
    pub(super) fn section<'a>(
        &self,
        root: &'a dyn TableLike,
        name: &str,
    ) -> anyhow::Result<Option<&'a dyn TableLike>> {
        let Some(item) = root.get(name) else { return Ok(None) };
        match item.as_table_like() {
            Some(table) => Ok(Some(table)),
            None => bail!("{}: `{name}` is no table, expected `[{name}]`", self.at(item.span())),
        }
    }

    pub(super) fn text(
        &self,
        table: Option<&dyn TableLike>,
        key: &str,
    ) -> anyhow::Result<Option<String>> {
        let Some(item) = table.and_then(|table| table.get(key)) else { return Ok(None) };
        match item.as_str() {
            Some(text) => Ok(Some(text.to_owned())),
            None => bail!("{}: `{key}` is no string, expected one", self.at(item.span())),
        }
    }

    pub(super) fn quantity(&self, item: &Item, key: &str, unit: &Unit) -> anyhow::Result<f64> {
        let expected = || match unit.symbol {
            "K" => "K".to_owned(),
            _ => spellings(unit.dimension),
        };
        let Some(text) = item.as_str() else {
            bail!(
                "{}: `{key}` is no string, expected one such as \"0.5 {unit}\"",
                self.at(item.span())
            );
        };
        read_quantity(text, unit).map_err(|error| {
            anyhow!(
                "{}: `{key}`: {error} in `{text}`, expected a number with one of {}",
                self.at(item.span()),
                expected()
            )
        })
    }

    fn number(&self, table: &dyn TableLike, key: &str) -> anyhow::Result<Option<f64>> {
        let Some(item) = table.get(key) else { return Ok(None) };
        #[expect(clippy::cast_precision_loss, reason = "whole numbers here are small")]
        let number = item.as_float().or_else(|| item.as_integer().map(|whole| whole as f64));
        match number.filter(|number| 0.0 < *number && number.is_finite()) {
            Some(number) => Ok(Some(number)),
            None => bail!("{}: `{key}`, expected a number above 0", self.at(item.span())),
        }
    }

    /// An input quantity whose uncertainty is told in one of three ways.
    pub(super) fn source(
        &self,
        table: Option<&dyn TableLike>,
        (key, quantity): (&str, &str),
        unit: &Unit,
        acts: Acts,
    ) -> anyhow::Result<Option<Source>> {
        let Some(item) = table.and_then(|table| table.get(key)) else { return Ok(None) };
        let wrong = || {
            anyhow!(
                "{}: `{key}`, expected one of {{ expanded = … }}, {{ standard = … }}, {{ range = … }}",
                self.at(item.span())
            )
        };
        let spread = item.as_table_like().ok_or_else(wrong)?;
        self.only(spread, &format!("`{key}`"), &SPREAD)?;
        let told: Vec<(&str, &Item)> =
            SPREAD[..3].iter().filter_map(|way| Some((*way, spread.get(way)?))).collect();
        let &[(way, item)] = told.as_slice() else { return Err(wrong()) };
        let size = self.quantity(item, way, unit)?;
        if !(0.0..=LARGEST).contains(&size) {
            let place = self.at(item.span());
            bail!("{place}: `{way}` is {size} {unit}, expected 0 to {LARGEST:e}");
        }
        let k = self.number(spread, "k")?;
        if k.is_some() && way != "expanded" {
            return Err(anyhow!(
                "{}: `k` beside `{way}`, expected beside `expanded`",
                self.at(item.span())
            ));
        }
        let (standard, distribution) = match way {
            "expanded" => (size / k.unwrap_or(2.0), Distribution::Normal),
            "standard" => (size, Distribution::Normal),
            _ => (size / 12.0_f64.sqrt(), Distribution::Rectangular),
        };
        Ok(Some(Source {
            quantity: quantity.into(),
            estimate: 0.0,
            unit: unit.symbol,
            standard,
            distribution,
            degrees_of_freedom: self.number(spread, "degrees_of_freedom")?.unwrap_or(f64::INFINITY),
            acts,
        }))
    }
}
