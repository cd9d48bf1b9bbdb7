//! Changes of the machine file by hand.

use anyhow::anyhow;
use helixlock_plant::dividers::{COMPENSATOR_REACH_PPM, Task, USUAL_RANGE_UM, centre_phase, solve};
use helixlock_plant::{Machine, MachineFile, Part};
use serde::{Deserialize, Serialize};

use super::folder::Folder;
use super::ledger::{Pair, Seen};
use super::refusal::{Answered, Refusal, json};
use super::state::without_folder;
use crate::shared::next::Next;
use crate::shared::templates::{TEMPLATES, Template};

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
struct TemplateJson {
    name: &'static str,
    text: &'static str,
}

#[derive(Serialize)]
struct SolvedJson {
    text: String,
    /// The command that says the same.
    command: String,
}

#[derive(Serialize)]
struct CheckJson {
    /// A line each.
    errors: Vec<String>,
    title: Option<String>,
    lead_mm: Option<f64>,
    /// None where nothing divides.
    left_um_per_m: Option<f64>,
    /// Turns of the machine's own screw in one of the spindle.
    screw_order: Option<f64>,
    gears: Vec<GearJson>,
}

#[derive(Serialize)]
struct GearJson {
    name: String,
    order: f64,
    teeth: Option<u32>,
}

/// The texts there are to begin with, by kind of machine.
pub(crate) fn templates() -> Answered {
    let told = |template: &Template| TemplateJson { name: template.name, text: template.machine };
    json(&TEMPLATES.iter().map(told).collect::<Vec<_>>())
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
        left_um_per_m: machine
            .filter(|machine| machine.has(Part::Dividers))
            .map(helixlock_plant::rationalisation_um_per_m),
        screw_order: machine.and_then(screw_order),
        gears: gears.iter().map(gear).collect(),
        errors: parsed.err().map_or_else(Vec::new, |error| {
            without_folder(folder, &error.to_string()).lines().map(str::to_owned).collect()
        }),
    })
}

fn screw_order(machine: &Machine) -> Option<f64> {
    let screw = machine.lead_screw.filter(|_| machine.has(Part::Workpiece))?;
    Some(machine.workpiece.lead.mm() / screw.mm())
}

/// A text with the thumb wheels that its lead asks for, and what they leave compensated.
pub(crate) fn dividers(folder: &Folder, name: &str, text: &str) -> Answered {
    let file = MachineFile::parse(text, &folder.path(name)?)?;
    let machine = &file.model.machine;
    let needed = [Part::Workpiece, Part::Grating, Part::Laser, Part::Dividers];
    if let Some(part) = machine.lacks(&needed) {
        return Err(anyhow!("dividers need {part}").into());
    }
    let task = Task {
        lead: machine.workpiece.lead,
        lines: machine.grating.lines,
        wavelength_um: machine.laser.wavelength_um,
        range_um: USUAL_RANGE_UM,
    };
    let Some(found) = solve(&task) else {
        return Err(anyhow!(
            "lead {} with {} lines: no A and B from 1 to 999 come within {COMPENSATOR_REACH_PPM} ppm",
            task.lead,
            task.lines
        )
        .into());
    };
    let phase = centre_phase(found.b, machine.dividers.range);
    let rate = found.compensation().map_or(0.0, |(rate, _)| rate);
    let settings = [
        // Whatever B was, it allows no phase.
        ("initial_phase", "0".to_owned()),
        ("a", found.a.to_string()),
        ("b", found.b.to_string()),
        ("initial_phase", phase.to_string()),
        ("compensation", format!("\"{rate:.6} um/m\"")),
    ];
    let mut solved = file.clone();
    for (key, value) in settings {
        solved = solved.with_setting(&format!("dividers.{key}"), &value)?;
    }
    let words = Next::command("dividers")
        .words(["--lead", &task.lead.to_string(), "--lines", &task.lines.to_string()])
        .words(["--wavelength", &format!("{} um", task.wavelength_um)]);
    json(&SolvedJson { text: solved.text(), command: words.line()? })
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
