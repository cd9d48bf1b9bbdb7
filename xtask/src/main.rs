//! Work on the project itself; nothing a user needs.

use std::io::Write;
use std::path::Path;
use std::process::{Command, ExitCode};

use anyhow::{Context, bail};
use clap::Parser;
use rayon::prelude::*;
use xtask::prove::covers::{From, witnesses};
use xtask::prove::lockstep::History;
use xtask::prove::mutants::{Fate, Mutant, of_module, try_mutant};
use xtask::prove::properties::{Verdict, claim, prove};
use xtask::prove::table::{Row, markdown};
use xtask::prove::{Sources, forgets};

/// Work on the project itself
#[derive(Debug, Parser)]
enum Task {
    /// Format, lints, documentation and all tests, cheapest first
    Check,
    /// Proofs of the emitted Verilog, and mutants of it: prints what docs/verification.md holds
    Prove {
        /// One mutant in twenty instead of all
        #[arg(long)]
        short: bool,
    },
}

fn main() -> anyhow::Result<ExitCode> {
    match Task::parse() {
        Task::Check => check(),
        Task::Prove { short } => prove_all(short, &mut std::io::stdout().lock()),
    }
}

fn check() -> anyhow::Result<ExitCode> {
    cargo(&["fmt", "--all", "--check"], &[])?;
    cargo(&["clippy", "--workspace", "--all-targets", "--", "-D", "warnings"], &[])?;
    cargo(&["doc", "--no-deps", "--workspace"], &[("RUSTDOCFLAGS", "-D warnings")])?;
    cargo(&["test", "--workspace"], &[])?;
    Ok(ExitCode::SUCCESS)
}

fn cargo(words: &[&str], environment: &[(&str, &str)]) -> anyhow::Result<()> {
    let status = Command::new("cargo")
        .args(words)
        .envs(environment.iter().copied())
        .status()
        .context("`cargo` cannot be started")?;
    if !status.success() {
        bail!("`cargo {}` failed", words.join(" "));
    }
    Ok(())
}

/// Everything that can be said of the emitted Verilog, as a table.
fn prove_all(short: bool, out: &mut impl Write) -> anyhow::Result<ExitCode> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().context("the repository")?;
    let sources = Sources::of(root);
    let witness_folder = root.join("target/witnesses");
    std::fs::create_dir_all(&witness_folder)?;
    let mut rows = Vec::new();
    for block in sources.blocks()? {
        rows.extend(proven(&sources, &block, &witness_folder)?);
    }
    rows.push(power_up(&sources)?);
    let (row, survivors) = mutants(&sources, if short { 20 } else { 1 })?;
    rows.push(row);
    writeln!(out, "{}", markdown(&rows))?;
    for (mutant, fate) in survivors {
        let Mutant { module, line, was, now } = mutant;
        writeln!(out, "{fate:?}: {module}.v:{line}\n  `{was}`\n  `{}`", now.trim())?;
    }
    let good = rows.iter().all(|row| row.good);
    Ok(if good { ExitCode::SUCCESS } else { ExitCode::from(1) })
}

/// The rows of one block: its properties, and its witnesses.
fn proven(sources: &Sources, block: &str, folder: &Path) -> anyhow::Result<[Row; 2]> {
    let (assertions, sentence) = claim(sources, block)?;
    let verdict = prove(sources, block)?;
    let good = matches!(verdict, Verdict::Proven { .. });
    let outcome = match verdict {
        Verdict::Proven { depth } => format!("unbounded, depth {depth}"),
        Verdict::NotProven { log } => log.lines().last().unwrap_or_default().to_owned(),
    };
    let how = format!("{assertions} assertions, induction, any power-up state");
    let properties = Row { what: format!("`{block}`: {sentence}"), how, outcome, good };
    let found = witnesses(sources, block, folder)?;
    let from = |wanted| {
        let reached = found.iter().filter_map(|one| one.reached.as_ref());
        reached.filter(|(from, _)| *from == wanted).count()
    };
    let (power_up, invariant) = (from(From::PowerUp), from(From::Invariant));
    let witness = Row {
        what: format!("`{block}`: its interesting states are reachable"),
        how: format!("{} cover properties, a waveform each", found.len()),
        outcome: format!("{power_up} from power-up, {invariant} from a state the properties allow"),
        good: power_up + invariant == found.len(),
    };
    Ok([properties, witness])
}

fn power_up(sources: &Sources) -> anyhow::Result<Row> {
    let registers = forgets::power_up(sources)?;
    Ok(Row {
        what: "`device`: no output depends on the power-up state after a reset".to_owned(),
        how: "two copies, any two power-up states, four clocks of reset, SAT".to_owned(),
        outcome: match registers {
            Some(count) => format!("unbounded: all {count} registers equal, so equal for ever"),
            None => "registers differ".to_owned(),
        },
        good: registers.is_some(),
    })
}

/// The row of the mutants, and those that nothing noticed.
fn mutants(sources: &Sources, one_in: usize) -> anyhow::Result<(Row, Vec<(Mutant, Fate)>)> {
    let mut tried = Vec::new();
    for card in helixlock_rtl::BLOCKS {
        let chosen: Vec<_> = of_module(sources, card.name)?.into_iter().step_by(one_in).collect();
        let history = History::draw(card.name, 30_000, 7430)?;
        let fates: anyhow::Result<Vec<_>> = chosen
            .into_par_iter()
            .map(|mutant| try_mutant(sources, &mutant, &history).map(|fate| (mutant, fate)))
            .collect();
        tried.extend(fates?);
    }
    let count = |wanted| tried.iter().filter(|(_, fate)| *fate == wanted).count();
    let (properties, lockstep) = (count(Fate::Properties), count(Fate::Lockstep));
    let (equivalent, survived) = (count(Fate::Equivalent), count(Fate::Survived));
    let real = properties + lockstep + survived;
    let row = Row {
        what: format!("{} mutants, one mistake each", tried.len()),
        how: "properties, then 30 000 clocks in Icarus against the engine".to_owned(),
        outcome: format!(
            "{properties} killed by properties, {lockstep} by lockstep, {survived} survive; \
             {equivalent} more are proven equal to the original"
        ),
        good: 100 * (properties + lockstep) >= 95 * real,
    };
    tried.retain(|(_, fate)| matches!(fate, Fate::Equivalent | Fate::Survived));
    Ok((row, tried))
}
