//! Builds of the command: of the present tree, and of a commit.

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, ensure};

/// The command of the present tree, copied into a folder.
///
/// # Errors
///
/// When it does not build.
pub(super) fn present(root: &Path, folder: &Path) -> anyhow::Result<PathBuf> {
    build(root, root, &folder.join("helixlock"))
}

/// The command of a commit, copied into a folder named after it; one that is there already is
/// taken as it is.
///
/// # Errors
///
/// When git knows no such commit or it does not build.
pub(super) fn of_commit(root: &Path, revision: &str, folder: &Path) -> anyhow::Result<PathBuf> {
    let commit =
        git(root, &["rev-parse", "--verify", "--quiet", &format!("{revision}^{{commit}}")])
            .with_context(|| format!("`{revision}` is no commit"))?;
    let kept = folder.join(&commit).join("helixlock");
    if kept.exists() {
        return Ok(kept);
    }
    let tree = folder.join("tree");
    let place = tree.to_str().context("the path of the repository is no text")?;
    if tree.exists() {
        git(root, &["worktree", "remove", "--force", place])?;
    }
    git(root, &["worktree", "add", "--quiet", "--force", "--detach", place, &commit])?;
    let built = build(root, &tree, &kept);
    git(root, &["worktree", "remove", "--force", place])?;
    built
}

/// Builds a tree; all trees share the repository's folder for it, so that dependencies are built
/// once.
fn build(root: &Path, tree: &Path, copy: &Path) -> anyhow::Result<PathBuf> {
    let target = root.join("target");
    let status = Command::new("cargo")
        .args(["build", "--release", "--bin", "helixlock"])
        .current_dir(tree)
        .env("CARGO_TARGET_DIR", &target)
        .status()
        .context("`cargo` cannot be started")?;
    ensure!(status.success(), "{} does not build", tree.display());
    let folder = copy.parent().context("a file lies in a folder")?;
    std::fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
    std::fs::copy(target.join("release/helixlock"), copy)
        .with_context(|| copy.display().to_string())?;
    Ok(copy.to_owned())
}

/// What git says, without the line's end.
fn git(root: &Path, words: &[&str]) -> anyhow::Result<String> {
    let output = Command::new("git").args(words).current_dir(root).output();
    let output = output.context("`git` cannot be started")?;
    let said = String::from_utf8_lossy(&output.stderr);
    ensure!(output.status.success(), "`git {}` failed: {}", words.join(" "), said.trim());
    Ok(String::from_utf8_lossy(&output.stdout).trim().to_owned())
}
