//! The command before and after a change, held against each other byte by byte.

mod build;
mod difference;
mod expected;
mod run;
mod story;

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;

pub use story::{STORIES, Story, Subjects, told};

use run::{Statuses, Workplace};

/// Words of `cargo xtask same-output`.
#[derive(Debug, Args)]
pub struct SameOutput {
    /// Commit to hold the present tree against
    #[arg(long, value_name = "REV")]
    against: String,
    /// Challenges to make and solve, from seed 1
    #[arg(long, value_name = "N", default_value_t = 200)]
    seeds: u64,
    /// List of differences that are meant: `files = REGEX`, `text = REGEX`, `reason = WHY`
    #[arg(long, value_name = "FILE")]
    expected: Option<PathBuf>,
}

impl SameOutput {
    /// Builds and runs both, prints what differs, and says whether nothing does.
    ///
    /// # Errors
    ///
    /// When a tree does not build, a command cannot be started, or a file cannot be read.
    pub fn run(&self, root: &Path, out: &mut impl Write) -> anyhow::Result<bool> {
        let expected = match &self.expected {
            Some(path) => expected::read_list(path)?,
            None => Vec::new(),
        };
        let stories = told(STORIES, &Subjects::of(root, self.seeds)?)?;
        let [before, after] = self.workplaces(root)?;
        let statuses = run::run(&[before.clone(), after.clone()], &stories)?;
        write_statuses(out, &statuses)?;
        let (files, found) = difference::differences(&before.folder, &after.folder, &expected)?;
        for difference in &found {
            writeln!(out, "{difference}")?;
        }
        for expected in &expected {
            writeln!(out, "expected in {} files: {}", expected.met.get(), expected.reason)?;
        }
        writeln!(out, "{} of {files} files differ", found.len())?;
        Ok(found.is_empty())
    }

    fn workplaces(&self, root: &Path) -> anyhow::Result<[Workplace; 2]> {
        let folder = root.join("target/same-output");
        let examples = root.join("examples");
        let before = build::of_commit(root, &self.against, &folder)?;
        let after = build::present(root, &folder.join("present"))?;
        Ok([
            Workplace::empty(before, folder.join("before"), &examples)?,
            Workplace::empty(after, folder.join("after"), &examples)?,
        ])
    }
}

/// Says how the commands ended, so that stories that only fail do not pass for proof.
fn write_statuses(out: &mut impl Write, statuses: &Statuses) -> std::io::Result<()> {
    for (status, commands) in statuses {
        match status {
            Some(status) => writeln!(out, "{commands} commands ended with status {status}")?,
            None => writeln!(out, "{commands} commands were ended by a signal")?,
        }
    }
    Ok(())
}
