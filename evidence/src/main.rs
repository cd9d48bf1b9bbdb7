//! `cargo xtask prove`, `icarus`, `same-output` and `sbom`.

use std::io::Write;
use std::path::Path;
use std::process::ExitCode;

use anyhow::Context;
use clap::Parser;
use helixlock_evidence::icarus::Campaign;
use helixlock_evidence::prove::rows::{self, Extent};
use helixlock_evidence::prove::table::markdown;
use helixlock_evidence::prove::{Sources, document};
use helixlock_evidence::same_output::SameOutput;
use helixlock_evidence::sbom::sbom;

/// What the project says of itself, and how it is known
#[derive(Debug, Parser)]
enum Task {
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
    /// The gates of the original in Icarus against our simulator, edge by edge
    Icarus(Campaign),
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
            let _ = writeln!(std::io::stderr(), "evidence: {error:#}");
            ExitCode::from(2)
        }
    }
}

/// Whether all is good.
fn run(task: Task, out: &mut impl Write) -> anyhow::Result<bool> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().context("the repository")?;
    match task {
        Task::Prove { short, block, write } => {
            let one_in = if short { 20 } else { 1 };
            prove(root, &Extent { one_in, block }, write, out)
        }
        Task::Icarus(task) => task.run(root, out),
        Task::Sbom => {
            write!(out, "{}", sbom(root)?)?;
            Ok(true)
        }
        Task::SameOutput(task) => task.run(root, out),
    }
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
