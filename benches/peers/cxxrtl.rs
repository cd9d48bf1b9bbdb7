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
    // By name alone: a Yosys in a sandbox sees no other folder than the one it runs in.
    std::fs::copy(verilog, folder.join("device.v"))?;
    let script = "read_verilog device.v; hierarchy -top device; proc; flatten; \
                  write_cxxrtl -O6 cxxrtl_device.cc";
    tool(Command::new(&yosys.command).current_dir(folder).args(["-q", "-p", script]))?;
    let main = folder.join("main.cpp");
    let state = |path: &str| format!("word(items, \"{}\")", path.replace('.', " "));
    let input = |name: &str| format!("top.p_{}.data[0]", name.replace('_', "__"));
    write(&main, &filled(include_str!("cxxrtl.cpp"), input, state))?;
    let binary = folder.join("peer");
    let headers = yosys.folder.as_deref().unwrap_or(Path::new("/usr/share/yosys/include"));
    let mut compiler = Command::new("g++");
    compiler.args(flags.split(' ')).arg("-std=c++14").arg("-I").arg(headers);
    tool(compiler.arg("-o").args([&binary, &main]))?;
    Ok(binary)
}
