//! Simulators of others, built from the Verilog we emit.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, bail};
use helixlock_netlist::{Library, Netlist, elaborate};
use helixlock_sim::device;

use crate::Run;
use crate::stimulus::PinEvent;

/// A simulator ready to run.
pub(crate) struct Peer {
    pub(crate) name: String,
    /// It gets fewer clocks.
    pub(crate) slow: bool,
    command: Vec<PathBuf>,
}

impl Peer {
    /// Runs the first `clocks` clocks of the stimulus.
    pub(crate) fn run(
        &self,
        events: &[PinEvent],
        clocks: u64,
        folder: &Path,
    ) -> anyhow::Result<Run> {
        let file = folder.join("stimulus.txt");
        write(&file, &stimulus(events, clocks))?;
        let mut command = Command::new(&self.command[0]);
        let output = command.args(&self.command[1..]).arg(&file).current_dir(folder).output();
        let output = output.with_context(|| self.name.clone())?;
        let text = String::from_utf8(output.stdout)?;
        let line = text.lines().find_map(|line| line.strip_prefix("end "));
        let line = line.with_context(|| format!("{} printed {text}", self.name))?;
        let (seconds, state) = line.split_once(' ').context("seconds and state")?;
        Ok(Run { seconds: seconds.parse()?, clocks, state: format!("{} ", state.trim()) })
    }
}

/// All peers, built in a folder.
pub(crate) fn all(folder: &Path) -> anyhow::Result<Vec<Peer>> {
    let verilog = folder.join("device.v");
    write(&verilog, &emitted()?)?;
    Ok(vec![
        verilator(folder, &verilog)?,
        verilator_profiled(folder, &verilog)?,
        cxxrtl(folder, &verilog)?,
        icarus(folder, &verilog)?,
    ])
}

fn emitted() -> anyhow::Result<String> {
    let card = helixlock_rtl::BLOCKS.iter().find(|card| card.name == "device");
    let block = (card.context("no block is called `device`")?.build)();
    let modules = helixlock_gen::verilog(&elaborate("device", block.as_ref(), &Library::new())?)?;
    Ok(modules.into_iter().map(|(_, text)| text).collect())
}

fn verilator(folder: &Path, verilog: &Path) -> anyhow::Result<Peer> {
    let command = verilated(folder, verilog, "plain", "-O3")?;
    Ok(Peer { name: "Verilator -O3".into(), slow: false, command: vec![command] })
}

/// Built, run on a short dense stimulus to see where it spends its time, and built again.
fn verilator_profiled(folder: &Path, verilog: &Path) -> anyhow::Result<Peer> {
    let profile = folder.join("profile");
    let generate = format!("-O3 -fprofile-generate={}", profile.display());
    let command = verilated(folder, verilog, "profiled", &generate)?;
    let trial = Peer { name: "profile run".into(), slow: false, command: vec![command] };
    let events = crate::stimulus::dense(device().netlist(), 200_000);
    trial.run(&events, 200_000, folder)?;
    let used = format!(
        "-O3 -flto -fprofile-use={} -fprofile-correction -Wno-missing-profile",
        profile.display()
    );
    let command = verilated(folder, verilog, "profiled", &used)?;
    Ok(Peer { name: "Verilator PGO, LTO".into(), slow: false, command: vec![command] })
}

fn verilated(folder: &Path, verilog: &Path, name: &str, flags: &str) -> anyhow::Result<PathBuf> {
    let objects = folder.join(name);
    let main = folder.join(format!("{name}.cpp"));
    let state = |path: &str| format!("top.rootp->device__DOT__{}", path.replace('.', "__DOT__"));
    let text = include_str!("verilator.cpp");
    write(&main, &filled(text, |input| format!("top.{input}"), state))?;
    tool(
        Command::new("verilator")
            .args(["--cc", "--exe", "--build", "-O3", "--flatten"])
            .args([
                "--x-assign",
                "fast",
                "--x-initial",
                "fast",
                "--noassert",
                "--top-module",
                "device",
                "-Wno-fatal",
                "-CFLAGS",
                flags,
                "-LDFLAGS",
                flags,
                "-o",
                "peer",
                "--Mdir",
            ])
            .args([&objects, &main, verilog]),
    )?;
    Ok(objects.join("peer"))
}

fn cxxrtl(folder: &Path, verilog: &Path) -> anyhow::Result<Peer> {
    let source = folder.join("cxxrtl_device.cc");
    let script = format!(
        "read_verilog {}; hierarchy -top device; proc; flatten; write_cxxrtl -O6 {}",
        verilog.display(),
        source.display()
    );
    tool(Command::new("yosys").args(["-q", "-p", &script]))?;
    let main = folder.join("cxxrtl.cpp");
    let state = |path: &str| format!("word(items, \"{}\")", path.replace('.', " "));
    let input = |name: &str| format!("top.p_{}.data[0]", name.replace('_', "__"));
    write(&main, &filled(include_str!("cxxrtl.cpp"), input, state))?;
    let include = "/usr/share/yosys/include";
    let binary = folder.join("cxxrtl");
    let mut compiler = Command::new("g++");
    compiler.args(["-O3", "-std=c++14", "-I", include, "-o"]).args([&binary, &main]);
    tool(&mut compiler)?;
    Ok(Peer { name: "CXXRTL -O6".into(), slow: false, command: vec![binary] })
}

fn icarus(folder: &Path, verilog: &Path) -> anyhow::Result<Peer> {
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
            .args([&binary, &bench, verilog]),
    )?;
    let runner = folder.join("icarus.sh");
    write(&runner, include_str!("icarus.sh"))?;
    Ok(Peer { name: "Icarus".into(), slow: true, command: vec!["bash".into(), runner, binary] })
}

/// The program text with the device's inputs and registers filled in.
fn filled(text: &str, input: impl Fn(&str) -> String, state: impl Fn(&str) -> String) -> String {
    let mut pins = String::new();
    for (index, (name, _)) in inputs().iter().enumerate() {
        // Writing into a string does not fail.
        let _ = writeln!(pins, "        case {index}: {} = value; break;", input(name));
    }
    let mut words = String::new();
    for path in registers() {
        let _ = writeln!(words, "    print({});", state(&path));
    }
    text.replace("@PINS@", &pins).replace("@STATE@", &words)
}

fn inputs() -> Vec<(String, u32)> {
    let netlist = device().netlist();
    let signals = netlist.inputs.iter().map(|input| netlist.signal(*input));
    signals.map(|signal| (signal.path.clone(), signal.width)).collect()
}

fn registers() -> Vec<String> {
    let netlist: &Netlist = device().netlist();
    let outputs = netlist.registers.iter().map(|register| netlist.signal(register.output));
    outputs.map(|signal| signal.path.clone()).collect()
}

/// Number of clocks, number of events, and the events.
fn stimulus(events: &[PinEvent], clocks: u64) -> String {
    let events: Vec<_> = events.iter().take_while(|event| event.clock < clocks).collect();
    let mut text = format!("{clocks} {}\n", events.len());
    for event in events {
        // Writing into a string does not fail.
        let _ = writeln!(text, "{} {} {}", event.clock, event.pin, event.value);
    }
    text
}

fn tool(command: &mut Command) -> anyhow::Result<()> {
    let output = command.output().with_context(|| format!("{command:?}"))?;
    if !output.status.success() {
        bail!("{command:?}\n{}", String::from_utf8_lossy(&output.stderr));
    }
    Ok(())
}

#[expect(clippy::disallowed_methods, reason = "files in a temporary folder")]
fn write(path: &Path, text: &str) -> anyhow::Result<()> {
    std::fs::write(path, text).with_context(|| path.display().to_string())
}
