//! The dependency arrows of ARCHITECTURE.md between crates.

use std::path::{Path, PathBuf};

/// Each crate and what it may use of ours, in the order of the levels.
const LAYERS: &[(&str, &[&str])] = &[
    ("rtl", &[]),
    ("netlist", &[]),
    ("original", &[]),
    ("fourier", &[]),
    ("traces", &[]),
    ("import", &["fourier", "traces"]),
    ("metrology", &["fourier"]),
    ("report", &[]),
    ("workbench", &[]),
    ("plant", &["traces"]),
    ("gen", &["netlist"]),
    ("sim", &["rtl", "netlist", "original", "plant", "traces"]),
    ("lab", &["fourier", "sim", "plant", "traces"]),
];

fn read(path: &str) -> String {
    let path = format!("{}/{path}", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(&path).expect(&path)
}

/// Dependencies of a manifest, those for building included and those for its tests left out.
fn dependencies(manifest: &str) -> String {
    let sections = manifest.split("\n[");
    sections.filter(|section| !section.starts_with("dev-dependencies")).collect()
}

#[test]
fn arrows_point_downwards() {
    for (folder, may_use) in LAYERS {
        let dependencies = dependencies(&read(&format!("{folder}/Cargo.toml")));
        for (other, _) in LAYERS.iter().filter(|(other, _)| !may_use.contains(other)) {
            let forbidden = format!("helixlock-{other}.workspace");
            assert!(!dependencies.contains(&forbidden), "{folder} must not use {other}");
        }
    }
}

#[test]
fn every_crate_has_its_level() {
    let manifest = read("Cargo.toml");
    let listed = manifest.lines().find_map(|line| line.strip_prefix("members = "));
    let folders: Vec<_> = listed.expect("members").split('"').skip(1).step_by(2).collect();
    let beside = ["evidence", "python", "xtask"];
    assert_eq!(folders.len(), LAYERS.len() + beside.len(), "{folders:?}");
    for folder in folders.into_iter().filter(|folder| !beside.contains(folder)) {
        assert!(LAYERS.iter().any(|(known, _)| *known == folder), "{folder} has no level");
    }
}

/// Python is given what the command finds, and nothing past it.
#[test]
fn python_stands_on_the_command_alone() {
    let dependencies = dependencies(&read("python/Cargo.toml"));
    assert!(dependencies.contains("helixlock = { path = \"..\" }"), "{dependencies}");
    let others = dependencies.matches("helixlock-").count();
    assert_eq!(others, 1, "its own name alone: {dependencies}");
}

/// Only the command may print, create files, or speak JSON.
#[test]
fn libraries_leave_json_to_the_command() {
    for (folder, _) in LAYERS {
        let dependencies = dependencies(&read(&format!("{folder}/Cargo.toml")));
        for forbidden in ["serde_json", "clap", "anyhow", "indicatif"] {
            assert!(!dependencies.contains(forbidden), "{folder} must not use {forbidden}");
        }
    }
}

fn entries(folder: &Path) -> impl Iterator<Item = PathBuf> {
    let entries = std::fs::read_dir(folder).expect("a folder");
    entries.map(|entry| entry.expect("an entry").path())
}

/// A command's folder uses nothing of another's, and what lies beside `mod.rs` not the command.
#[test]
fn commands_stand_apart() {
    let cli = concat!(env!("CARGO_MANIFEST_DIR"), "/cli");
    for folder in entries(Path::new(cli)).filter(|path| path.is_dir()) {
        let (folders, files): (Vec<_>, Vec<_>) = entries(&folder).partition(|path| path.is_dir());
        for path in files.into_iter().chain(folders.iter().flat_map(|below| entries(below))) {
            let text = std::fs::read_to_string(&path).expect("a source file");
            let mut used = text.split("crate::").skip(1);
            assert!(used.all(|rest| rest.starts_with("shared")), "{}", path.display());
            let mut above = text.split("super::").skip(1);
            let beside = above.all(|rest| !rest.starts_with(|first: char| first.is_uppercase()));
            assert!(path.ends_with("mod.rs") || beside, "{}", path.display());
        }
    }
}
