//! Work on the project itself; nothing a user needs.

use std::ffi::OsStr;
use std::io::Write;
use std::path::Path;
use std::process::{Command, ExitCode};
use std::thread;

use anyhow::{Context, anyhow, ensure};
use clap::Parser;
use xtask::python;
use xtask::setup::Tools;

/// Work on the project itself
#[derive(Debug, Parser)]
#[command(
    after_help = "Compiled when asked for, each with --help: prove, icarus, same-output, sbom"
)]
enum Task {
    /// Format, lints, documentation, tests and the Python package; what is missing of tools is installed meanwhile
    Check {
        /// Say what is missing and stop
        #[arg(long)]
        no_install: bool,
    },
    /// The tests that are too long for every check
    Campaign {
        /// All tests, with every record, board, screen and odd input that they know, not the few of a check: hours
        #[arg(long)]
        every_record: bool,
        /// Only tests with one of these in their names
        names: Vec<String>,
    },
    /// Of the crate `evidence`, which stands on most of the project.
    #[command(external_subcommand)]
    Evidence(Vec<String>),
}

/// Exit status: 0 good, 1 not good, 2 it cannot be told.
fn main() -> ExitCode {
    // Not locked: what is installed meanwhile is said there too.
    match run(Task::parse(), &mut std::io::stdout()) {
        Ok(status) => ExitCode::from(status),
        Err(error) => {
            // Nothing is left to tell the user if this fails too.
            let _ = writeln!(std::io::stderr(), "xtask: {error:#}");
            ExitCode::from(2)
        }
    }
}

fn run(task: Task, out: &mut impl Write) -> anyhow::Result<u8> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().context("the repository")?;
    match task {
        Task::Check { no_install } => Ok(u8::from(!check(root, no_install, out)?)),
        Task::Campaign { every_record, names } => {
            Ok(u8::from(!campaign(&Tools::of(root).path()?, every_record, &names)?))
        }
        Task::Evidence(words) => evidence(root, &words),
    }
}

/// Commands of `evidence`: another word is refused before anything is compiled.
const EVIDENCE: [&str; 4] = ["prove", "icarus", "same-output", "sbom"];

/// Its exit status.
fn evidence(root: &Path, words: &[String]) -> anyhow::Result<u8> {
    let word = words.first().map_or("", String::as_str);
    ensure!(
        EVIDENCE.contains(&word),
        "found `{word}`, expected check, campaign, {}",
        EVIDENCE.join(", ")
    );
    let mut cargo = Command::new("cargo");
    cargo.args(["run", "--quiet", "--package", "helixlock-evidence", "--"]).args(words);
    let path = Tools::of(root).path()?;
    let status = cargo.env("PATH", path).status().context("`cargo` cannot be started")?;
    Ok(status.code().and_then(|code| u8::try_from(code).ok()).unwrap_or(2))
}

/// What has to pass, cheapest first: words of cargo.
const CHECKS: &[&[&str]] = &[
    &["fmt", "--all", "--check"],
    &["clippy", "--workspace", "--all-targets", "--", "-D", "warnings"],
    &["test", "--workspace", "--no-run"],
];
const TESTS: &[&str] = &["test", "--workspace"];
const DOCUMENTATION: &[&str] =
    &["doc", "--no-deps", "--workspace", "--config", "build.rustdocflags=['-D', 'warnings']"];

/// What asks a test for every record that it knows.
const EVERY_RECORD: [&str; 5] = [
    "HELIXLOCK_BOARD",
    "HELIXLOCK_HOSTILE",
    "HELIXLOCK_ODD_MACHINES",
    "HELIXLOCK_SEEDS",
    "HELIXLOCK_WORKBENCH",
];
/// Tests that measure time: each is run alone, on a quiet machine.
const TIMED: [&str; 2] = ["below_fifty_milliseconds_a_frame", "open_in_ten_seconds"];

/// Whether the tests pass that a check leaves out; with every record, all tests.
fn campaign(path: &OsStr, every_record: bool, names: &[String]) -> anyhow::Result<bool> {
    let which = if every_record { "--include-ignored" } else { "--ignored" };
    let mut cargo = Command::new("cargo");
    cargo.args(["test", "--workspace", "--no-fail-fast", "--lib", "--tests", "--", which]);
    cargo.args(TIMED.iter().flat_map(|test| ["--skip", test])).args(names).env("PATH", path);
    if every_record {
        cargo.envs(EVERY_RECORD.map(|variable| (variable, "all")));
    }
    Ok(cargo.status().context("`cargo` cannot be started")?.success())
}

/// Runs the checks up to the first that fails.
fn check(root: &Path, no_install: bool, out: &mut impl Write) -> anyhow::Result<bool> {
    let tools = Tools::of(root);
    if no_install {
        tools.prepare(false)?;
    }
    let path = tools.path()?;
    // Packages are fetched while the processors compile; the tests, which wait for browsers and boards, leave
    // time for Python and the documentation.
    let installed = || tools.prepare(!no_install).and_then(|()| python::install(root, &path));
    let passed = both(|| cargo_checks(&path), installed)?
        && both(
            || cargo(&path, TESTS),
            || Ok(python::check(root, &path)? && cargo(&path, DOCUMENTATION)?),
        )?;
    Ok(passed && deny(&path, out)?)
}

/// Whether two checks that run side by side pass.
fn both(
    one: impl FnOnce() -> anyhow::Result<bool>,
    other: impl FnOnce() -> anyhow::Result<bool> + Send,
) -> anyhow::Result<bool> {
    let (one, other) = thread::scope(|scope| {
        let other = scope.spawn(other);
        (one(), other.join().unwrap_or_else(|_| Err(anyhow!("a thread of the checks has died"))))
    });
    Ok(one? && other?)
}

/// Whether all of them pass; none is begun after one that does not.
fn cargo_checks(path: &OsStr) -> anyhow::Result<bool> {
    for words in CHECKS {
        if !cargo(path, words)? {
            return Ok(false);
        }
    }
    Ok(true)
}

/// Whether cargo ends well; why it does not, it says itself.
fn cargo(path: &OsStr, words: &[&str]) -> anyhow::Result<bool> {
    let mut cargo = Command::new("cargo");
    cargo.args(words).env("PATH", path);
    Ok(cargo.status().context("`cargo` cannot be started")?.success())
}

/// Licences, bans and origins by `cargo deny`, where it is installed; `tests/licences.rs` holds to
/// the same rules without it.
fn deny(path: &OsStr, out: &mut impl Write) -> anyhow::Result<bool> {
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
