//! Icarus, which interprets.

use std::fmt::Write as _;
use std::path::Path;
use std::process::Command;

use crate::build::{Peer, inputs, registers, tool, write};

/// Compiles the device for `vvp`.
pub(crate) fn icarus(folder: &Path, verilog: &Path) -> anyhow::Result<Peer> {
    let bench = folder.join("icarus.v");
    let values: Vec<String> = registers().iter().map(|path| format!("device.{path}")).collect();
    let mut ports = String::new();
    let mut connections = String::new();
    let mut pins = String::new();
    for (index, (name, width)) in inputs().iter().enumerate() {
        writeln!(ports, "reg [{}:0] {name} = 0;", width - 1)?;
        write!(connections, ", .{name}({name})")?;
        writeln!(pins, "        {index}: {name} = value;")?;
    }
    let text = include_str!("icarus.v")
        .replace("@PORTS@", &ports)
        .replace("@CONNECTIONS@", &connections)
        .replace("@PINS@", &pins)
        .replace("@FORMAT@", &"%h ".repeat(values.len()))
        .replace("@STATE@", &values.join(", "));
    write(&bench, &text)?;
    let binary = folder.join("icarus");
    tool(
        Command::new("iverilog")
            .args(["-g2005-sv", "-s", "bench", "-o"])
            .args([&binary, &bench])
            .arg(verilog),
    )?;
    let runner = folder.join("icarus.sh");
    write(&runner, include_str!("icarus.sh"))?;
    Ok(Peer { name: "Icarus".into(), slow: true, command: vec!["bash".into(), runner, binary] })
}
