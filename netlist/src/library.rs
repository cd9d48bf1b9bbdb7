//! Names and comments for the blocks of a design.

use rust_hdl::core::block::Block;

/// Blocks that have a name of their own.
#[derive(Default)]
pub struct Library<'a> {
    pub(crate) entries: Vec<Entry<'a>>,
}

pub(crate) struct Entry<'a> {
    pub(crate) name: String,
    pub(crate) comment: String,
    pub(crate) block: &'a dyn Block,
}

impl<'a> Library<'a> {
    /// A library without blocks: modules are then named after their instances.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a block: wherever one of equal structure is found, it gets this name and comment.
    #[must_use]
    pub fn with(mut self, name: &str, comment: &str, block: &'a dyn Block) -> Self {
        self.entries.push(Entry { name: name.to_owned(), comment: comment.to_owned(), block });
        self
    }
}

impl std::fmt::Debug for Library<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_list().entries(self.entries.iter().map(|entry| &entry.name)).finish()
    }
}
