//! Verilator, optimised for speed in all it compiles.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::build::{Trial, filled, tool, write};
use crate::tools::Tool;

/// Compiles the device with those flags of the compiler.
///
/// The makefile of Verilator puts its own `-Os` behind `-CFLAGS`: its variables have to be set.
pub(crate) fn compiled(
    verilator: &Tool,
    verilog: &Path,
    Trial { folder, flags }: &Trial,
) -> anyhow::Result<PathBuf> {
    let main = folder.join("main.cpp");
    let state = |path: &str| format!("top.rootp->device__DOT__{}", path.replace('.', "__DOT__"));
    let text = include_str!("verilator.cpp");
    write(&main, &filled(text, |input| format!("top.{input}"), state))?;
    tool(
        Command::new(&verilator.command)
            .envs(verilator.folder.iter().map(|folder| ("VERILATOR_ROOT", folder)))
            .args(["--cc", "--exe", "--build", "-O3", "--flatten", "--noassert", "-Wno-fatal"])
            .args(["--x-assign", "fast", "--x-initial", "fast", "--top-module", "device"])
            .args(["-MAKEFLAGS", "OPT_FAST=-O3 OPT_SLOW=-O3 OPT_GLOBAL=-O3"])
            .args(["-CFLAGS", flags, "-LDFLAGS", flags, "-o", "peer", "--Mdir"])
            .args([folder, &main, verilog]),
    )?;
    Ok(Path::new(folder).join("peer"))
}
