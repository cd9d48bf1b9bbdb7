//! Folders of Verilog.

use std::path::{Path, PathBuf};

use anyhow::Context;

use crate::tools::read;

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
