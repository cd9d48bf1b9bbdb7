//! Changes of the machine file by hand.

use helixlock_plant::MachineFile;
use serde::{Deserialize, Serialize};

use super::folder::Folder;
use super::ledger::{Pair, Seen};
use super::refusal::{Answered, Refusal, json};
use super::state::without_folder;

/// A text that is to be the machine file.
#[derive(Debug, Deserialize)]
pub(crate) struct Text {
    pub(crate) text: String,
}

/// A text with another value for one of its keys.
#[derive(Debug, Deserialize)]
pub(crate) struct Setting {
    text: String,
    key: String,
    /// TOML.
    value: String,
}

#[derive(Serialize)]
struct TextJson {
    text: String,
}

#[derive(Serialize)]
struct CheckJson {
    errors: Vec<String>,
    title: Option<String>,
    lead_mm: Option<f64>,
    left_um_per_m: Option<f64>,
    gears: Vec<GearJson>,
}

#[derive(Serialize)]
struct GearJson {
    name: String,
    order: f64,
    teeth: Option<u32>,
}

/// What is wrong with a text, and what it says where nothing is.
pub(crate) fn check(folder: &Folder, name: &str, text: &str) -> Answered {
    let path = folder.path(name)?;
    let parsed = MachineFile::parse(text, &path);
    let machine = parsed.as_ref().ok().map(|file| &file.model.machine);
    let gears = machine.map(|machine| machine.gears.as_slice()).unwrap_or_default();
    let gear = |gear: &helixlock_plant::machine::Gear| GearJson {
        name: gear.name.clone(),
        order: gear.order,
        teeth: gear.teeth,
    };
    json(&CheckJson {
        title: machine.map(|machine| machine.title.clone()),
        lead_mm: machine.map(|machine| machine.workpiece.lead.mm()),
        left_um_per_m: machine.map(helixlock_plant::rationalisation_um_per_m),
        gears: gears.iter().map(gear).collect(),
        errors: parsed.err().map(|e| without_folder(folder, &e.to_string())).into_iter().collect(),
    })
}

/// A text with another value, comments and order kept; nothing is written.
pub(crate) fn set(folder: &Folder, name: &str, setting: &Setting) -> Answered {
    let file = MachineFile::parse(&setting.text, &folder.path(name)?)?;
    let text = file.with_setting(&setting.key, &setting.value)?.text();
    json(&TextJson { text })
}

/// Writes a machine file; a text that is none is refused. One that had rounds keeps the text it
/// had, so that the change can be undone.
pub(crate) fn write(folder: &Folder, name: &str, text: &str) -> Result<(), Refusal> {
    MachineFile::parse(text, &folder.path(name)?)?;
    if folder.has(name) {
        let pair = Pair::read(folder, name)?;
        if pair.book()?.is_some() {
            let book = pair.current(&Seen::default())?;
            pair.write(folder, &book, text)?;
            return Ok(());
        }
    }
    Ok(folder.write(&[(name, text.as_bytes())])?)
}

/// The machine file with other values for keys such as `dividers.a`.
pub(crate) fn with_settings(
    folder: &Folder,
    name: &str,
    settings: &[(String, String)],
) -> Result<String, Refusal> {
    let mut file = MachineFile::parse(&folder.text(name)?, &folder.path(name)?)?;
    for (key, value) in settings {
        file = file.with_setting(key, value)?;
    }
    Ok(file.text())
}
