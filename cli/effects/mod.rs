//! `helixlock effects`: the catalogue, or one of its pages.

use std::io::Write;
use std::process::ExitCode;

use anyhow::{Context, bail};
use comfy_table::{Table, presets};
use helixlock_plant::effects::page;
use helixlock_plant::{CATALOGUE, Card, Parameter, Role};
use serde_json::{Value, json};

/// The catalogue of physical effects, or all about one of them
#[derive(Debug, clap::Args)]
pub(crate) struct Effects {
    /// Effect to show, such as "abbe"
    effect: Option<String>,

    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl Effects {
    pub(crate) fn run(self, out: &mut impl Write) -> anyhow::Result<ExitCode> {
        match (self.effect.as_deref().map(named).transpose()?, self.json) {
            (Some(card), false) => write!(out, "{}", page(card))?,
            (Some(card), true) => write_json(out, &card_json(card))?,
            (None, false) => writeln!(out, "{}", overview())?,
            (None, true) => {
                let cards: Vec<_> = CATALOGUE.iter().map(|card| card_json(card)).collect();
                write_json(out, &json!({ "effects": cards }))?;
            }
        }
        Ok(ExitCode::SUCCESS)
    }
}

fn named(name: &str) -> anyhow::Result<&'static Card> {
    let Some(card) = CATALOGUE.iter().find(|card| card.kind == name) else {
        let kinds: Vec<_> = CATALOGUE.iter().map(|card| card.kind).collect();
        bail!("effect `{name}` is unknown, expected one of {}", kinds.join(", "));
    };
    Ok(card)
}

fn overview() -> Table {
    let mut table = Table::new();
    table.load_style(presets::UTF8_FULL_CONDENSED).set_header(["effect", "entry", "what happens"]);
    for card in CATALOGUE {
        table.add_row([card.kind, card.entry.word(), card.summary]);
    }
    table
}

fn card_json(card: &Card) -> Value {
    let parameters: Vec<_> = card.parameters.iter().map(parameter_json).collect();
    json!({
        "effect": card.kind,
        "entry": card.entry.word(),
        "summary": card.summary,
        "formula": card.formula,
        "example": card.example,
        "parameters": parameters,
        "needs": card.needs,
        "signature": card.signature,
        "confused_with": card.confused_with,
        "separated_by": card.separated_by,
        "source": card.source,
        "candidate": card.candidate,
        "random": card.random,
    })
}

fn parameter_json(parameter: &Parameter) -> Value {
    json!({
        "name": parameter.name,
        "key": parameter.key(),
        "unit": parameter.unit.symbol,
        "low": parameter.range.start(),
        "high": parameter.range.end(),
        "default": parameter.default,
        "linear": parameter.role != Role::Nonlinear,
        "meaning": parameter.meaning,
    })
}

fn write_json(out: &mut impl Write, value: &Value) -> anyhow::Result<()> {
    serde_json::to_writer_pretty(&mut *out, value).context("standard output")?;
    writeln!(out)?;
    Ok(())
}
