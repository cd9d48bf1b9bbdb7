//! Work on the project itself; nothing a user needs.

use std::io::Write;
use std::path::Path;
use std::process::{Command, ExitCode};

use anyhow::Context;
use clap::Parser;
use xtask::prove::rows::{self, Extent};
use xtask::prove::table::markdown;
use xtask::prove::{Sources, document};
use xtask::python;
use xtask::same_output::SameOutput;
use xtask::sbom::sbom;
use xtask::setup::Tools;

/// Work on the project itself
#[derive(Debug, Parser)]
enum Task {
    /// Install what is missing of tools; then format, lints, documentation, all tests and the Python package
    Check {
        /// Say what is missing and stop
        #[arg(long)]
        no_install: bool,
    },
    /// Proofs of the emitted Verilog, and mutants of it: prints what docs/verification.md holds
    Prove {
        /// One mutant in twenty instead of all
        #[arg(long)]
        short: bool,
        /// Only this block
        #[arg(long, value_name = "BLOCK")]
        block: Option<String>,
        /// Put the table into docs/verification.md; with a block, what is said of it and the totals
        #[arg(long, conflicts_with = "short")]
        write: bool,
    },
    /// Print what the command is made of, as SPDX
    Sbom,
    /// Hold everything the command writes and says against what it did at a commit
    SameOutput(SameOutput),
}

/// Exit status: 0 good, 1 not good, 2 it cannot be told.
fn main() -> ExitCode {
    match run(Task::parse(), &mut std::io::stdout().lock()) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(1),
        Err(error) => {
            // Nothing is left to tell the user if this fails too.
            let _ = writeln!(std::io::stderr(), "xtask: {error:#}");
            ExitCode::from(2)
        }
    }
}

/// Whether all is good.
fn run(task: Task, out: &mut impl Write) -> anyhow::Result<bool> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().context("the repository")?;
    match task {
        Task::Check { no_install } => check(root, no_install, out),
        Task::Prove { short, block, write } => {
            let one_in = if short { 20 } else { 1 };
            prove(root, &Extent { one_in, block }, write, out)
        }
        Task::Sbom => {
            write!(out, "{}", sbom(root)?)?;
            Ok(true)
        }
        Task::SameOutput(task) => task.run(root, out),
    }
}

/// What has to pass, cheapest first: words of cargo.
const CHECKS: &[&[&str]] = &[
    &["fmt", "--all", "--check"],
    &["clippy", "--workspace", "--all-targets", "--", "-D", "warnings"],
    &["doc", "--no-deps", "--workspace", "--config", "build.rustdocflags=['-D', 'warnings']"],
    &["test", "--workspace"],
];

/// Runs the checks up to the first that fails; why it does, cargo says itself.
fn check(root: &Path, no_install: bool, out: &mut impl Write) -> anyhow::Result<bool> {
    let tools = Tools::of(root);
    tools.prepare(!no_install, out)?;
    let path = tools.path()?;
    for words in CHECKS {
        let mut cargo = Command::new("cargo");
        cargo.args(*words).env("PATH", &path);
        if !cargo.status().context("`cargo` cannot be started")?.success() {
            return Ok(false);
        }
    }
    Ok(python::check(root, &path)? && deny(&path, out)?)
}

/// Licences, bans and origins by `cargo deny`, where it is installed; `tests/licences.rs` holds to
/// the same rules without it.
fn deny(path: &std::ffi::OsStr, out: &mut impl Write) -> anyhow::Result<bool> {
    let mut version = Command::new("cargo");
    version.args(["deny", "--version"]).env("PATH", path);
    if !version.output().context("`cargo` cannot be started")?.status.success() {
        writeln!(out, "cargo-deny is not installed: bans are not checked")?;
        return Ok(true);
    }
    let mut cargo = Command::new("cargo");
    cargo.args(["deny", "check", "bans", "licenses", "sources"]).env("PATH", path);
    Ok(cargo.status().context("`cargo` cannot be started")?.success())
}

/// Everything that can be said of the emitted Verilog, as a table.
fn prove(root: &Path, extent: &Extent, write: bool, out: &mut impl Write) -> anyhow::Result<bool> {
    let sources = Sources::of(root);
    let witness_folder = root.join("target/witnesses");
    std::fs::create_dir_all(&witness_folder)?;
    let shares = rows::all(&sources, &witness_folder, extent)?;
    writeln!(out, "{}", markdown(&shares))?;
    let good = rows::good(&shares);
    if write {
        document::write(root, &sources, shares)?;
        for stale in document::stale(root, &sources)? {
            writeln!(out, "still stale: {stale}")?;
        }
    }
    Ok(good)
}
