//! Files get their names: all of them, even if the command is interrupted on the way.
//!
//! The order: every file is whole and on disk under a temporary name; then a journal that says
//! which name each is to have; then the names; then the journal goes. Whoever finds a journal
//! finishes what it says, so that the folder holds the old files before the journal stands and the
//! new ones after it.

use std::fs::File;
use std::io::Write;
use std::path::{Component, Path, PathBuf};

use anyhow::{Context, bail};

use super::unfinished::{PREFIX, Unfinished, clear};

/// Name of the journal in its folder.
const JOURNAL: &str = ".helixlock-commit";

/// Temporary name and name of each file, both below the folder.
type Renames = Vec<(String, PathBuf)>;

/// Finishes what an interrupted command has left in a folder, and removes what it cannot use.
pub(crate) fn recover(folder: &Path) -> anyhow::Result<()> {
    let _turn = turn(folder);
    finish(folder)
}

/// Gives files of a folder, each with its name there, their names.
pub(super) fn commit(folder: &Path, files: Vec<(Unfinished, PathBuf)>) -> anyhow::Result<()> {
    let _turn = turn(folder);
    finish(folder)?;
    let mut held = Vec::new();
    let mut renames = Renames::new();
    for (file, name) in files {
        let place = || format!("{}: cannot be written", folder.join(&name).display());
        let (file, temporary) = file.named().with_context(place)?;
        let temporary = temporary.file_name().and_then(|name| name.to_str()).map(str::to_owned);
        renames.push((temporary.with_context(place)?, name));
        held.push(file); // and with it its lock
    }
    if renames.len() < 2 {
        return rename(folder, &renames);
    }
    write_journal(folder, &renames)?;
    finish(folder)
}

/// Does what the journal of a folder says, if there is one.
fn finish(folder: &Path) -> anyhow::Result<()> {
    let journal = folder.join(JOURNAL);
    let Ok(text) = std::fs::read(&journal) else {
        clear(folder);
        return Ok(());
    };
    let unfinished = || {
        format!(
            "{}: what an interrupted command began cannot be finished\n\
             hint: remove that file to leave it as it is",
            journal.display()
        )
    };
    let renames: Renames = serde_json::from_slice(&text).with_context(unfinished)?;
    rename(folder, &renames).with_context(unfinished)?;
    std::fs::remove_file(&journal).with_context(unfinished)
}

/// Renames those that still have their temporary names.
fn rename(folder: &Path, renames: &Renames) -> anyhow::Result<()> {
    for (temporary, name) in renames {
        let place = folder.join(name);
        if !temporary.starts_with(PREFIX) || !is_below(Path::new(temporary)) || !is_below(name) {
            bail!("{}: is not in the folder", place.display());
        }
        let temporary = folder.join(temporary);
        if temporary.exists() {
            std::fs::rename(&temporary, &place)
                .with_context(|| format!("{}: cannot be written", place.display()))?;
        }
    }
    // Names are on disk before the journal goes; a system that cannot say so has them anyway.
    let _ = File::open(folder).and_then(|folder| folder.sync_all());
    Ok(())
}

/// True for a path that does not lead out of its folder.
fn is_below(name: &Path) -> bool {
    name.components().all(|part| matches!(part, Component::Normal(_)))
}

/// The journal appears whole, when all it speaks of is on disk.
fn write_journal(folder: &Path, renames: &Renames) -> anyhow::Result<()> {
    let journal = folder.join(JOURNAL);
    let place = || format!("{}: cannot be written", journal.display());
    let file = Unfinished::new(folder).with_context(place)?;
    let text = serde_json::to_vec(renames)?;
    let mut out = file.file();
    out.write_all(&text).and_then(|()| out.sync_all()).with_context(place)?;
    let (_held, temporary): (File, PathBuf) = file.named().with_context(place)?;
    std::fs::rename(temporary, &journal).with_context(place)
}

/// One command at a time gives names in a folder; where that cannot be had, they all do.
fn turn(folder: &Path) -> Option<File> {
    let folder = File::open(folder).ok()?;
    folder.lock().ok()?;
    Some(folder)
}
