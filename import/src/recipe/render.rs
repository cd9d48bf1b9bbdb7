//! A recipe as TOML: a comment behind every decision says why.

use std::fmt;

use toml_edit::Value as Toml;

use super::{ColumnRule, KEYS, Recipe, Setting, Value};

const HEAD: &str = "\
# How a file became a table: `helixlock import FILE --recipe THIS -o data.csv` does the same again.
# Whatever is left out is found out anew; behind every decision stands its reason.
";

impl fmt::Display for Recipe {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(HEAD)?;
        let mut section = "";
        for key in KEYS {
            let name = (key.section.to_owned(), key.name.to_owned());
            let Some(setting) = self.settings.get(&name) else { continue };
            if section != key.section {
                section = key.section;
                write!(f, "\n[{section}]\n")?;
            }
            write_setting(f, key.name, setting)?;
        }
        self.columns.iter().try_for_each(|rule| write_rule(f, rule))
    }
}

fn write_setting(f: &mut fmt::Formatter<'_>, name: &str, setting: &Setting) -> fmt::Result {
    write!(f, "{name} = {}", toml(&setting.value))?;
    write_reason(f, &setting.reason)
}

fn write_rule(f: &mut fmt::Formatter<'_>, rule: &ColumnRule) -> fmt::Result {
    write!(f, "\n[[column]]")?;
    write_reason(f, &rule.reason)?;
    let word = |f: &mut fmt::Formatter<'_>, name: &str, value: &Option<String>| match value {
        Some(value) => writeln!(f, "{name} = {}", toml(&Value::Text(value.clone()))),
        None => Ok(()),
    };
    let whole = |f: &mut fmt::Formatter<'_>, name: &str, value: Option<i64>| match value {
        Some(value) => writeln!(f, "{name} = {value}"),
        None => Ok(()),
    };
    word(f, "from", &Some(rule.from.clone()))?;
    word(f, "to", &rule.to)?;
    word(f, "unit", &rule.unit)?;
    whole(f, "sign", rule.sign)?;
    word(f, "minus", &rule.minus)?;
    word(f, "with", &rule.with)?;
    whole(f, "pass", rule.pass)?;
    whole(f, "direction", rule.direction)
}

fn write_reason(f: &mut fmt::Formatter<'_>, reason: &str) -> fmt::Result {
    if reason.is_empty() {
        return writeln!(f);
    }
    let line: String = reason.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    writeln!(f, " # {}", line.trim())
}

fn toml(value: &Value) -> String {
    match value {
        Value::Text(text) => Toml::from(text.as_str()).to_string(),
        Value::Whole(whole) => whole.to_string(),
        Value::Number(number) => Toml::from(*number).to_string(),
        Value::List(words) => {
            let words: Vec<_> = words.iter().map(|w| Toml::from(w.as_str()).to_string()).collect();
            format!("[{}]", words.join(", "))
        }
    }
}
