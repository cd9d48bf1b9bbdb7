//! CXXRTL, Yosys' own simulator.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::build::{Trial, filled, tool, write};
use crate::tools::Tool;

/// Compiles the device with those flags of the compiler.
pub(crate) fn compiled(
    yosys: &Tool,
    verilog: &Path,
    Trial { folder, flags }: &Trial,
) -> anyhow::Result<PathBuf> {
    let device = folder.join("cxxrtl_device.cc");
    let script = format!(
        "read_verilog {}; hierarchy -top device; proc; flatten; write_cxxrtl -O6 {}",
        verilog.display(),
        device.display()
    );
    tool(Command::new(&yosys.command).args(["-q", "-p", &script]))?;
    let main = folder.join("main.cpp");
    let state = |path: &str| format!("word(items, \"{}\")", path.replace('.', " "));
    let input = |name: &str| format!("top.p_{}.data[0]", name.replace('_', "__"));
    write(&main, &filled(include_str!("cxxrtl.cpp"), input, state))?;
    let binary = folder.join("peer");
    let mut compiler = Command::new("g++");
    compiler.args(flags.split(' ')).arg("-std=c++14").arg("-I").arg(&yosys.folder);
    tool(compiler.arg("-o").args([&binary, &main]))?;
    Ok(binary)
}
