//! Files a command leaves behind: each whole or not at all.

use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use anyhow::Context;
use tempfile::NamedTempFile;

/// Files that belong together: all of them appear, or none.
#[derive(Debug, Default)]
pub(crate) struct Batch {
    written: Vec<(NamedTempFile, PathBuf)>,
}

impl Batch {
    /// Writes one file under a temporary name beside its own.
    ///
    /// `fill` gets a buffered writer; when it fails, or the disk is full, nothing is left behind.
    pub(crate) fn write(
        &mut self,
        path: &Path,
        fill: impl FnOnce(&mut dyn Write) -> anyhow::Result<()>,
    ) -> anyhow::Result<()> {
        let cannot = || format!("{}: cannot be written", path.display());
        let mut buffer = BufWriter::new(temporary_beside(path).with_context(cannot)?);
        fill(&mut buffer).with_context(cannot)?;
        let whole = buffer
            .into_inner()
            .map_err(std::io::IntoInnerError::into_error)
            .with_context(cannot)?;
        whole.as_file().sync_all().with_context(cannot)?;
        self.written.push((whole, path.to_owned()));
        Ok(())
    }

    /// Gives every file its name.
    pub(crate) fn keep(self) -> anyhow::Result<()> {
        for (file, path) in self.written {
            file.persist(&path)
                .with_context(|| format!("{}: cannot be written", path.display()))?;
        }
        Ok(())
    }
}

/// Writes one file through a temporary one beside it, so that nobody ever sees half of it.
pub(crate) fn write_whole(
    path: &Path,
    fill: impl FnOnce(&mut dyn Write) -> anyhow::Result<()>,
) -> anyhow::Result<()> {
    let mut batch = Batch::default();
    batch.write(path, fill)?;
    batch.keep()
}

/// Opens a file that grows line by line and outlives an interruption; makes it if there is none.
pub(crate) fn open_to_append(path: &Path) -> anyhow::Result<std::fs::File> {
    let mut options = std::fs::OpenOptions::new();
    options.read(true).append(true).create(true);
    options.open(path).with_context(|| format!("{}: cannot be written", path.display()))
}

/// Makes the folder that `-o` names, with its parents.
pub(crate) fn folder(path: &Path) -> anyhow::Result<()> {
    std::fs::create_dir_all(path)
        .with_context(|| format!("{}: the folder cannot be made", path.display()))
}

/// A temporary file in the same folder, readable like any new file once it is renamed.
fn temporary_beside(path: &Path) -> std::io::Result<NamedTempFile> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let mut builder = tempfile::Builder::new();
    builder.prefix(".helixlock-");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o644));
    }
    builder.tempfile_in(folder.unwrap_or(Path::new(".")))
}
