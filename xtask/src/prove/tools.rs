//! Folders of Verilog, and the tools run on them.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use anyhow::Context;

/// A folder of emitted Verilog, one module a file, and one of properties about it.
#[derive(Clone, Debug)]
pub struct Sources {
    /// `<block>.v`.
    pub verilog: PathBuf,
    /// `<block>.sv`.
    pub properties: PathBuf,
}

impl Sources {
    /// The reviewed Verilog of the repository whose root this is.
    #[must_use]
    pub fn of(root: &Path) -> Self {
        Self { verilog: root.join("tests/golden"), properties: root.join("tests/formal") }
    }

    /// The text of a block's properties.
    ///
    /// # Errors
    ///
    /// When the file cannot be read.
    pub fn properties_of(&self, block: &str) -> anyhow::Result<String> {
        read(&self.properties.join(format!("{block}.sv")))
    }

    /// Names of all blocks with properties, sorted.
    ///
    /// # Errors
    ///
    /// When the folder cannot be read.
    pub fn blocks(&self) -> anyhow::Result<Vec<String>> {
        stems(&self.properties, "sv")
    }

    /// Names of all modules, sorted.
    ///
    /// # Errors
    ///
    /// When the folder cannot be read.
    pub fn modules(&self) -> anyhow::Result<Vec<String>> {
        stems(&self.verilog, "v")
    }
}

fn stems(folder: &Path, extension: &str) -> anyhow::Result<Vec<String>> {
    let entries = folder.read_dir().with_context(|| folder.display().to_string())?;
    let mut names = Vec::new();
    for entry in entries {
        let path = entry?.path();
        if path.extension().is_some_and(|found| found == extension) {
            names.extend(path.file_stem().map(|stem| stem.to_string_lossy().into_owned()));
        }
    }
    names.sort();
    Ok(names)
}

/// A whole text file.
pub(crate) fn read(path: &Path) -> anyhow::Result<String> {
    std::fs::read_to_string(path).with_context(|| path.display().to_string())
}

/// A scratch file for a tool, in a folder of its own.
#[expect(clippy::disallowed_methods, reason = "scratch for a tool, thrown away with its folder")]
pub(crate) fn write_scratch(path: &Path, text: &str) -> anyhow::Result<()> {
    std::fs::write(path, text).with_context(|| path.display().to_string())
}

/// Runs yosys on a script, and gives what it logged and whether it was content.
pub(crate) fn yosys(script: &str) -> anyhow::Result<(bool, String)> {
    run(Command::new("yosys").args(["-p", script]), "yosys")
}

/// Runs a tool, and gives what it said and whether it was content.
pub(crate) fn run(command: &mut Command, package: &str) -> anyhow::Result<(bool, String)> {
    let Output { status, stdout, stderr } = command
        .output()
        .with_context(|| format!("`{package}` cannot be started; it is a Debian package"))?;
    let said = [stdout, stderr].concat();
    Ok((status.success(), String::from_utf8_lossy(&said).into_owned()))
}
