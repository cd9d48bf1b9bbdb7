//! `import helixlock` as a user gets it: installed by pip into an environment of its own, then its
//! tests, its types and its notebook.

use std::ffi::OsStr;
use std::path::Path;
use std::process::Command;

use anyhow::Context;

/// Lines of a shell, the environment below `target/python`.
///
/// The wheel is built as the tests are, from what they have left: it is as quick as they are.
const STEPS: &[&str] = &[
    "python3 -m venv target/python",
    "target/python/bin/pip install --quiet .[test]",
    "target/python/bin/python -m mypy python/helixlock python/tests",
    "target/python/bin/python -m mypy.stubtest helixlock._native",
    "target/python/bin/python -m pytest --quiet",
    "target/python/bin/python examples/notebook/worm.py",
];

/// Whether all of it is good; what is not, the tools say themselves.
///
/// # Errors
///
/// When a tool cannot be started.
pub fn check(root: &Path, path: &OsStr) -> anyhow::Result<bool> {
    for step in STEPS {
        let mut words = step.split(' ');
        let name = words.next().context("a step has words")?;
        let mut command = Command::new(name);
        command.args(words).current_dir(root).env("PATH", path);
        command.env("MATURIN_PEP517_ARGS", "--profile dev").env("MPLBACKEND", "Agg");
        if !command.status().with_context(|| format!("`{name}` cannot be started"))?.success() {
            return Ok(false);
        }
    }
    Ok(true)
}
