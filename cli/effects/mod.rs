//! `helixlock effects`: the catalogue, or one of its pages.

use std::io::Write;
use std::process::ExitCode;

use anyhow::bail;
use comfy_table::{Table, presets};
use helixlock_plant::effects::page;
use helixlock_plant::nearest::one_of;
use helixlock_plant::{CATALOGUE, Card, Parameter, Role};

use crate::shared::keys::keys;
use crate::shared::next::Next;
use crate::shared::output::print_json;

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
            (Some(card), true) => print_json(out, &CardJson::new(card))?,
            (None, false) => {
                writeln!(out, "{}", overview())?;
                Next::command("effects").words([CATALOGUE[0].kind]).print(out)?;
            }
            (None, true) => print_json(out, &CatalogueJson::new(CATALOGUE))?,
        }
        Ok(ExitCode::SUCCESS)
    }
}

fn named(name: &str) -> anyhow::Result<&'static Card> {
    let Some(card) = CATALOGUE.iter().find(|card| card.kind == name) else {
        let kinds: Vec<_> = CATALOGUE.iter().map(|card| card.kind).collect();
        bail!("effect `{name}` is unknown, expected {}", one_of(name, &kinds));
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

keys! {
    CatalogueJson(cards: &[&'static Card]) {
        effects: Vec<CardJson> = cards.iter().map(|card| CardJson::new(card)).collect(),
    }

    CardJson(card: &'static Card) {
        effect: &'static str = card.kind,
        entry: &'static str = card.entry.word(),
        summary: &'static str = card.summary,
        formula: &'static str = card.formula,
        example: &'static str = card.example,
        parameters: Vec<ParameterJson> = card.parameters.iter().map(ParameterJson::new).collect(),
        parts: Vec<&'static str> = card.parts.iter().map(|part| part.word()).collect(),
        needs: &'static [&'static str] = card.needs,
        signature: &'static str = card.signature,
        confused_with: &'static [&'static str] = card.confused_with,
        separated_by: &'static str = card.separated_by,
        source: &'static str = card.source,
        candidate: bool = card.candidate,
        random: bool = card.random,
    }

    ParameterJson(parameter: &'static Parameter) {
        name: &'static str = &parameter.name,
        key: String = parameter.key(),
        unit: &'static str = parameter.unit.symbol,
        low: f64 = *parameter.range.start(),
        high: f64 = *parameter.range.end(),
        default: Option<f64> = parameter.default,
        linear: bool = parameter.role != Role::Nonlinear,
        meaning: &'static str = &parameter.meaning,
    }
}
