//! Names and comments for the blocks of a design.

use rust_hdl::core::block::Block;

/// Blocks that have a name of their own.
#[derive(Default)]
pub struct Library {
    pub(crate) entries: Vec<Entry>,
    pub(crate) licence: String,
}

pub(crate) struct Entry {
    pub(crate) name: String,
    pub(crate) comment: String,
    /// Names of ports, and what they are for.
    pub(crate) ports: Vec<(String, String)>,
    pub(crate) block: Box<dyn Block>,
}

impl Entry {
    /// What the port of that name is for.
    pub(crate) fn note(&self, port: &str) -> String {
        let found = self.ports.iter().find(|(name, _)| name == port);
        found.map(|(_, note)| note.clone()).unwrap_or_default()
    }
}

impl Library {
    /// A library without blocks: modules are then named after their instances.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a block: wherever one of equal structure is found, it gets this name and comment.
    #[must_use]
    pub fn with(mut self, name: &str, comment: &str, block: Box<dyn Block>) -> Self {
        let (name, comment) = (name.to_owned(), comment.to_owned());
        self.entries.push(Entry { name, comment, ports: vec![], block });
        self
    }

    /// Says what the ports of the block added last are for: a name and a phrase each.
    #[must_use]
    pub fn described(mut self, ports: Vec<(String, String)>) -> Self {
        if let Some(last) = self.entries.last_mut() {
            last.ports = ports;
        }
        self
    }

    /// Puts the designs under a licence, an SPDX expression.
    #[must_use]
    pub fn licensed(mut self, expression: &str) -> Self {
        expression.clone_into(&mut self.licence);
        self
    }
}

impl std::fmt::Debug for Library {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_list().entries(self.entries.iter().map(|entry| &entry.name)).finish()
    }
}
