//! The catalogue in words: one page an effect, and all of them as the guide.

use std::fmt::Write;

use super::CATALOGUE;
use crate::{Card, Role};

/// An effect as a page of Markdown, from its name on.
#[must_use]
pub fn page(card: &Card) -> String {
    let mut page = format!("## `{}`\n\n{}.\n\n", card.kind, sentence(card.summary));
    let mut line = |name: &str, text: &str| {
        // Writing to a `String` cannot fail.
        let _ = writeln!(page, "- **{name}**: {text}");
    };
    line("δ", card.formula);
    line("example", card.example);
    line("entry", card.entry.word());
    if !card.parts.is_empty() {
        let parts: Vec<_> = card.parts.iter().map(|part| part.word()).collect();
        line("of a machine with", &parts.join(", "));
    }
    if !card.needs.is_empty() {
        line("needs", &format!("`{}`", card.needs.join("`, `")));
    }
    line("shows as", card.signature);
    if !card.confused_with.is_empty() {
        line("confused with", &format!("`{}`", card.confused_with.join("`, `")));
    }
    line("separated by", card.separated_by);
    line("source", card.source);
    line("role", role(card));
    page.push_str(&parameters(card));
    page
}

/// All pages, with what the columns of their tables mean.
#[must_use]
pub fn guide() -> String {
    let mut guide = String::from(HEAD);
    for card in CATALOGUE {
        guide.push('\n');
        guide.push_str(&page(card));
    }
    guide
}

const HEAD: &str = "\
# The effect catalogue

Generated from the cards in `plant/src/effects`; `UPDATE_EXPECT=1 cargo test -p helixlock-plant guide`
writes it anew.

An effect enters the machine at one place, and that decides who sees its δ (µm, or seconds of arc on a
rotary chain):

| entry | meaning of δ | recorder, open | recorder, closed | counter, closed | thread, open | thread, closed |
|---|---|---|---|---|---|---|
| `motion` | table is ahead by δ | −δ | 0 | −δ/step | +δ | 0 |
| `length-reference` | laser reads short by δ | +δ | 0 | +δ/step | 0 | +δ |
| `angle-reference` | grating reads ahead by δ | +δ | 0 | +δ/step | 0 | +δ |
| `workpiece` | thread ends up longer by δ | 0 | 0 | 0 | +δ | +δ |
| `electronics` | meter shows δ too much | +δ | 0 | +δ/step | 0 | +δ |
| `actuator` | correction falls short by δ | +δ | 0 | +δ/step | −δ | 0 |

An actuator effect is a function of the steps: without any it is 0. x is travel, θ the spindle angle, S the
lead, n the spindle speed, t the time since the start of the record, d the direction. A parameter is
*linear* when δ is proportional to it, *known* when physics fixes it and a fit may move it only a little,
*shape* when it decides the course of δ.
";

/// The first letter large.
fn sentence(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

fn role(card: &Card) -> &'static str {
    match (card.candidate, card.random) {
        (false, _) => "not looked for in data",
        (true, true) => "chance: simulated, and never named from data; its size shows as noise",
        (true, false) => "looked for in data",
    }
}

fn parameters(card: &Card) -> String {
    if card.parameters.is_empty() {
        return String::new();
    }
    let mut table = String::from(
        "\n| parameter | unit | plausible | default | kind | meaning |\n|---|---|---|---|---|---|\n",
    );
    for parameter in card.parameters {
        let default =
            parameter.default.map_or_else(|| "required".into(), |value| value.to_string());
        let kind = match parameter.role {
            Role::Linear | Role::Squared | Role::Start { .. } => "linear",
            Role::Amplitude => "amplitude",
            Role::Phase => "phase",
            Role::Known { .. } => "known",
            Role::Nonlinear => "shape",
        };
        let _ = writeln!(
            table,
            "| `{}` | {} | {} to {} | {default} | {kind} | {} |",
            parameter.name,
            if parameter.unit.symbol.is_empty() { "–" } else { parameter.unit.symbol },
            parameter.range.start(),
            parameter.range.end(),
            parameter.meaning,
        );
    }
    table
}
