//! The original's gates in Icarus: the same edges as in our simulator, all of them, of every wire.
//!
//! Icarus runs the structural Verilog of a circuit with native gates, and writes a value change dump;
//! that is read back and compared with our edges one by one. [`Campaign`] does so for every figure
//! and many sets of delays, keeps a row for each, and goes on where it was interrupted.

mod campaign;
mod edges;
mod record;

use std::path::Path;
use std::process::Command;

use anyhow::{bail, ensure};
use helixlock_original::{Change, Circuit, Delays, Edge, Simulator, bench, verilog};

use crate::tools::{run, write_scratch};

pub use self::campaign::{CIRCUITS, Campaign, Case};
pub use self::record::{Row, rows};

/// Behind the last change, ps.
const TAIL_PS: u64 = 50_000_000;

/// How the Verilog has its delays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// At gate primitives.
    Gates,
    /// In specify blocks.
    Paths,
}

/// What our simulator makes of the changes: all edges, in the order of time.
///
/// # Errors
///
/// When the gates do not come to rest, or changes are not in the order of time.
pub fn ours(circuit: &Circuit, delays: &Delays, changes: &[Change]) -> anyhow::Result<Vec<Edge>> {
    let mut simulator = Simulator::new(circuit, delays)?;
    for (time_ps, pin, level) in changes {
        simulator.drive(*time_ps, *pin, *level)?;
    }
    simulator.run_until(changes.last().map_or(0, |last| last.0) + TAIL_PS);
    Ok(simulator.take_edges())
}

/// Compares both, and gives the number of edges.
///
/// # Errors
///
/// The first edge that differs, or why Icarus cannot be run.
pub fn agree(
    circuit: &Circuit,
    delays: &Delays,
    changes: &[Change],
    style: Style,
) -> anyhow::Result<usize> {
    let ours = ours(circuit, delays, changes)?;
    let icarus = icarus(circuit, delays, changes, style)?;
    let differs = ours.iter().zip(&icarus).find(|(one, other)| one != other);
    if let Some((one, other)) = differs {
        let named = |edge: &Edge| {
            format!("{} {} at {} ps", circuit.nets[edge.net.0], u8::from(edge.level), edge.time_ps)
        };
        bail!("{}: ours has {}, Icarus {}", circuit.name, named(one), named(other));
    }
    let name = &circuit.name;
    ensure!(ours.len() == icarus.len(), "{name}: {} edges, {} of Icarus", ours.len(), icarus.len());
    Ok(ours.len())
}

/// What Icarus makes of the changes: all edges, in the order of time.
///
/// # Errors
///
/// When Icarus cannot be run.
pub fn icarus(
    circuit: &Circuit,
    delays: &Delays,
    changes: &[Change],
    style: Style,
) -> anyhow::Result<Vec<Edge>> {
    let levels = Simulator::new(circuit, delays)?.levels().to_vec();
    let bench = bench(circuit, delays, &levels, changes, TAIL_PS);
    let scratch = tempfile::tempdir()?;
    let folder = scratch.path();
    write_scratch(&folder.join("device.v"), &verilog(circuit, delays, &levels))?;
    write_scratch(&folder.join("bench.v"), &bench.text)?;
    write_scratch(&folder.join("stimuli.hex"), &bench.stimuli)?;
    let style: &[&str] = if style == Style::Paths { &["-gspecify", "-DPATH_DELAYS"] } else { &[] };
    let words = ["-g2005", "-Wall", "-Wno-timescale", "-s", "bench", "-o", "bench.vvp"];
    tool(folder, "iverilog", &[&words[..], style, &["device.v", "bench.v"]].concat())?;
    tool(folder, "vvp", &["-n", "bench.vvp"])?;
    edges::read_edges(&folder.join("edges.vcd"), circuit, bench.begins_ps)
}

fn tool(folder: &Path, name: &str, words: &[&str]) -> anyhow::Result<()> {
    let (content, said) = run(Command::new(name).args(words).current_dir(folder), "iverilog")?;
    ensure!(content && !said.contains("warning"), "{name}: {said}");
    Ok(())
}
