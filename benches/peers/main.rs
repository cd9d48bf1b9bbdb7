//! The same pins, clock by clock, for our engines and for others made from our Verilog.
//!
//! ```text
//! cargo bench --bench peers -- run
//! ```
//!
//! builds Verilator and CXXRTL (Debian's and the newest, plain and guided by a profile) and Icarus
//! from the emitted Verilog, runs all of them alternately, holds every end state to ours, and prints
//! the tables of `docs/performance.md`. Times are processor time, so that another program on the
//! machine does not count. Nobody is compiled for one processor alone (`-march=native`).

#![allow(clippy::print_stdout, reason = "a benchmark prints what it measured")]
#![allow(clippy::cast_precision_loss, reason = "clocks stay below 2⁵³")]

mod build;
mod cxxrtl;
mod icarus;
mod ours;
#[path = "../stimulus.rs"]
mod stimulus;
mod table;
mod tools;
mod verilator;

use std::path::Path;

use helixlock_sim::device;

use crate::build::Peer;
use crate::stimulus::{PinEvent, all_active, dense, held, irregular, pass};
use crate::table::Column;

/// Runs of each engine; the quickest counts.
const ROUNDS: usize = 5;

/// One stimulus, and how much of it the slow ones get.
struct Work {
    name: &'static str,
    events: Vec<PinEvent>,
    clocks: u64,
    clocks_for_slow: u64,
}

/// What a run took, and where it ended.
struct Run {
    seconds: f64,
    clocks: u64,
    /// Every register, in order, as hexadecimal words.
    state: String,
}

fn main() -> anyhow::Result<()> {
    if !std::env::args().any(|word| word == "run") {
        println!("compares with Verilator, CXXRTL and Icarus: cargo bench --bench peers -- run");
        return Ok(());
    }
    let folder = tempfile::tempdir()?;
    let peers = build::all(folder.path())?;
    let netlist = device().netlist();
    let works = [
        Work {
            name: "held in reset",
            events: held(netlist),
            clocks: 2_000_000,
            clocks_for_slow: 50_000,
        },
        Work {
            name: "all active",
            events: all_active(netlist, 2_000_000),
            clocks: 2_000_000,
            clocks_for_slow: 50_000,
        },
        Work {
            name: "dense",
            events: dense(netlist, 2_000_000),
            clocks: 2_000_000,
            clocks_for_slow: 50_000,
        },
        Work {
            name: "irregular",
            events: irregular(netlist, 2_000_000),
            clocks: 2_000_000,
            clocks_for_slow: 50_000,
        },
        Work {
            name: "pass at 15 rpm",
            events: pass(netlist, 6_000_000, 15.0, 12e6),
            clocks: 6_000_000,
            clocks_for_slow: 50_000,
        },
    ];
    println!("{}", machine()?);
    let mut columns = Vec::new();
    for work in works {
        columns.push(measure(&work, &peers, folder.path())?);
    }
    println!("{}", table::engines(&columns));
    let pass_ns = columns.last().map_or(f64::NAN, |pass| 1e9 * pass.quickest_peer());
    println!("{}", ours::closed_loop(pass_ns)?);
    println!("{}", ours::by_clock_rate()?);
    Ok(())
}

/// The processor, the compiler, and what is not measured.
fn machine() -> anyhow::Result<String> {
    let processor = std::fs::read_to_string("/proc/cpuinfo")?;
    let name = processor.lines().find_map(|line| line.strip_prefix("model name")).unwrap_or("");
    let mut lines = vec![name.trim_start_matches([':', '\t', ' ']).to_owned()];
    for (tool, flag) in [("g++", "--version"), ("iverilog", "-V")] {
        lines.push(tools::version(tool, flag)?);
    }
    if tools::verilators()?.len() == 1 || tools::yosyses()?.len() == 1 {
        lines.push(format!(
            "not measured: newer peers, which `python3 -m venv {0}` and `{0}/bin/pip install -r \
             benches/peers/requirements.txt` bring",
            tools::ENVIRONMENT
        ));
    }
    Ok(lines.join("\n") + "\n")
}

/// Everybody on one stimulus.
fn measure(work: &Work, peers: &[Peer], folder: &Path) -> anyhow::Result<Column> {
    let mut column = Column::new(work.name);
    for _ in 0..ROUNDS {
        for engine in ours::ENGINES {
            let clocks = if engine.slow { work.clocks_for_slow } else { work.clocks };
            let run = ours::run(engine, &work.events, clocks)?;
            column.add(engine.name, &run)?;
        }
        let lanes = ours::run_lanes(&work.events, work.clocks_for_slow)?;
        column.add("helixlock, 512 lanes, each lane", &lanes)?;
        for peer in peers {
            let clocks = if peer.slow { work.clocks_for_slow } else { work.clocks };
            let run = peer.run(&work.events, clocks, folder)?;
            column.add(&peer.name, &run)?;
        }
    }
    Ok(column)
}
