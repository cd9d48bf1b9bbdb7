//! Simulators of others, built from the Verilog we emit, each as quick as it can be made.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, bail};
use helixlock_netlist::{Library, Netlist, elaborate};
use helixlock_sim::device;

use crate::stimulus::PinEvent;
use crate::{Run, cxxrtl, icarus, tools, verilator};

/// A simulator ready to run.
pub(crate) struct Peer {
    pub(crate) name: String,
    /// It gets fewer clocks.
    pub(crate) slow: bool,
    pub(crate) command: Vec<PathBuf>,
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

/// The program text with the device's inputs and registers filled in.
pub(crate) fn filled(
    text: &str,
    input: impl Fn(&str) -> String,
    state: impl Fn(&str) -> String,
) -> String {
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

/// Where a peer is compiled, and with which flags.
pub(crate) struct Trial {
    pub(crate) folder: PathBuf,
    pub(crate) flags: String,
}

/// All peers, built in a folder.
pub(crate) fn all(folder: &Path) -> anyhow::Result<Vec<Peer>> {
    let verilog = folder.join("device.v");
    write(&verilog, &emitted()?)?;
    let mut peers = Vec::new();
    for tool in tools::verilators()? {
        peers.extend(twice(folder, &tool.name, &|trial| {
            verilator::compiled(&tool, &verilog, trial)
        })?);
    }
    for tool in tools::yosyses()? {
        peers.extend(twice(folder, &tool.name, &|trial| cxxrtl::compiled(&tool, &verilog, trial))?);
    }
    peers.push(icarus::icarus(folder, &verilog)?);
    Ok(peers)
}

/// Compiled as it is; and run on a short dense stimulus to see where it spends its time, compiled
/// again for that, and optimised across files.
fn twice(
    folder: &Path,
    name: &str,
    compiled: &dyn Fn(&Trial) -> anyhow::Result<PathBuf>,
) -> anyhow::Result<[Peer; 2]> {
    let at = |place: &str, flags: String| -> anyhow::Result<Trial> {
        let folder = folder.join(name.replace(' ', "-")).join(place);
        std::fs::create_dir_all(&folder).with_context(|| folder.display().to_string())?;
        Ok(Trial { folder, flags })
    };
    let peer = |name: &str, binary| Peer { name: name.into(), slow: false, command: vec![binary] };
    let plain = peer(name, compiled(&at("plain", "-O3".into())?)?);
    let profile = folder.join(name.replace(' ', "-")).join("profile");
    let counting = at("profiled", format!("-O3 -fprofile-generate={}", profile.display()))?;
    let events = crate::stimulus::dense(device().netlist(), 200_000);
    peer("profile run", compiled(&counting)?).run(&events, 200_000, folder)?;
    let used = at(
        "profiled",
        format!(
            "-O3 -flto -fprofile-use={} -fprofile-correction -Wno-missing-profile",
            profile.display()
        ),
    )?;
    Ok([plain, peer(&format!("{name}, PGO and LTO"), compiled(&used)?)])
}

fn emitted() -> anyhow::Result<String> {
    let card = helixlock_rtl::BLOCKS.iter().find(|card| card.name == "device");
    let block = (card.context("no block is called `device`")?.build)();
    let modules = helixlock_gen::verilog(&elaborate("device", block.as_ref(), &Library::new())?)?;
    Ok(modules.into_iter().map(|(_, text)| text).collect())
}

/// Names and widths of the device's inputs.
pub(crate) fn inputs() -> Vec<(String, u32)> {
    let netlist = device().netlist();
    let signals = netlist.inputs.iter().map(|input| netlist.signal(*input));
    signals.map(|signal| (signal.path.clone(), signal.width)).collect()
}

/// Paths of the device's registers.
pub(crate) fn registers() -> Vec<String> {
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

/// Runs a tool to its end.
pub(crate) fn tool(command: &mut Command) -> anyhow::Result<()> {
    let output = command.output().with_context(|| format!("{command:?}"))?;
    if !output.status.success() {
        bail!("{command:?}\n{}", String::from_utf8_lossy(&output.stderr));
    }
    Ok(())
}

/// Writes a file of the peers' folder.
#[expect(clippy::disallowed_methods, reason = "files in a temporary folder")]
pub(crate) fn write(path: &Path, text: &str) -> anyhow::Result<()> {
    std::fs::write(path, text).with_context(|| path.display().to_string())
}
