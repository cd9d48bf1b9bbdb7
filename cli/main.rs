//! The `helixlock` command: reads files, calls the libraries, prints and writes what they say.

mod output;
mod pages;
mod progress;
mod sim;
mod sim_summary;
mod sim_table;

use std::io::{self, Write};
use std::process::ExitCode;

use clap::Parser;

/// Laser correction of a lead-screw grinder: simulate it, build it, compare it with measurements
#[derive(Debug, Parser)]
#[command(name = "helixlock", version, arg_required_else_help = true)]
enum Command {
    Sim(sim::Sim),
}

/// Exit status: 0 done, 1 the answer is no, 2 the input or the words are wrong.
fn main() -> ExitCode {
    match run(Command::parse(), &mut io::stdout().lock()) {
        Ok(code) => code,
        Err(error) if is_broken_pipe(&error) => ExitCode::SUCCESS,
        Err(error) => {
            // Nothing is left to tell the user if this fails too.
            let _ = writeln!(io::stderr(), "helixlock: {error:#}");
            ExitCode::from(2)
        }
    }
}

fn run(command: Command, out: &mut impl Write) -> anyhow::Result<ExitCode> {
    match command {
        Command::Sim(sim) => sim.run(out),
    }
}

/// True when the reader of our output has gone, as in `helixlock effects | head -1`.
fn is_broken_pipe(error: &anyhow::Error) -> bool {
    error
        .chain()
        .filter_map(|cause| cause.downcast_ref::<io::Error>())
        .any(|cause| cause.kind() == io::ErrorKind::BrokenPipe)
}
