//! Names and comments for the blocks of a design.

use rust_hdl::core::block::Block;

/// Blocks that have a name of their own.
#[derive(Default)]
pub struct Library {
    pub(crate) entries: Vec<Entry>,
}

pub(crate) struct Entry {
    pub(crate) name: String,
    pub(crate) comment: String,
    pub(crate) block: Box<dyn Block>,
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
        self.entries.push(Entry { name: name.to_owned(), comment: comment.to_owned(), block });
        self
    }
}

impl std::fmt::Debug for Library {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_list().entries(self.entries.iter().map(|entry| &entry.name)).finish()
    }
}
