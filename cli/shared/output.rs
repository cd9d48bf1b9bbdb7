//! Files a command leaves behind: each whole or not at all, and those that belong together all or
//! none.
//!
//! What a command has read it does not replace. A link stays one, and so do a device and a pipe; a
//! file keeps its mode.

use std::fs::File;
use std::io::{BufWriter, Cursor, Seek, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use helixlock_report::{Figure, Page};
use serde::Serialize;

use self::target::Target;
use self::unfinished::Unfinished;
use super::language::Language;

mod apart;
mod commit;
mod target;
mod unfinished;

pub(crate) use apart::apart;
pub(crate) use commit::recover;

/// Name of the page that a command leaves in its folder.
pub(crate) const REPORT: &str = "report.html";

/// What a file is filled through; some formats go back to their header.
pub(crate) trait Output: Write + Seek {}

impl<W: Write + Seek> Output for W {}

/// Files of one folder that belong together: all of them appear, or none.
#[derive(Debug)]
pub(crate) struct Batch {
    folder: PathBuf,
    /// What the command has read.
    inputs: Vec<PathBuf>,
    /// Files of the folder, with their names there.
    inside: Vec<(Unfinished, PathBuf)>,
    /// What a name of the folder leads to, elsewhere or not a file.
    outside: Vec<Outside>,
    _folder: MadeFolder,
    /// Language of the pages.
    language: Language,
}

/// A folder that was made for files; it goes again if none came.
#[derive(Debug)]
struct MadeFolder(Option<PathBuf>);

impl Drop for MadeFolder {
    fn drop(&mut self) {
        // The system keeps a folder that is not empty, which is what is wanted.
        let _ = self.0.as_ref().map(std::fs::remove_dir);
    }
}

/// An output that is no file of its folder.
#[derive(Debug)]
enum Outside {
    File(Unfinished, PathBuf),
    Stream(Vec<u8>, PathBuf),
}

impl Batch {
    /// Starts with nothing; makes the folder, with its parents, and finishes what another command
    /// had to leave there.
    pub(crate) fn new(
        folder: &Path,
        inputs: impl IntoIterator<Item = PathBuf>,
    ) -> anyhow::Result<Self> {
        let made = MadeFolder((!folder.exists()).then(|| folder.to_owned()));
        make_folder(folder)?;
        recover(folder)?;
        Ok(Self {
            _folder: made,
            folder: folder.to_owned(),
            inputs: inputs.into_iter().collect(),
            inside: Vec::new(),
            outside: Vec::new(),
            language: Language::En,
        })
    }

    /// The same with its pages in a language.
    pub(crate) fn in_language(self, language: Language) -> Self {
        Self { language, ..self }
    }

    /// The folder.
    pub(crate) fn folder(&self) -> &Path {
        &self.folder
    }

    /// Writes one file that has no name yet; `name` may lead through folders below.
    ///
    /// `fill` gets a buffered writer; when it fails, or the disk is full, no file is left behind.
    pub(crate) fn write(
        &mut self,
        name: &str,
        fill: impl FnOnce(&mut dyn Output) -> anyhow::Result<()>,
    ) -> anyhow::Result<()> {
        let path = self.folder.join(name);
        make_folder(path.parent().unwrap_or(&self.folder))?;
        self.put(PathBuf::from(name), &path, fill)
    }

    fn put(
        &mut self,
        name: PathBuf,
        path: &Path,
        fill: impl FnOnce(&mut dyn Output) -> anyhow::Result<()>,
    ) -> anyhow::Result<()> {
        match Target::of(path, &self.inputs)? {
            Target::File { path: end, mode } if is_inside(&self.folder, path, &end) => {
                let whole = filled(&self.folder, path, fill)?;
                keep_mode(&whole, mode, path)?;
                self.inside.push((whole, name));
            }
            Target::File { path: end, mode } => {
                let whole = filled(folder_of(&end), path, fill)?;
                keep_mode(&whole, mode, path)?;
                self.outside.push(Outside::File(whole, end));
            }
            Target::Stream(end) => {
                let mut content = Cursor::new(Vec::new());
                fill(&mut content).with_context(|| cannot(path))?;
                self.outside.push(Outside::Stream(content.into_inner(), end));
            }
        }
        Ok(())
    }

    /// Writes text or bytes.
    pub(crate) fn write_content(
        &mut self,
        name: &str,
        content: impl AsRef<[u8]>,
    ) -> anyhow::Result<()> {
        self.write(name, |file| Ok(file.write_all(content.as_ref())?))
    }

    /// Writes JSON for people and programs.
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
        self.write_content("figure.svg", self.language.picture(figure.svg()))?;
        self.write_json("result.json", result)?;
        self.write_page(page)
    }

    /// Writes the page of a command.
    pub(crate) fn write_page(&mut self, page: &Page) -> anyhow::Result<()> {
        self.write_content(REPORT, self.language.page(page))
    }

    /// Gives every file its name, and says which there are.
    pub(crate) fn kept(self) -> anyhow::Result<Written> {
        let place = |outside: &Outside| match outside {
            Outside::File(_, path) | Outside::Stream(_, path) => path.display().to_string(),
        };
        let inside = self.inside.iter().map(|(_, name)| name.display().to_string());
        let names = inside.chain(self.outside.iter().map(place)).collect();
        let written = Written { folder: self.folder.clone(), names };
        self.keep()?;
        Ok(written)
    }

    /// Gives every file its name.
    pub(crate) fn keep(self) -> anyhow::Result<()> {
        for outside in self.outside {
            outside.keep()?;
        }
        commit::commit(&self.folder, self.inside)
    }
}

/// What a command has written; nothing without an output.
#[derive(Debug, Default)]
pub(crate) struct Written {
    folder: PathBuf,
    names: Vec<String>,
}

impl Written {
    /// Tells a user where it is.
    pub(crate) fn print(&self, out: &mut impl Write) -> anyhow::Result<()> {
        if !self.names.is_empty() {
            writeln!(out, "\n{}: {}", self.folder.display(), self.names.join(", "))?;
        }
        Ok(())
    }
}

impl Outside {
    fn keep(self) -> anyhow::Result<()> {
        match self {
            Self::File(file, path) => {
                commit::commit(folder_of(&path), vec![(file, name_of(&path)?)])
            }
            Self::Stream(content, path) => {
                let open = File::options().write(true).open(&path);
                open.and_then(|mut file| file.write_all(&content)).with_context(|| cannot(&path))
            }
        }
    }
}

/// Prints a result as JSON.
pub(crate) fn print_json(out: &mut impl Write, value: &impl Serialize) -> anyhow::Result<()> {
    Ok(writeln!(out, "{}", serde_json::to_string_pretty(value)?)?)
}

/// Writes one file that nobody ever sees half of; `inputs` is what the command has read.
pub(crate) fn write_whole(
    path: &Path,
    inputs: impl IntoIterator<Item = PathBuf>,
    fill: impl FnOnce(&mut dyn Output) -> anyhow::Result<()>,
) -> anyhow::Result<()> {
    let name = name_of(path)?;
    let mut batch = Batch {
        _folder: MadeFolder(None),
        folder: folder_of(path).to_owned(),
        inputs: inputs.into_iter().collect(),
        inside: Vec::new(),
        outside: Vec::new(),
        language: Language::En,
    };
    batch.put(name, path, fill)?;
    batch.keep()
}

/// Writes text or bytes as [`write_whole`] does.
pub(crate) fn write_content(
    path: &Path,
    inputs: impl IntoIterator<Item = PathBuf>,
    content: impl AsRef<[u8]>,
) -> anyhow::Result<()> {
    write_whole(path, inputs, |file| Ok(file.write_all(content.as_ref())?))
}

/// Writes a page in a language as [`write_whole`] does.
pub(crate) fn write_page(
    path: &Path,
    inputs: impl IntoIterator<Item = PathBuf>,
    page: &Page,
    language: Language,
) -> anyhow::Result<()> {
    write_content(path, inputs, language.page(page))
}

/// Tells a user where a page is; nothing without one.
pub(crate) fn print_page(out: &mut impl Write, path: Option<&Path>) -> anyhow::Result<()> {
    match path {
        Some(path) => Ok(writeln!(out, "\n{}: the same as a page", path.display())?),
        None => Ok(()),
    }
}

/// Opens a file that grows line by line and outlives an interruption; makes it if there is none.
pub(crate) fn open_to_append(path: &Path) -> anyhow::Result<File> {
    let mut options = File::options();
    options.read(true).append(true).create(true);
    options.open(path).with_context(|| cannot(path))
}

/// A file with its content, on disk.
fn filled(
    folder: &Path,
    path: &Path,
    fill: impl FnOnce(&mut dyn Output) -> anyhow::Result<()>,
) -> anyhow::Result<Unfinished> {
    let whole = Unfinished::new(folder).with_context(|| cannot(path))?;
    let mut buffer = BufWriter::new(whole.file());
    fill(&mut buffer).with_context(|| cannot(path))?;
    let end = buffer.flush();
    drop(buffer);
    end.and_then(|()| whole.file().sync_all()).with_context(|| cannot(path))?;
    Ok(whole)
}

fn keep_mode(
    file: &Unfinished,
    mode: Option<std::fs::Permissions>,
    path: &Path,
) -> anyhow::Result<()> {
    let set = mode.map_or(Ok(()), |mode| file.file().set_permissions(mode));
    set.with_context(|| cannot(path))
}

/// True when no link leads from the name out of the folder.
fn is_inside(folder: &Path, path: &Path, end: &Path) -> bool {
    let whole = |path: &Path| folder_of(path).canonicalize().ok();
    let (Ok(folder), Some(named), Some(ends)) = (folder.canonicalize(), whole(path), whole(end))
    else {
        return false;
    };
    named == ends && path.file_name() == end.file_name() && named.starts_with(folder)
}

fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

fn name_of(path: &Path) -> anyhow::Result<PathBuf> {
    match path.file_name() {
        Some(name) => Ok(name.into()),
        None => bail!("{}: no name for a file", path.display()),
    }
}

fn cannot(path: &Path) -> String {
    format!("{}: cannot be written", path.display())
}

/// Makes a folder, with its parents.
pub(crate) fn make_folder(path: &Path) -> anyhow::Result<()> {
    std::fs::create_dir_all(path)
        .with_context(|| format!("{}: the folder cannot be made", path.display()))
}
