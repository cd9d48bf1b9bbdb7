//! What a page is shown first: the files, the machine, the ledger.

use std::path::Path;

use helixlock_plant::MachineFile;
use serde::Serialize;
use serde_json::Value;

use super::folder::Folder;
use super::ledger::Pair;
use super::refusal::{Answered, json};
use super::waves::SIMULATION;

#[derive(Serialize)]
struct StateJson {
    revision: String,
    folder: String,
    machines: Vec<String>,
    tables: Vec<String>,
    machine: Option<MachineJson>,
    ledger: Option<Value>,
    can_undo: bool,
    can_redo: bool,
    /// True when a simulated run lies in the folder.
    simulated: bool,
}

#[derive(Serialize)]
struct MachineJson {
    name: String,
    text: String,
    error: Option<String>,
    title: Option<String>,
    effects: Vec<String>,
    own_effects: usize,
}

/// True for a name that may be a machine file.
fn may_be_machine(name: &str) -> bool {
    ends(name, "toml") && !ends(name.strip_suffix(".toml").unwrap_or_default(), "recipe")
}

fn may_be_table(name: &str) -> bool {
    ["csv", "parquet", "vcd"].iter().any(|ending| ends(name, ending))
}

fn ends(name: &str, ending: &str) -> bool {
    Path::new(name).extension().is_some_and(|own| own.eq_ignore_ascii_case(ending))
}

/// The state of a folder, seen with one of its machine files.
pub(crate) fn state(folder: &Folder, machine: Option<&str>) -> Answered {
    let names = folder.names()?;
    let pick = |fits: fn(&str) -> bool| -> Vec<String> {
        names.iter().filter(|name| fits(name)).cloned().collect()
    };
    let machines = pick(may_be_machine);
    let usual = || machines.iter().find(|name| *name == "machine.toml").or(machines.first());
    let chosen =
        machine.and_then(|name| machines.iter().find(|known| *known == name)).or_else(usual);
    let pair = chosen.map(|name| Pair::read(folder, name)).transpose()?;
    let book = pair.as_ref().map(Pair::book).transpose()?.flatten();
    json(&StateJson {
        revision: pair.as_ref().map(Pair::revision).unwrap_or_default(),
        folder: folder.root().display().to_string(),
        tables: pick(may_be_table),
        machine: pair.as_ref().map(|pair| machine_json(folder, pair)),
        can_undo: book.as_ref().is_some_and(super::rounds::Book::can_undo),
        can_redo: book.as_ref().is_some_and(super::rounds::Book::can_redo),
        simulated: folder.has(&format!("{SIMULATION}/wave.vcd")),
        ledger: book.map(|book| book.value().clone()),
        machines,
    })
}

fn machine_json(folder: &Folder, pair: &Pair) -> MachineJson {
    let path = folder.path(&pair.name).unwrap_or_default();
    let parsed = MachineFile::parse(&pair.machine, &path);
    let file = parsed.as_ref().ok();
    let effects =
        file.map(|file| file.model.effects.iter().map(|term| term.name.clone()).collect());
    MachineJson {
        name: pair.name.clone(),
        text: pair.machine.clone(),
        title: file.map(|file| file.model.title.clone()),
        effects: effects.unwrap_or_default(),
        own_effects: file.map_or(0, |file| pair.own_effects(file)),
        error: parsed.err().map(|error| without_folder(folder, &error.to_string())),
    }
}

/// A message that names files as the page does.
pub(crate) fn without_folder(folder: &Folder, message: &str) -> String {
    message.replace(&format!("{}/", folder.root().display()), "")
}
