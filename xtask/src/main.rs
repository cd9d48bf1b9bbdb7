//! Work on the project itself; nothing a user needs.

use std::process::{Command, ExitCode};

use anyhow::{Context, bail};
use clap::Parser;

/// Work on the project itself
#[derive(Debug, Parser)]
enum Task {
    /// Format, lints, documentation and all tests, cheapest first
    Check,
}

fn main() -> anyhow::Result<ExitCode> {
    match Task::parse() {
        Task::Check => check(),
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
