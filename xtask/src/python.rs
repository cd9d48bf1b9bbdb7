//! `import helixlock`: its tests, its types and its notebook.
//!
//! The package is laid out as the wheel holds it, around the library that the workspace's build
//! gives. `pip install .` makes the same by a second build of everything, with optimisation, which
//! is too long for a check.

use std::ffi::OsStr;
use std::fs;
use std::path::Path;
use std::process::Command;

use anyhow::Context;

/// The package, as it lies in a wheel.
const PACKAGE: &str = "target/python/package";

/// Lines of a shell: for the packages that the tests need, before the package is laid out, and after.
const INSTALL: &[&str] = &[
    "python3 -m venv target/python",
    // The first that knows the groups of PEP 735.
    "target/python/bin/pip install --quiet pip>=25.1",
    "target/python/bin/pip install --quiet --group test",
];
const BUILD: &[&str] = &["cargo build --workspace --lib"];
const AFTER: &[&str] = &[
    "target/python/bin/python -m mypy python/helixlock python/tests",
    "target/python/bin/python -m mypy.stubtest helixlock._native",
    "target/python/bin/python -m pytest --quiet",
    "target/python/bin/python examples/notebook/worm.py",
];

/// Installs what the tests need; whether it could be, pip says itself.
///
/// # Errors
///
/// When a tool cannot be started.
pub fn install(root: &Path, path: &OsStr) -> anyhow::Result<bool> {
    run_all(INSTALL, root, path)
}

/// Whether all of it is good; what is not, the tools say themselves.
///
/// # Errors
///
/// When a tool cannot be started, or the package cannot be laid out.
pub fn check(root: &Path, path: &OsStr) -> anyhow::Result<bool> {
    if !run_all(BUILD, root, path)? {
        return Ok(false);
    }
    lay_out(root).with_context(|| format!("`{PACKAGE}` cannot be written"))?;
    run_all(AFTER, root, path)
}

fn run_all(steps: &[&str], root: &Path, path: &OsStr) -> anyhow::Result<bool> {
    for step in steps {
        let mut words = step.split(' ');
        let name = words.next().context("a step has words")?;
        let mut command = Command::new(name);
        command.args(words).current_dir(root).env("PATH", path);
        command.env("PYTHONPATH", root.join(PACKAGE)).env("MPLBACKEND", "Agg");
        if !command.status().with_context(|| format!("`{name}` cannot be started"))?.success() {
            return Ok(false);
        }
    }
    Ok(true)
}

fn lay_out(root: &Path) -> std::io::Result<()> {
    let package = root.join(PACKAGE).join("helixlock");
    fs::create_dir_all(&package)?;
    for file in fs::read_dir(root.join("python/helixlock"))? {
        let file = file?;
        if file.file_type()?.is_file() {
            fs::copy(file.path(), package.join(file.file_name()))?;
        }
    }
    let library = root.join("target/debug/libhelixlock_python.so");
    fs::copy(library, package.join("_native.abi3.so")).map(|_| ())
}
