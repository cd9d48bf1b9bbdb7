//! What a run finds in its folder and does not know: it gets another name before it is replaced.

use std::path::Path;

use helixlock_traces::{LONGEST_BYTES, read_bytes};
use serde_json::Value;

use super::{LEDGER, MACHINE};
use crate::shared::output::Batch;

/// Keeps a machine file that somebody edited, and a ledger with rounds that were taken back or with
/// effects that somebody refused.
///
/// Gives the name the machine file has got, if any. `known` is what is about to be written, and what
/// was read: nothing is lost when one of them is what lies there.
pub(super) fn keep_aside(files: &mut Batch, known: &[&str]) -> anyhow::Result<Option<String>> {
    let ledger = Ledger::read(files.folder());
    if ledger.rounds().iter().any(|round| is_taken_back(round) || has_refusals(round)) {
        files.write_content(&free_name(files.folder(), "ledger", "json"), &ledger.bytes)?;
    }
    ledger.edited_aside(files, known)
}

/// Keeps a machine file that somebody edited.
pub(super) fn edited_aside(files: &mut Batch) -> anyhow::Result<Option<String>> {
    Ledger::read(files.folder()).edited_aside(files, &[])
}

/// The ledger that lies in a folder; without rounds when there is none, or something else.
struct Ledger {
    bytes: Vec<u8>,
    book: Value,
}

impl Ledger {
    fn read(folder: &Path) -> Self {
        let bytes = read_bytes(&folder.join(LEDGER), LONGEST_BYTES).unwrap_or_default();
        let book = serde_json::from_slice(&bytes).unwrap_or_default();
        Self { bytes, book }
    }

    fn rounds(&self) -> &[Value] {
        self.book.get("rounds").and_then(Value::as_array).map_or(&[], Vec::as_slice)
    }

    fn edited_aside(&self, files: &mut Batch, known: &[&str]) -> anyhow::Result<Option<String>> {
        let path = files.folder().join(MACHINE);
        let Ok(machine) = read_bytes(&path, LONGEST_BYTES) else { return Ok(None) };
        let written = self.rounds().iter().filter_map(|round| round.get("machine")?.as_str());
        if written.chain(known.iter().copied()).any(|text| text.as_bytes() == machine) {
            return Ok(None);
        }
        let name = free_name(files.folder(), "machine", "toml");
        files.write_content(&name, machine)?;
        Ok(Some(name))
    }
}

/// True for a round that was taken back.
pub(super) fn is_taken_back(round: &Value) -> bool {
    round.get("taken_back").and_then(Value::as_bool) == Some(true)
}

/// True for a round with effects that somebody refused, each with the reason.
fn has_refusals(round: &Value) -> bool {
    round.get("refused").and_then(Value::as_array).is_some_and(|refused| !refused.is_empty())
}

/// The first of `stem-1.tail`, `stem-2.tail` … that is free.
fn free_name(folder: &Path, stem: &str, tail: &str) -> String {
    let mut number = 1_u32;
    while folder.join(format!("{stem}-{number}.{tail}")).exists() {
        number += 1;
    }
    format!("{stem}-{number}.{tail}")
}

/// What a user is told of it.
pub(super) fn note(kept: Option<&str>) -> String {
    kept.map_or(String::new(), |name| {
        format!("note: {MACHINE} was not as `learn` had left it: kept as {name}\n")
    })
}
