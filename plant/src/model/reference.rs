//! The reference of the machine file, from the list its reader goes by.

use std::fmt::Write;

use super::keys::{Absent, ENVIRONMENT, Key, Kind, TABLES, TITLE};
use crate::record::LOGGED_COLUMNS;
use crate::units::{Dimension, UNITS, Unit, spellings};

/// Every section and key, as a page of Markdown.
#[must_use]
pub fn reference() -> String {
    let mut page = String::from(HEAD);
    page.push_str("## At the top\n\n");
    rows(&mut page, &[TITLE]);
    for table in TABLES {
        let (open, close) = if table.many { ("[[", "]]") } else { ("[", "]") };
        // Writing to a `String` cannot fail.
        let _ = write!(page, "\n## `{open}{}{close}`\n\n{}\n\n", table.name, table.about);
        rows(&mut page, table.keys);
    }
    environment(&mut page);
    page.push_str(EFFECTS);
    units(&mut page);
    page
}

const HEAD: &str = "\
# The machine file

Generated from the list that the reader goes by, `plant/src/model/keys.rs`;
`UPDATE_EXPECT=1 cargo test -p helixlock-plant reference` writes it anew.

A machine file is TOML. `helixlock init --template NAME` writes one for a kind of machine, with comments.
A part that the machine does not have is left out, and no effect of it is looked for: only `[spindle]`
must be there, and `[workpiece]`, `[lead_screw]` or `output.rotary = true` to say what moves.
A quantity is a text in quotes, a number and its unit; any unit of its kind will do.

";

const EFFECTS: &str = "
## `[[effect]]`

What makes the machine differ from how it was meant. `kind` is a name of the [catalogue](effects.md), and the
parameters on its page are the other keys; on a rotary chain what is µm there is seconds of arc, except for
a length of a part. Two kinds are the user's own:

```toml
[[effect]]
kind = \"custom\"
name = \"pump\"
entry = \"motion\"                 # where it enters: see the catalogue
formula = \"a*sin(2*pi*time_s/period)\"
parameters = { a = 1.5, period = 12.0 }

[[effect]]
kind = \"measured-curve\"
file = \"curve.csv\"               # beside the machine file
scale = 1.0
```
";

fn rows(page: &mut String, keys: &[Key]) {
    page.push_str(
        "| key | is | allowed | default | example | meaning |\n|---|---|---|---|---|---|\n",
    );
    for key in keys {
        let _ = writeln!(
            page,
            "| `{}` | {} | {} | {} | `{}` | {} |",
            key.name,
            kind(&key.kind),
            allowed(&key.kind),
            absent(key),
            key.line(),
            key.meaning
        );
    }
}

fn kind(kind: &Kind) -> &'static str {
    match kind {
        Kind::Text => "text",
        Kind::Flag => "true or false",
        Kind::Lead => "lead",
        Kind::Whole(_) => "whole number",
        Kind::Number(_) => "number",
        Kind::Quantity(..) => "quantity",
    }
}

fn allowed(kind: &Kind) -> String {
    match kind {
        Kind::Text | Kind::Flag => "any".into(),
        Kind::Lead => "0.001 mm to 1000 mm".into(),
        Kind::Whole(range) => format!("{} to {}", range.start(), range.end()),
        Kind::Number(range) => format!("{:e} to {:e}", range.start(), range.end()),
        Kind::Quantity(unit, range) => format!("{} to {} {unit}", range.start(), range.end()),
    }
}

fn absent(key: &Key) -> String {
    let unit = match &key.kind {
        Kind::Quantity(unit, _) => format!(" {unit}"),
        _ => String::new(),
    };
    match key.absent {
        Absent::Refused => "must be there".into(),
        Absent::Number(number) => format!("{number}{unit}"),
        Absent::Means(words) => words.into(),
    }
}

/// Readings that are constant; a log of the same name goes before.
fn environment(page: &mut String) {
    let _ = write!(
        page,
        "\n## `[{ENVIRONMENT}]`\n\nWhat the sensors around the machine say, for data without a log \
         of it.\n\n| key | allowed | is the column |\n|---|---|---|\n"
    );
    for column in LOGGED_COLUMNS {
        if let Some(setting) = &column.setting {
            let (low, high, unit) = (setting.range.start(), setting.range.end(), setting.unit);
            let _ = writeln!(
                page,
                "| `{}` | {low} to {high} {unit} | `{}` |",
                setting.key, column.name
            );
        }
    }
}

/// The units of each kind of quantity.
fn units(page: &mut String) {
    page.push_str("\n## Units\n\nµ may stand for u, and °C for degC.\n\n");
    let mut shown: Vec<Dimension> = Vec::new();
    for Unit { dimension, .. } in UNITS {
        if !shown.contains(dimension) {
            shown.push(*dimension);
            let _ = writeln!(page, "- {}", spellings(*dimension));
        }
    }
}
