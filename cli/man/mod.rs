//! `helixlock man`: the manual's pages, made of the same words as `--help`.

use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;

use clap_mangen::Man;

use crate::shared::output::Batch;

/// The manual: its first page, or all pages into a folder
#[derive(Debug, clap::Args)]
pub(crate) struct Manual {
    /// Folder for all pages, one a command, such as "/usr/local/share/man/man1"
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
}

impl Manual {
    /// Prints or writes the pages of `helixlock`.
    pub(crate) fn run(
        self,
        mut helixlock: clap::Command,
        out: &mut impl Write,
    ) -> anyhow::Result<ExitCode> {
        helixlock = without_help(helixlock);
        helixlock.build(); // gives every subcommand its whole name
        let Some(folder) = self.output else {
            Man::new(helixlock).render(out)?;
            return Ok(ExitCode::SUCCESS);
        };
        let mut batch = Batch::new(&folder, [])?;
        write_pages(&helixlock, &mut batch)?;
        batch.keep()?;
        writeln!(out, "{}: the manual, `man -l {0}/helixlock.1` shows it", folder.display())?;
        Ok(ExitCode::SUCCESS)
    }
}

/// Without the subcommands `help`, which have no page to refer to.
fn without_help(command: clap::Command) -> clap::Command {
    command.disable_help_subcommand(true).mut_subcommands(without_help)
}

/// A page for the command, then for those below it.
fn write_pages(command: &clap::Command, batch: &mut Batch) -> anyhow::Result<()> {
    let man = Man::new(command.clone());
    batch.write(&man.get_filename(), |file| Ok(man.render(file)?))?;
    let mut below = command.get_subcommands().filter(|command| !command.is_hide_set());
    below.try_for_each(|below| write_pages(below, batch))
}
