//! Files a command reads: each once, so that it may be a pipe, and remembered, so that no output
//! replaces it.

use std::path::{Path, PathBuf};

use helixlock_plant::{Formula, Model};
use helixlock_traces::capture::capture_edges;
use helixlock_traces::{Capture, LONGEST_BYTES, Table, TraceError, read_bytes, table_of};

/// A file of samples as it was read.
pub(crate) struct Input {
    path: PathBuf,
    bytes: Vec<u8>,
}

impl Input {
    /// Reads it, the only time.
    pub(crate) fn read(path: &Path) -> Result<Self, TraceError> {
        Ok(Self { path: path.to_owned(), bytes: read_bytes(path, LONGEST_BYTES)? })
    }

    /// A file that was read already.
    pub(crate) fn of(path: PathBuf, bytes: Vec<u8>) -> Self {
        Self { path, bytes }
    }

    /// What it holds.
    pub(crate) fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// True for a value change dump, by its beginning.
    pub(crate) fn is_dump(&self) -> bool {
        self.bytes.trim_ascii_start().starts_with(b"$")
    }

    /// Its columns.
    pub(crate) fn table(self) -> Result<Table, TraceError> {
        table_of(self.bytes, &self.path)
    }

    /// Its edges.
    pub(crate) fn capture(self) -> Result<Capture, TraceError> {
        capture_edges(self.bytes.as_slice(), &self.path)
    }
}

/// A machine file and the curves it names.
pub(crate) fn machine_files(path: &Path, model: &Model) -> Vec<PathBuf> {
    let curve = |formula: &Formula| match formula {
        Formula::Curve(curve) => Some(path.with_file_name(curve.file())),
        Formula::Card(_) | Formula::Custom(_) => None,
    };
    let curves = model.effects.iter().filter_map(|term| curve(&term.formula));
    std::iter::once(path.to_owned()).chain(curves).collect()
}
