//! What was decided, in words and as JSON.

use std::io::Write;
use std::path::Path;

use helixlock_import::recipe::KEYS;
use helixlock_import::{ColumnRule, Proposal, Value};
use serde_json::{Value as Json, json};

/// Decisions, columns and what came out.
pub(crate) fn print(
    out: &mut impl Write,
    proposal: &Proposal,
    output: Option<&Path>,
) -> anyhow::Result<()> {
    for key in KEYS {
        let name = (key.section.to_owned(), key.name.to_owned());
        let Some(setting) = proposal.recipe.settings.get(&name) else { continue };
        let words = [word(&setting.value), reason(&setting.reason)].concat();
        writeln!(out, "{:<12}{words}", key.name.replace('_', " "))?;
    }
    for rule in &proposal.recipe.columns {
        let to = rule.to.as_deref().unwrap_or("none");
        writeln!(out, "  {} → {to}{}{}", rule.from, details(rule), reason(&rule.reason))?;
    }
    for note in &proposal.notes {
        writeln!(out, "note: {note}")?;
    }
    let table = &proposal.table;
    let runs = table.column("pass").map_or(0, count);
    let names: Vec<_> = table.names().collect();
    let of_runs = match runs {
        0 => String::new(),
        1 => " in 1 run".to_owned(),
        _ => format!(" in {runs} runs"),
    };
    writeln!(out, "{} rows{of_runs}: {}", table.rows(), names.join(", "))?;
    if let Some(output) = output {
        writeln!(out, "{} written, and its recipe beside it", output.display())?;
    }
    Ok(())
}

/// The same as data.
pub(crate) fn json(proposal: &Proposal) -> Json {
    let mut settings = serde_json::Map::new();
    for ((section, name), setting) in &proposal.recipe.settings {
        let value = json!({ "value": value_json(&setting.value), "reason": setting.reason });
        settings.insert(format!("{section}.{name}"), value);
    }
    let columns: Vec<_> = proposal.recipe.columns.iter().map(rule_json).collect();
    json!({
        "settings": settings,
        "columns": columns,
        "notes": proposal.notes,
        "rows": proposal.table.rows(),
        "runs": proposal.table.column("pass").map_or(0, count),
        "names": proposal.table.names().collect::<Vec<_>>(),
    })
}

fn rule_json(rule: &ColumnRule) -> Json {
    json!({
        "from": rule.from,
        "to": rule.to,
        "unit": rule.unit,
        "sign": rule.sign,
        "minus": rule.minus,
        "with": rule.with,
        "pass": rule.pass,
        "direction": rule.direction,
        "reason": rule.reason,
    })
}

fn value_json(value: &Value) -> Json {
    match value {
        Value::Text(text) => json!(text),
        Value::Whole(whole) => json!(whole),
        Value::Number(number) => json!(number),
        Value::List(words) => json!(words),
    }
}

fn word(value: &Value) -> String {
    match value {
        Value::Text(text) => text.clone(),
        Value::Whole(whole) => whole.to_string(),
        Value::Number(number) => number.to_string(),
        Value::List(words) => words.join(" "),
    }
}

fn reason(reason: &str) -> String {
    if reason.is_empty() { String::new() } else { format!("  ({reason})") }
}

fn details(rule: &ColumnRule) -> String {
    let unit = rule.unit.as_ref().map(|unit| format!(" [{unit}]"));
    let run = rule.pass.map(|pass| format!(" run {pass}"));
    let way = rule.direction.map(|way| if way == 1 { " there" } else { " back" }.to_owned());
    let turned = (rule.sign == Some(-1)).then(|| " × −1".to_owned());
    [unit, run, way, turned].into_iter().flatten().collect()
}

/// How many values there are of a column of counts.
fn count(values: &[f64]) -> usize {
    let mut known: Vec<u64> =
        values.iter().filter(|v| v.is_finite()).map(|v| v.to_bits()).collect();
    known.sort_unstable();
    known.dedup();
    known.len()
}
