//! Files a command leaves behind: each whole or not at all.

use std::io::{BufWriter, Write};
use std::path::Path;

use anyhow::Context;
use tempfile::NamedTempFile;

/// Writes one file through a temporary one beside it, so that nobody ever sees half of it.
///
/// `fill` gets a buffered writer; when it fails, or the disk is full, the old file stays.
pub(crate) fn write_whole(
    path: &Path,
    fill: impl FnOnce(&mut dyn Write) -> anyhow::Result<()>,
) -> anyhow::Result<()> {
    let cannot = || format!("{}: cannot be written", path.display());
    let mut buffer = BufWriter::new(temporary_beside(path).with_context(cannot)?);
    fill(&mut buffer).with_context(cannot)?;
    let whole =
        buffer.into_inner().map_err(std::io::IntoInnerError::into_error).with_context(cannot)?;
    whole.as_file().sync_all().with_context(cannot)?;
    whole.persist(path).with_context(cannot)?;
    Ok(())
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
