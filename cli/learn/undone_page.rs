//! Report of `helixlock learn --undo`: what stands of a ledger.

use helixlock_report::{Page, Part, Table};
use serde_json::Value;

use crate::shared::angular::key_in;
use crate::shared::diagnosis_page::{Left, falling};
use crate::shared::words::change;

/// The page of a ledger whose last standing round has been taken back.
pub(crate) fn page(book: &Value) -> Page {
    let unit = if book["unit"] == "arcsec" { "arcsec" } else { "µm" };
    let rounds = book["rounds"].as_array().map(Vec::as_slice).unwrap_or_default();
    let (taken, standing): (Vec<&Value>, Vec<&Value>) =
        rounds.iter().partition(|round| round["taken_back"] == true);
    let names = |rounds: &[&Value]| {
        let names: Vec<&str> = rounds.iter().filter_map(|round| round["added"].as_str()).collect();
        if names.is_empty() { "nothing".to_owned() } else { names.join(", ") }
    };
    let left: Vec<Left> = standing.iter().map(|round| left(round, unit)).collect();
    let summary = format!(
        "The machine file has {} in it; taken back: {}. The pictures of the data were of the last round: learn again to see them.",
        names(&standing),
        names(&taken)
    );
    let parts = vec![
        falling(&left, unit),
        Part::Heading("Rounds".into()),
        Part::Table(table(rounds, unit)),
    ];
    let title = book["title"].as_str().unwrap_or("Machine");
    Page { title: format!("{title}: what the model lacked"), summary, parts }
}

fn left(round: &Value, unit: &str) -> Left {
    let unit = if unit == "arcsec" { "arcsec" } else { "um" };
    let number = |key: &str| round[key_in(key, unit)].as_f64().unwrap_or(0.0);
    let dropped = round["dropped"].as_array().into_iter().flatten();
    let dropped: Vec<&str> = dropped.filter_map(Value::as_str).collect();
    Left {
        change: change(round["added"].as_str(), &dropped),
        rms_um: number("rms_um"),
        holdout_rms_um: number("holdout_rms_um"),
    }
}

fn table(rounds: &[Value], unit: &str) -> Table {
    let (seen, unseen) = (format!("rms in {unit}"), format!("held out in {unit}"));
    let mut table = Table::new(["round", "change", seen.as_str(), unseen.as_str(), ""]);
    for round in rounds {
        let left = left(round, unit);
        table.row([
            round["round"].to_string(),
            left.change,
            format!("{:.4}", left.rms_um),
            format!("{:.4}", left.holdout_rms_um),
            if round["taken_back"] == true { "taken back" } else { "" }.to_owned(),
        ]);
    }
    table
}
