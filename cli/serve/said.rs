//! What the libraries say, in the language of the page.

use helixlock_plant::{CATALOGUE, Card};
use helixlock_workbench::Ask;
use serde::{Deserialize, Serialize};

use super::refusal::{Answered, json};
use crate::shared::language::Language;

/// Texts in English.
#[derive(Debug, Deserialize)]
pub(crate) struct Texts {
    texts: Vec<String>,
}

#[derive(Serialize)]
struct CardJson {
    effect: &'static str,
    /// Where in the machine it enters.
    entry: &'static str,
    summary: String,
    signature: String,
    confused_with: &'static [&'static str],
    separated_by: String,
}

/// The language of the page that asks.
pub(crate) fn language(ask: &Ask) -> Language {
    match ask.words.get("language").map(String::as_str) {
        Some("zh") => Language::Zh,
        _ => Language::En,
    }
}

/// The texts, each in the language.
pub(crate) fn said(language: Language, given: &Texts) -> Answered {
    json(&given.texts.iter().map(|text| language.of(text)).collect::<Vec<_>>())
}

/// What the catalogue says of every effect.
pub(crate) fn catalogue(language: Language) -> Answered {
    let told = |card: &Card| CardJson {
        effect: card.kind,
        entry: card.entry.word(),
        summary: language.of(card.summary),
        signature: language.of(card.signature),
        confused_with: card.confused_with,
        separated_by: language.of(card.separated_by),
    };
    json(&CATALOGUE.iter().map(|card| told(card)).collect::<Vec<_>>())
}
