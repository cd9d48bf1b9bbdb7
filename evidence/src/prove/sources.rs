//! Folders of Verilog.

use std::collections::BTreeMap;
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

    /// The modules that a block is made of, itself among them, with their texts.
    ///
    /// # Errors
    ///
    /// When a file cannot be read.
    pub fn made_of(&self, block: &str) -> anyhow::Result<BTreeMap<String, String>> {
        let modules = self.modules()?;
        let mut found = BTreeMap::new();
        let mut waiting = vec![block.to_owned()];
        while let Some(module) = waiting.pop() {
            let text = read(&self.verilog.join(format!("{module}.v")))?;
            // An instance begins with the name of its module.
            let first_words = text.lines().filter_map(|line| line.split_whitespace().next());
            let inner = first_words.filter(|word| modules.iter().any(|module| module == word));
            waiting.extend(inner.filter(|word| !found.contains_key(*word)).map(str::to_owned));
            found.insert(module, text);
        }
        Ok(found)
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
