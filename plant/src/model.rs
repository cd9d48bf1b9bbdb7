//! The model: a machine with its effects, as a machine file describes both.

mod effects;
mod keys;
mod parts;
mod reference;
mod section;
mod write;

use std::ops::Deref;
use std::path::Path;

use crate::error::MachineError;
use crate::machine::Machine;
use crate::term::Term;
use section::{Complaints, Section, Source};

pub use reference::reference;
pub use write::MachineFile;

/// A machine with the effects it is known to have; what is asked of the machine is asked of it.
#[derive(Clone, Debug)]
pub struct Model {
    /// The machine as it was meant.
    pub machine: Machine,
    /// What makes it differ from that.
    pub effects: Vec<Term>,
}

impl Deref for Model {
    type Target = Machine;

    fn deref(&self) -> &Machine {
        &self.machine
    }
}

impl Model {
    /// Reads a machine file, and the curves it names.
    ///
    /// # Errors
    ///
    /// [`MachineError`] with the place of everything that is wrong.
    pub fn read(path: &Path) -> Result<Self, MachineError> {
        MachineFile::read(path).map(|file| file.model)
    }

    /// Reads the text of a machine file; `path` names it in messages and is where it looks for
    /// curves.
    ///
    /// # Errors
    ///
    /// [`MachineError`] with the place of everything that is wrong.
    pub fn parse(text: &str, path: &Path) -> Result<Self, MachineError> {
        Self::parse_source(Source { path, text, behind: None })
    }

    fn parse_source(source: Source<'_>) -> Result<Self, MachineError> {
        let document =
            toml_edit::Document::parse(source.text).map_err(|error| MachineError::Syntax {
                at: source.at(Some(error.span().unwrap_or_default())),
                message: error.message().trim().replace('\n', ", ").into(),
            })?;
        let complaints = Complaints::default();
        let root = Section::root(source, document.as_table(), &complaints);
        let chain = parts::chain(&root);
        let machine = parts::machine(&root, &chain);
        let effects = effects::effects(&root, &chain, machine.as_ref());
        let complaints = complaints.take();
        match (machine, effects) {
            (Some(machine), Some(effects)) if complaints.is_empty() => {
                Ok(Self { machine, effects })
            }
            _ => Err(MachineError::all(complaints)),
        }
    }

    /// Time constants of the recorder's own lags, s; the loop does not go through it.
    #[must_use]
    pub fn recorder_lags_s(&self) -> Vec<f64> {
        let lags = self.effects.iter().filter(|term| term.kind() == "recorder-lag");
        lags.filter_map(|term| term.values.first().copied()).collect()
    }
}

#[cfg(test)]
mod tests;
