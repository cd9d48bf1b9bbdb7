//! What a command finds, in memory: for programs that want neither text nor files.

use helixlock_traces::Table;
use serde::Serialize;
use serde_json::Value;

use super::angular::in_unit;

/// What a command finds.
#[derive(Debug)]
pub struct Answer {
    /// What the command prints with `--json`.
    pub json: Value,
    /// What it writes into files, and more, by name.
    pub parts: Vec<(&'static str, Part)>,
}

/// Something that goes with a result.
#[derive(Debug)]
pub enum Part {
    /// Samples.
    Table(Table),
    /// A text, such as a machine file.
    Text(String),
}

impl Answer {
    /// A result without anything else.
    pub(crate) fn new(result: &impl Serialize) -> anyhow::Result<Self> {
        Ok(Self { json: serde_json::to_value(result)?, parts: Vec::new() })
    }

    /// A result whose errors are in `unit`, `um` or `arcsec`.
    pub(crate) fn in_unit(result: &impl Serialize, unit: &str) -> anyhow::Result<Self> {
        Ok(Self { json: in_unit(result, unit)?, parts: Vec::new() })
    }

    /// With samples.
    pub(crate) fn with_table(mut self, name: &'static str, table: Table) -> Self {
        self.parts.push((name, Part::Table(table)));
        self
    }

    /// With a text.
    pub(crate) fn with_text(mut self, name: &'static str, text: String) -> Self {
        self.parts.push((name, Part::Text(text)));
        self
    }
}

/// A command that can answer in memory.
pub(crate) trait Answering: clap::Args {
    /// Works out what `run` prints and writes.
    fn answer(&self) -> anyhow::Result<Answer>;
}
