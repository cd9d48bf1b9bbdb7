//! How much a file may hold, so that no file takes the machine's memory with it.

/// Longest file, bytes; a day of ten channels at 100 Hz is a fifth of it.
pub(crate) const BYTES: usize = 256 << 20;
/// Longest cell, bytes: a reading or a name, with room for a remark.
pub(crate) const CELL: usize = 100_000;
/// Most cells of a table.
pub(crate) const CELLS: usize = 20_000_000;
/// Most columns of a table.
pub(crate) const COLUMNS: usize = 4_096;
/// Most bytes that an archive may unpack to.
pub(crate) const UNPACKED: usize = 512 << 20;
