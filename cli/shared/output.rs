//! Files a command leaves behind: each whole or not at all.

use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use anyhow::Context;
use helixlock_report::{Figure, Page};
use serde::Serialize;
use tempfile::NamedTempFile;

/// Files of one folder that belong together: all of them appear, or none.
#[derive(Debug)]
pub(crate) struct Batch {
    folder: PathBuf,
    written: Vec<Written>,
}

/// A file that is whole, still under its temporary name.
#[derive(Debug)]
struct Written {
    file: NamedTempFile,
    path: PathBuf,
}

impl Batch {
    /// Starts with nothing; makes the folder, with its parents.
    pub(crate) fn new(folder: &Path) -> anyhow::Result<Self> {
        make_folder(folder)?;
        Ok(Self { folder: folder.to_owned(), written: Vec::new() })
    }

    /// Writes one file under a temporary name; `name` may lead through folders below.
    ///
    /// `fill` gets a buffered writer; when it fails, or the disk is full, no file is left behind.
    pub(crate) fn write(
        &mut self,
        name: &str,
        fill: impl FnOnce(&mut dyn Write) -> anyhow::Result<()>,
    ) -> anyhow::Result<()> {
        let path = self.folder.join(name);
        make_folder(path.parent().unwrap_or(&self.folder))?;
        self.written.push(Written::new(path, fill)?);
        Ok(())
    }

    /// Writes text or bytes under a temporary name.
    pub(crate) fn write_content(
        &mut self,
        name: &str,
        content: impl AsRef<[u8]>,
    ) -> anyhow::Result<()> {
        self.write(name, |file| Ok(file.write_all(content.as_ref())?))
    }

    /// Writes JSON for people and programs under a temporary name.
    pub(crate) fn write_json(&mut self, name: &str, value: &impl Serialize) -> anyhow::Result<()> {
        self.write_content(name, serde_json::to_string_pretty(value)? + "\n")
    }

    /// Writes what every evaluation leaves: a figure, its numbers, and a page about both.
    pub(crate) fn write_report(
        &mut self,
        figure: &Figure,
        result: &impl Serialize,
        page: &Page,
    ) -> anyhow::Result<()> {
        self.write_content("figure.svg", figure.svg())?;
        self.write_json("result.json", result)?;
        self.write_content("report.html", page.html())
    }

    /// Gives every file its name.
    pub(crate) fn keep(self) -> anyhow::Result<()> {
        self.written.into_iter().try_for_each(Written::keep)
    }
}

impl Written {
    fn new(
        path: PathBuf,
        fill: impl FnOnce(&mut dyn Write) -> anyhow::Result<()>,
    ) -> anyhow::Result<Self> {
        let cannot = || format!("{}: cannot be written", path.display());
        let mut buffer = BufWriter::new(temporary_beside(&path).with_context(cannot)?);
        fill(&mut buffer).with_context(cannot)?;
        let whole = buffer
            .into_inner()
            .map_err(std::io::IntoInnerError::into_error)
            .with_context(cannot)?;
        whole.as_file().sync_all().with_context(cannot)?;
        Ok(Self { file: whole, path })
    }

    fn keep(self) -> anyhow::Result<()> {
        let Self { file, path } = self;
        file.persist(&path).with_context(|| format!("{}: cannot be written", path.display()))?;
        Ok(())
    }
}

/// Prints a result as JSON.
pub(crate) fn print_json(out: &mut impl Write, value: &impl Serialize) -> anyhow::Result<()> {
    Ok(writeln!(out, "{}", serde_json::to_string_pretty(value)?)?)
}

/// Writes one file through a temporary one beside it, so that nobody ever sees half of it.
pub(crate) fn write_whole(
    path: &Path,
    fill: impl FnOnce(&mut dyn Write) -> anyhow::Result<()>,
) -> anyhow::Result<()> {
    Written::new(path.to_owned(), fill)?.keep()
}

/// Writes text or bytes as [`write_whole`] does.
pub(crate) fn write_content(path: &Path, content: impl AsRef<[u8]>) -> anyhow::Result<()> {
    write_whole(path, |file| Ok(file.write_all(content.as_ref())?))
}

/// Opens a file that grows line by line and outlives an interruption; makes it if there is none.
pub(crate) fn open_to_append(path: &Path) -> anyhow::Result<std::fs::File> {
    let mut options = std::fs::OpenOptions::new();
    options.read(true).append(true).create(true);
    options.open(path).with_context(|| format!("{}: cannot be written", path.display()))
}

fn make_folder(path: &Path) -> anyhow::Result<()> {
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
