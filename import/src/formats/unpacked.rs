//! Parts of an archive, unpacked as far as memory is meant for them.

use std::io::{self, Read};

use crate::limits;

/// Bytes that the parts of an archive may still have.
pub(super) struct Room(usize);

impl Room {
    /// For all of an archive.
    pub(super) fn of_an_archive() -> Self {
        Self(limits::UNPACKED)
    }

    /// A part's bytes, `None` where they are more than there is room for.
    pub(super) fn unpack(&mut self, part: impl Read) -> io::Result<Option<Vec<u8>>> {
        let mut data = Vec::new();
        // A byte more than may be, so that an archive of zeros is refused and not unpacked.
        part.take(self.0 as u64 + 1).read_to_end(&mut data)?;
        let left = self.0.checked_sub(data.len());
        self.0 = left.unwrap_or(0);
        Ok(left.map(|_| data))
    }
}
