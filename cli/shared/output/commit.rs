//! Files get their names: all of them, even if the command is interrupted on the way.
//!
//! The order: every file is whole and on disk under a temporary name; then a journal that says
//! which name each is to have; then the names; then the journal goes. Whoever finds a journal
//! finishes what it says, so that the folder holds the old files before the journal stands and the
//! new ones after it. What can never be finished is put aside, so that it stands in nobody's way.

use std::fs::File;
use std::io::Write;
use std::path::{Component, Path, PathBuf};

use anyhow::{Context, anyhow, bail};

use super::unfinished::{PREFIX, Unfinished, abandoned, clear};

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
    if let Err(error) = write_journal(folder, &renames) {
        // On a full disk, where the files had room and the journal has none: nothing speaks of them yet.
        for (temporary, _) in &renames {
            let _ = std::fs::remove_file(folder.join(temporary));
        }
        return Err(
            error.context(format!("{}: cannot be written", folder.join(&renames[0].1).display()))
        );
    }
    finish(folder)
}

/// Does what the journal of a folder says, if there is one.
fn finish(folder: &Path) -> anyhow::Result<()> {
    let journal = folder.join(JOURNAL);
    let Ok(text) = std::fs::read(&journal) else {
        clear(folder);
        return Ok(());
    };
    let renames: serde_json::Result<Renames> = serde_json::from_slice(&text);
    let known = renames.as_ref().map_or(&[][..], Vec::as_slice);
    let done = match &renames {
        Ok(renames) => rename(folder, renames),
        Err(error) => Err(anyhow!("{error}")),
    };
    let place = journal.display();
    if let Err(error) = done {
        let begun = format!("{place}: what a command began cannot be finished: {error:#}");
        let aside = put_aside(folder, known).with_context(|| begun.clone())?;
        bail!(
            "{begun}\n\
             hint: its files are in {} now, with the list of the names they were to have; the same \
             command may be run again",
            aside.display()
        );
    }
    std::fs::remove_file(&journal).with_context(|| format!("{place}: cannot be removed"))
}

/// Moves a journal, the temporary names that it knows, and those without a writer into a folder of
/// its own, where they have names that are seen.
fn put_aside(folder: &Path, known: &[(String, PathBuf)]) -> anyhow::Result<PathBuf> {
    let aside = (1..).map(|number: u32| folder.join(format!("unfinished-{number}")));
    let aside = aside.into_iter().find(|path| path.symlink_metadata().is_err());
    let aside = aside.with_context(|| format!("{}: holds too much", folder.display()))?;
    let place = || format!("{}: cannot be made", aside.display());
    std::fs::create_dir(&aside).with_context(place)?;
    let known = known.iter().filter(|(name, _)| is_temporary(name));
    let known = known.map(|(name, _)| folder.join(name));
    for path in known.chain(abandoned(folder)).chain([folder.join(JOURNAL)]) {
        let name = path.file_name().and_then(|name| name.to_str()).unwrap_or(JOURNAL);
        let end = aside.join(name.trim_start_matches('.'));
        if path.exists() {
            std::fs::rename(&path, &end).with_context(|| super::cannot(&end))?;
        }
    }
    Ok(aside)
}

/// Renames those that still have their temporary names.
fn rename(folder: &Path, renames: &Renames) -> anyhow::Result<()> {
    for (temporary, name) in renames {
        let place = folder.join(name);
        if !is_temporary(temporary) || !is_below(name) {
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

/// True for a name that only files on their way have.
fn is_temporary(name: &str) -> bool {
    name.starts_with(PREFIX) && Path::new(name).file_name().is_some_and(|whole| whole == name)
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
