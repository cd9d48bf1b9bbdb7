//! Work on the project itself; nothing a user needs.

use std::io::Write;
use std::path::Path;
use std::process::{Command, ExitCode};

use anyhow::{Context, bail};
use clap::Parser;
use xtask::prove::{Sources, document, rows};

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
        /// Put the table into docs/verification.md
        #[arg(long, conflicts_with = "short")]
        write: bool,
    },
}

fn main() -> anyhow::Result<ExitCode> {
    match Task::parse() {
        Task::Check => check(),
        Task::Prove { short, write } => prove(short, write, &mut std::io::stdout().lock()),
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
fn prove(short: bool, write: bool, out: &mut impl Write) -> anyhow::Result<ExitCode> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().context("the repository")?;
    let sources = Sources::of(root);
    let witness_folder = root.join("target/witnesses");
    std::fs::create_dir_all(&witness_folder)?;
    let (table, good) = rows::all(&sources, &witness_folder, if short { 20 } else { 1 })?;
    writeln!(out, "{table}")?;
    if write {
        document::write(root, &sources, &table)?;
    }
    Ok(if good { ExitCode::SUCCESS } else { ExitCode::from(1) })
}
