//! `helixlock board`: what a board is told, and what it says while it grinds.

mod compare;
mod flash;
mod frame;
mod log;
mod message;
mod port;
mod set;
mod watch;

use std::io::Write;
use std::process::ExitCode;

use clap::{Args, Subcommand};

/// Talk to a board: find it, load it, set it, watch its comparisons
#[derive(Debug, Args)]
pub(crate) struct BoardCommand {
    #[command(subcommand)]
    what: What,
}

#[derive(Debug, Subcommand)]
enum What {
    /// List the serial ports of this computer
    List,
    Compare(compare::Compare),
    Flash(flash::Flash),
    Set(set::Set),
    Watch(watch::Watch),
}

impl BoardCommand {
    /// Does what is asked for.
    pub(crate) fn run(self, out: &mut impl Write) -> anyhow::Result<ExitCode> {
        match self.what {
            What::List => port::list(out),
            What::Compare(compare) => compare.run(out),
            What::Flash(flash) => flash.run(out),
            What::Set(set) => set.run(out),
            What::Watch(watch) => watch.run(out),
        }
    }
}
