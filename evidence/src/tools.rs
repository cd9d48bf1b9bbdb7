//! Scratch files, and the tools run on them.

use std::path::Path;
use std::process::{Command, Output};

use anyhow::Context;

/// FNV-1a.
pub(crate) fn fnv(bytes: impl IntoIterator<Item = u8>) -> u64 {
    let mix = |hash: u64, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    bytes.into_iter().fold(0xcbf2_9ce4_8422_2325, mix)
}

/// A whole text file.
pub(crate) fn read(path: &Path) -> anyhow::Result<String> {
    std::fs::read_to_string(path).with_context(|| path.display().to_string())
}

/// A scratch file for a tool, in a folder of its own.
#[expect(clippy::disallowed_methods, reason = "scratch for a tool, thrown away with its folder")]
pub(crate) fn write_scratch(path: &Path, text: &(impl AsRef<[u8]> + ?Sized)) -> anyhow::Result<()> {
    std::fs::write(path, text).with_context(|| path.display().to_string())
}

/// Runs yosys on a script, and gives what it logged and whether it was content.
pub(crate) fn yosys(script: &str) -> anyhow::Result<(bool, String)> {
    run(Command::new("yosys").args(["-p", script]), "yosys")
}

/// Runs a tool, and gives what it said and whether it was content.
pub(crate) fn run(command: &mut Command, package: &str) -> anyhow::Result<(bool, String)> {
    let Output { status, stdout, stderr } = command
        .output()
        .with_context(|| format!("`{package}` cannot be started; it is a Debian package"))?;
    let said = [stdout, stderr].concat();
    Ok((status.success(), String::from_utf8_lossy(&said).into_owned()))
}
