//! A recipe from TOML, with the place of whatever is wrong in it.

use std::ops::Range;

use toml_edit::{Document, Item, TableLike};

use super::{ColumnRule, KEYS, Key, Kind, Recipe, Value};
use crate::error::{ImportError, quoted};
use crate::place::Place;

impl Recipe {
    /// Reads a recipe; `name` is for messages.
    ///
    /// # Errors
    ///
    /// Text that is no TOML, a key that is not known, a value of another kind: with line and column.
    pub fn parse(text: &str, name: &str) -> Result<Self, ImportError> {
        let source = Source { text, name };
        let document = Document::parse(text).map_err(|error| {
            let place = source.place(error.span());
            ImportError::found(place, error.message().trim().replace('\n', ", "), "TOML")
        })?;
        let mut recipe = Self::default();
        for (section, item) in document.iter() {
            if section == "column" {
                recipe.columns = source.columns(item)?;
            } else {
                source.section(section, item, &mut recipe)?;
            }
        }
        Ok(recipe)
    }
}

struct Source<'a> {
    text: &'a str,
    name: &'a str,
}

impl Source<'_> {
    fn place(&self, span: Option<Range<usize>>) -> Place {
        let before = self.text.get(..span.map_or(0, |span| span.start)).unwrap_or("");
        let line_start = before.rfind('\n').map_or(0, |end| end + 1);
        let line = 1 + before.matches('\n').count();
        let mut place = Place::line(self.name, line);
        place.at.column = Some(1 + before[line_start..].chars().count());
        place
    }

    /// The comment behind something, to the end of its line.
    fn reason(&self, span: Option<Range<usize>>) -> String {
        let rest = span.and_then(|span| self.text.get(span.end..)).unwrap_or_default();
        let line = rest.lines().next().unwrap_or_default();
        line.trim().strip_prefix('#').unwrap_or_default().trim().to_owned()
    }

    fn section(&self, name: &str, item: &Item, recipe: &mut Recipe) -> Result<(), ImportError> {
        let known = |key: &&Key| key.section == name;
        let Some(table) = item.as_table_like().filter(|_| KEYS.iter().any(|key| known(&key)))
        else {
            let mut sections: Vec<_> = KEYS.iter().map(|key| key.section).collect();
            sections.dedup();
            let list = format!("one of `[{}]`, `[[column]]`", sections.join("]`, `["));
            return Err(ImportError::found(self.place(item.span()), format!("`{name}`"), list));
        };
        for (word, item) in table.iter() {
            let Some(key) = KEYS.iter().filter(known).find(|key| key.name == word) else {
                let names: Vec<_> = KEYS.iter().filter(known).map(|key| key.name).collect();
                return Err(self.unknown(table, word, &names));
            };
            let value = self.value(key, item)?;
            recipe.set(name, word, value, self.reason(item.span()));
        }
        Ok(())
    }

    fn unknown(&self, table: &dyn TableLike, word: &str, names: &[&str]) -> ImportError {
        let place = self.place(table.key(word).and_then(toml_edit::Key::span));
        let list = format!("one of `{}`", names.join("`, `"));
        ImportError::found(place, format!("the key {}", quoted(word)), list)
    }

    fn value(&self, key: &Key, item: &Item) -> Result<Value, ImportError> {
        let wrong = |expected: String| {
            let found = quoted(item.to_string().trim());
            Err(ImportError::found(self.place(item.span()), found, expected))
        };
        match key.kind {
            Kind::Text(words) => match item.as_str() {
                Some(text) if words.is_empty() || words.contains(&text) => {
                    Ok(Value::Text(text.to_owned()))
                }
                _ if words.is_empty() => wrong(format!("a text: {}", key.meaning)),
                _ => wrong(format!("one of \"{}\"", words.join("\", \""))),
            },
            Kind::Whole(low, high) => match item.as_integer() {
                Some(whole) if (low..=high).contains(&whole) => Ok(Value::Whole(whole)),
                _ => wrong(format!("a whole number from {low} to {high}")),
            },
            Kind::Number => {
                let number = item.as_float().or_else(|| whole_number(item));
                match number.filter(|number| number.is_finite()) {
                    Some(number) => Ok(Value::Number(number)),
                    None => wrong("a number".to_owned()),
                }
            }
            Kind::List => {
                let words = item.as_array().and_then(|array| {
                    array.iter().map(|word| word.as_str().map(ToOwned::to_owned)).collect()
                });
                words.map_or_else(|| wrong("a list of words".to_owned()), |w| Ok(Value::List(w)))
            }
        }
    }

    fn columns(&self, item: &Item) -> Result<Vec<ColumnRule>, ImportError> {
        let Some(tables) = item.as_array_of_tables() else {
            return Err(ImportError::found(self.place(item.span()), "`column`", "`[[column]]`"));
        };
        let mut rules: Vec<ColumnRule> = Vec::new();
        for table in tables {
            let rule = self.rule(table)?;
            if rules.iter().any(|known| known.from == rule.from) {
                let found = format!("the column {} again", quoted(&rule.from));
                let place = self.place(table.span());
                return Err(ImportError::found(place, found, "one rule a column"));
            }
            rules.push(rule);
        }
        Ok(rules)
    }

    fn rule(&self, table: &toml_edit::Table) -> Result<ColumnRule, ImportError> {
        const NAMES: [&str; 8] =
            ["from", "to", "unit", "sign", "minus", "with", "pass", "direction"];
        const SIGNS: Kind = Kind::Whole(-1, 1);
        let mut rule = ColumnRule {
            reason: self.reason(table.span()),
            place: self.place(table.span()),
            ..ColumnRule::default()
        };
        for (word, item) in table {
            let kind = match word {
                "sign" | "direction" => SIGNS,
                "pass" => Kind::Whole(1, 1_000_000),
                _ => Kind::Text(&[]),
            };
            let key = Key { section: "column", name: "", kind, meaning: "a name" };
            if !NAMES.contains(&word) {
                return Err(self.unknown(table, word, &NAMES));
            }
            match (word, self.value(&key, item)?) {
                ("from", Value::Text(text)) => rule.from = text,
                ("to", Value::Text(text)) => rule.to = Some(text),
                ("unit", Value::Text(text)) => rule.unit = Some(text),
                ("minus", Value::Text(text)) => rule.minus = Some(text),
                ("with", Value::Text(text)) => rule.with = Some(text),
                ("pass", Value::Whole(whole)) => rule.pass = Some(whole),
                (_, Value::Whole(0)) => {
                    let place = self.place(item.span());
                    return Err(ImportError::found(place, "`0`", "1 or -1"));
                }
                ("sign", Value::Whole(whole)) => rule.sign = Some(whole),
                ("direction", Value::Whole(whole)) => rule.direction = Some(whole),
                _ => {}
            }
        }
        if rule.from.is_empty() {
            let place = self.place(table.span());
            return Err(ImportError::found(place, "no `from`", "the name of a column of the file"));
        }
        Ok(rule)
    }
}

#[expect(clippy::cast_precision_loss, reason = "a person writes small numbers")]
fn whole_number(item: &Item) -> Option<f64> {
    item.as_integer().map(|whole| whole as f64)
}
