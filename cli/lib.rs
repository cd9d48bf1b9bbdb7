//! The `helixlock` command: reads files, calls the libraries, prints and writes what they say.
//!
//! [`main`] is the command. [`functions`] are those of its words that answer in memory instead of
//! on paper and in files: what `import helixlock` is made of.

mod add;
mod board;
mod certify;
mod challenge;
mod compare;
mod completions;
mod diagnose;
mod discover;
mod dividers;
mod effects;
mod faults;
mod functions;
mod r#gen;
mod import;
mod init;
mod learn;
mod man;
mod merge;
mod scale;
mod screw;
mod serve;
mod shared;
mod sim;
mod straightness;
mod sweep;
mod transmission;
#[cfg(test)]
mod words_tests;

use std::env;
use std::io::{self, Write};
use std::process::ExitCode;

use clap::{ArgMatches, CommandFactory, FromArgMatches, Parser, Subcommand};

pub use crate::functions::{Function, functions};
pub use crate::shared::answer::{Answer, Part};
pub use crate::shared::refused::Refused;
pub use helixlock_traces::{Column, Table};

use crate::shared::cases::Campaign;
use crate::shared::hint::hint;
use crate::shared::language::{Language, Reporter, Translated};
use crate::shared::terminal::{Terminal, shown};

/// Laser correction of a lead-screw grinder: simulate it, build it, compare it with measurements
#[derive(Debug, Parser)]
#[command(name = "helixlock", version, arg_required_else_help = true)]
struct Words {
    /// Language of reports and pages; data, such as JSON, have none
    #[arg(long, global = true, value_enum, value_name = "LANGUAGE", default_value_t)]
    language: Language,
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Add(add::Add),
    Board(board::BoardCommand),
    Certify(certify::Certify),
    Challenge(challenge::Challenge),
    Compare(compare::Compare),
    Completions(completions::Completions),
    Diagnose(diagnose::Diagnose),
    Discover(discover::Discover),
    Dividers(dividers::Dividers),
    Effects(effects::Effects),
    Faults(faults::FaultsCommand),
    Gen(r#gen::Gen),
    Import(import::Import),
    Init(init::Init),
    Learn(learn::Learn),
    Man(man::Manual),
    Merge(merge::Merge),
    Scale(Box<scale::ScaleCommand>),
    Screw(screw::Screw),
    Serve(serve::Serve),
    Sim(sim::Sim),
    Straightness(Box<straightness::StraightnessCommand>),
    Sweep(sweep::Sweep),
    Transmission(Box<transmission::TransmissionCommand>),
}

/// All that is worked out in parts.
const CAMPAIGNS: [&Campaign; 4] =
    [&sweep::CAMPAIGN, &challenge::CAMPAIGN, &faults::CAMPAIGN, &certify::CAMPAIGN];

/// Runs the words that the process was given.
///
/// Exit status: 0 done, 1 the answer is no, 2 the input or the words are wrong.
#[must_use]
pub fn main() -> ExitCode {
    let asked = Language::asked(env::args_os());
    let (words, is_report) = match words(asked) {
        Ok(words) => words,
        Err(words) if words.use_stderr() => {
            // Nothing is left to tell the user if this fails, here and below.
            let _ = write!(io::stderr(), "{}", asked.error(&words));
            return ExitCode::from(2);
        }
        Err(help) => help.exit(),
    };
    let language = words.language;
    let terminal = Terminal(io::stdout().lock());
    let mut out = if is_report {
        Translated::new(terminal, language)
    } else {
        Translated::of_data(terminal, language)
    };
    let done = run(words.command, &mut out);
    let passed_on = out.flush();
    match done.and_then(|code| Ok(passed_on.map(|()| code)?)) {
        Ok(code) => code,
        Err(error) if is_broken_pipe(&error) => ExitCode::SUCCESS,
        Err(error) => {
            let error = shown(&format!("{error:#}{}", hint(&error)));
            let _ = writeln!(io::stderr(), "{}", language.of(&format!("helixlock: {error}")));
            ExitCode::from(2)
        }
    }
}

/// The words of the process, and whether what they print is a report.
fn words(asked: Language) -> Result<(Words, bool), clap::Error> {
    let matches = asked.help(Words::command()).try_get_matches()?;
    Ok((Words::from_arg_matches(&matches)?, is_report(&matches)))
}

/// False for what programs read.
fn is_report(matches: &ArgMatches) -> bool {
    match matches.subcommand() {
        Some(("completions" | "man", _)) => false,
        Some((_, below)) => is_report(below),
        None => !matches!(matches.try_get_one("json"), Ok(Some(true))),
    }
}

fn run(command: Command, out: &mut impl Reporter) -> anyhow::Result<ExitCode> {
    match command {
        Command::Add(command) => command.run(out),
        Command::Board(board) => board.run(out),
        Command::Certify(command) => command.run(out),
        Command::Challenge(command) => command.run(out),
        Command::Compare(command) => command.run(out),
        Command::Completions(command) => command.run(Words::command(), out),
        Command::Diagnose(command) => command.run(out),
        Command::Discover(command) => command.run(out),
        Command::Dividers(command) => command.run(out),
        Command::Effects(command) => command.run(out),
        Command::Faults(faults) => faults.run(out),
        Command::Gen(command) => command.run(out),
        Command::Import(command) => command.run(out),
        Command::Init(command) => command.run(out),
        Command::Learn(command) => command.run(out),
        Command::Man(command) => command.run(Words::command(), out),
        Command::Merge(command) => command.run(&CAMPAIGNS, out),
        Command::Scale(scale) => scale.run(out),
        Command::Screw(screw) => screw.run(out),
        Command::Serve(serve) => serve.run(out),
        Command::Sim(sim) => sim.run(out),
        Command::Straightness(straightness) => straightness.run(out),
        Command::Sweep(sweep) => sweep.run(out),
        Command::Transmission(transmission) => transmission.run(out),
    }
}

/// True when the reader of our output has gone, as in `helixlock effects | head -1`.
fn is_broken_pipe(error: &anyhow::Error) -> bool {
    error
        .chain()
        .filter_map(|cause| cause.downcast_ref::<io::Error>())
        .any(|cause| cause.kind() == io::ErrorKind::BrokenPipe)
}
