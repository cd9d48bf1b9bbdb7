//! Packs the unit with a machine: `bundle machine.toml grinder.fmu`.

use std::fs::{self, File};
use std::io::Write;
use std::path::{Component, Path, PathBuf};

use anyhow::{Context, ensure};
use clap::Parser;
use fmi::fmi3::platform_folder;
use fmi::fmi3::schema::{DefaultExperiment, Fmi3CoSimulation, Fmi3ModelDescription};
use fmi_export::fmi3::Model as _;
use helixlock_fmu::{Grinder, MACHINE};
use helixlock_plant::Model;
use helixlock_sim::{Course, Options};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

/// Packs the unit with a machine.
#[derive(Parser)]
struct Words {
    /// Machine file; what it refers to stands beside it.
    machine: PathBuf,
    /// The unit to write.
    unit: PathBuf,
}

/// Name of the library, with and without what the system puts around it.
const IDENTIFIER: &str = "helixlock_fmu";

fn main() -> anyhow::Result<()> {
    let words = Words::parse();
    let model = Model::read(&words.machine)?;
    let course = Course::new(&model, &Options::default())?;
    let library = library()?;
    let folder = platform_folder(std::env::consts::OS, std::env::consts::ARCH)?;
    let extension = std::env::consts::DLL_EXTENSION;
    let mut parts = vec![
        ("modelDescription.xml".to_owned(), description(&course)?.into_bytes()),
        (format!("binaries/{folder}/{IDENTIFIER}.{extension}"), fs::read(&library)?),
    ];
    parts.extend(resources(&words.machine)?);
    let unit = File::create_new(&words.unit);
    let mut zip = ZipWriter::new(unit.with_context(|| words.unit.display().to_string())?);
    for (name, bytes) in parts {
        zip.start_file(name, SimpleFileOptions::default())?;
        zip.write_all(&bytes)?;
    }
    zip.finish()?;
    Ok(())
}

/// The machine file, and the curves that its effects are measured by.
fn resources(machine: &Path) -> anyhow::Result<Vec<(String, Vec<u8>)>> {
    let text = fs::read_to_string(machine)?;
    let table: toml::Table = text.parse()?;
    let effects = table.get("effect").and_then(toml::Value::as_array);
    let files = effects.into_iter().flatten().filter_map(|effect| effect.get("file")?.as_str());
    let folder = machine.parent().unwrap_or(Path::new(""));
    let mut resources = vec![(format!("resources/{MACHINE}"), text.clone().into_bytes())];
    for file in files {
        let beside = Path::new(file).components().all(|part| matches!(part, Component::Normal(_)));
        ensure!(beside, "{}: `{file}` is not beside it", machine.display());
        resources.push((format!("resources/{file}"), fs::read(folder.join(file))?));
    }
    Ok(resources)
}

/// The library that was built with this program.
fn library() -> anyhow::Result<PathBuf> {
    let program = std::env::current_exe()?;
    let folder = program.parent().unwrap_or(Path::new("."));
    let name =
        format!("{}{IDENTIFIER}{}", std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX);
    let path = folder.join(name);
    ensure!(path.is_file(), "{}: not built; `cargo build --release` does", path.display());
    Ok(path)
}

/// What the unit says of itself; it ends where the pass does.
fn description(course: &Course) -> anyhow::Result<String> {
    let metadata = Grinder::build_toplevel_metadata();
    let description = Fmi3ModelDescription {
        fmi_version: "3.0".to_owned(),
        model_name: Grinder::MODEL_NAME.to_owned(),
        instantiation_token: Grinder::INSTANTIATION_TOKEN.to_owned(),
        description: Some("A lead-screw grinder and its digital correction device".to_owned()),
        version: Some(env!("CARGO_PKG_VERSION").to_owned()),
        generation_tool: Some("helixlock".to_owned()),
        co_simulation: Some(Fmi3CoSimulation {
            model_identifier: IDENTIFIER.to_owned(),
            can_handle_variable_communication_step_size: Some(true),
            ..Fmi3CoSimulation::default()
        }),
        default_experiment: Some(DefaultExperiment {
            start_time: Some(0.0),
            stop_time: Some(course.duration_s),
            ..DefaultExperiment::default()
        }),
        model_variables: metadata.model_variables,
        model_structure: metadata.model_structure,
        ..Fmi3ModelDescription::default()
    };
    fmi::schema::serialize(&description, false).context("the description")
}
