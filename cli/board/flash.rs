//! `helixlock board flash`: a bitstream onto a board.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

use anyhow::{Context, bail};
use clap::Args;
use helixlock_gen::Board;

/// Load a project's bitstream onto its board, by the loader that the board's constraints name
#[derive(Debug, Args)]
pub(super) struct Flash {
    /// Folder that `helixlock gen --synth` wrote
    #[arg(value_name = "DIR")]
    project: PathBuf,
    /// Board it was written for
    #[arg(long, value_name = "BOARD")]
    board: String,
}

impl Flash {
    /// Runs the loader; its words are the user's.
    pub(super) fn run(self, out: &mut impl Write) -> anyhow::Result<ExitCode> {
        let board = Board::find(&self.board)?;
        let Some(file) = bitstream(&self.project, board.family.bitstream()) else {
            bail!(
                "{}: no bitstream below build/\n\
                 hint: helixlock gen MACHINE.toml --board {} --synth -o {0}",
                self.project.display(),
                board.name,
            );
        };
        let loader = &board.program;
        let mut words = loader.split_ascii_whitespace();
        let tool = words.next().context("the board has a loader")?;
        writeln!(out, "{loader} {}", file.display())?;
        out.flush()?;
        let status = Command::new(tool).args(words).arg(&file).status();
        let status = status.with_context(|| format!("`{tool}` is not installed"))?;
        if status.success() {
            return Ok(ExitCode::SUCCESS);
        }
        bail!("`{tool}` failed ({status})")
    }
}

/// The first file of that ending that was built in a project, by name.
fn bitstream(project: &Path, ending: &str) -> Option<PathBuf> {
    let entries = project.join("build").read_dir().ok()?;
    let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
    paths.filter(|path| path.extension().is_some_and(|found| found == ending)).min()
}
