//! The same pins, clock by clock, for our engines and for others made from our Verilog.
//!
//! ```text
//! cargo bench --bench peers -- run
//! ```
//!
//! builds Verilator (plain, and guided by a profile), CXXRTL and Icarus from the emitted Verilog,
//! runs all of them alternately, holds every end state to ours, and prints a table of ratios. Times
//! are processor time, so that another program on the machine does not count.

#![allow(clippy::print_stdout, reason = "a benchmark prints what it measured")]
#![allow(clippy::cast_precision_loss, reason = "clocks stay below 2⁵³")]

mod build;
mod ours;
#[path = "../stimulus.rs"]
mod stimulus;
mod table;

use std::path::Path;

use helixlock_sim::device;

use crate::build::Peer;
use crate::stimulus::{PinEvent, dense, pass};

/// Runs of each engine; the quickest counts.
const ROUNDS: usize = 3;

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
            name: "dense: every clock has work",
            events: dense(netlist, 2_000_000),
            clocks: 2_000_000,
            clocks_for_slow: 50_000,
        },
        Work {
            name: "pass: 15 rpm at 12 MHz",
            events: pass(netlist, 6_000_000, 15.0, 12e6),
            clocks: 6_000_000,
            clocks_for_slow: 50_000,
        },
    ];
    let mut reference_ns = f64::NAN;
    for work in works {
        let rows = measure(&work, &peers, folder.path())?;
        println!("{}", rows.table(work.name));
        reference_ns = rows.reference_ns();
    }
    println!("{}", ours::closed_loop(reference_ns)?);
    println!("{}", ours::by_clock_rate());
    Ok(())
}

/// Everybody on one stimulus.
fn measure(work: &Work, peers: &[Peer], folder: &Path) -> anyhow::Result<table::Rows> {
    let mut rows = table::Rows::new();
    for _ in 0..ROUNDS {
        for engine in ours::ENGINES {
            let clocks = if engine.slow { work.clocks_for_slow } else { work.clocks };
            let run = ours::run(engine, &work.events, clocks)?;
            rows.add(engine.name, &run)?;
        }
        let lanes = ours::run_lanes(&work.events, work.clocks_for_slow)?;
        rows.add("helixlock 512 lanes, each", &lanes)?;
        for peer in peers {
            let clocks = if peer.slow { work.clocks_for_slow } else { work.clocks };
            let run = peer.run(&work.events, clocks, folder)?;
            rows.add(&peer.name, &run)?;
        }
    }
    Ok(rows)
}
