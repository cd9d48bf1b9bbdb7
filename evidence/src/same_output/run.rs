//! Runs stories with one build of the command, and keeps everything it writes and says.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::Context;
use rayon::prelude::*;

use super::story::Story;
use crate::tools::write_scratch;

/// How many commands ended with each exit status; none for those that a signal ended.
pub(super) type Statuses = BTreeMap<Option<i32>, usize>;

/// A build of the command, and the folder in which it works.
#[derive(Clone, Debug)]
pub(super) struct Workplace {
    /// The command.
    pub(super) binary: PathBuf,
    /// Its folder: `examples` beside what the stories write.
    pub(super) folder: PathBuf,
}

impl Workplace {
    /// An empty folder but for a copy of the examples, so that both builds are told the same paths.
    ///
    /// # Errors
    ///
    /// When a file cannot be read or written.
    pub(super) fn empty(binary: PathBuf, folder: PathBuf, examples: &Path) -> anyhow::Result<Self> {
        if folder.exists() {
            std::fs::remove_dir_all(&folder).with_context(|| folder.display().to_string())?;
        }
        copy(examples, &folder.join("examples"))?;
        Ok(Self { binary, folder })
    }

    /// Runs one story: beside its files lie `<n>.stdout`, `<n>.stderr` and `<n>.status` of its
    /// n-th command.
    fn run(&self, story: &Story) -> anyhow::Result<Statuses> {
        let folder = self.folder.join(&story.folder);
        std::fs::create_dir_all(&folder).with_context(|| folder.display().to_string())?;
        let mut statuses = Statuses::new();
        for (number, words) in (1..).zip(&story.commands) {
            let output = Command::new(&self.binary)
                .args(words)
                .current_dir(&self.folder)
                .env("COLUMNS", "100")
                .env("RAYON_NUM_THREADS", "1") // the stories share the cores already
                .output()
                .with_context(|| self.binary.display().to_string())?;
            let status = output.status.to_string();
            let said = [("stdout", output.stdout), ("stderr", output.stderr)];
            for (name, bytes) in said.into_iter().chain([("status", status.into_bytes())]) {
                write_scratch(&folder.join(format!("{number}.{name}")), &bytes)?;
            }
            *statuses.entry(output.status.code()).or_default() += 1;
        }
        Ok(statuses)
    }
}

/// Runs all stories in all workplaces, on all cores, and counts how the commands ended.
///
/// # Errors
///
/// When a command cannot be started or what it says cannot be kept.
pub(super) fn run(workplaces: &[Workplace], stories: &[Story]) -> anyhow::Result<Statuses> {
    let runs: Vec<_> = stories
        .iter()
        .flat_map(|story| workplaces.iter().map(move |workplace| (workplace, story)))
        .collect();
    let counted = runs.par_iter().map(|(workplace, story)| workplace.run(story));
    counted.try_reduce(Statuses::new, |mut sum, counted| {
        for (status, commands) in counted {
            *sum.entry(status).or_default() += commands;
        }
        Ok(sum)
    })
}

fn copy(from: &Path, to: &Path) -> anyhow::Result<()> {
    std::fs::create_dir_all(to).with_context(|| to.display().to_string())?;
    for entry in from.read_dir().with_context(|| from.display().to_string())? {
        let entry = entry?;
        let target = to.join(entry.file_name());
        if entry.file_type()?.is_dir() {
            copy(&entry.path(), &target)?;
        } else {
            std::fs::copy(entry.path(), &target).with_context(|| target.display().to_string())?;
        }
    }
    Ok(())
}
