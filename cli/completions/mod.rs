//! `helixlock completions`: what a shell needs to complete the command's words.

use std::io::Write;
use std::process::ExitCode;

use clap_complete::{Shell, generate};

/// The script by which a shell completes the words of helixlock
#[derive(Debug, clap::Args)]
pub(crate) struct Completions {
    /// Shell that is to read it
    shell: Shell,
}

impl Completions {
    /// Prints the script for all words of `helixlock`.
    pub(crate) fn run(
        self,
        mut helixlock: clap::Command,
        out: &mut impl Write,
    ) -> anyhow::Result<ExitCode> {
        let mut script = Vec::new(); // the generator panics where a pipe is closed
        generate(self.shell, &mut helixlock, "helixlock", &mut script);
        out.write_all(&script)?;
        Ok(ExitCode::SUCCESS)
    }
}
