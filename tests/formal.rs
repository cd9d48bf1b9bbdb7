//! The proofs of the emitted Verilog go through, and would not if it were wrong.
//!
//! `cargo xtask prove` does the same with every mutant, and with a waveform for every state that
//! the properties call interesting.

use std::path::Path;

use xtask::prove::lockstep::History;
use xtask::prove::mutants::{Fate, of_module, try_mutant};
use xtask::prove::properties::{Verdict, prove};
use xtask::prove::{Sources, forgets};

fn sources() -> Sources {
    Sources::of(Path::new(env!("CARGO_MANIFEST_DIR")))
}

/// Every block with properties, unbounded, from any power-up state.
#[test]
fn properties_hold() {
    let sources = sources();
    let blocks = sources.blocks().expect("tests/formal is there");
    assert!(blocks.len() >= 18, "{blocks:?}");
    for block in blocks {
        match prove(&sources, &block).expect("yosys, a Debian package, starts") {
            Verdict::Proven { .. } => {}
            Verdict::NotProven { log } => panic!("{block}: {log}"),
        }
    }
}

#[test]
fn a_reset_forgets_the_power_up_state() {
    let registers = forgets::power_up(&sources()).expect("yosys, a Debian package, starts");
    assert!(registers.is_some_and(|registers| registers > 50), "{registers:?}");
}

/// A few mutants of each block that a machine depends on: all are noticed.
#[test]
fn mistakes_are_noticed() {
    let sources = sources();
    for block in ["programmable_divider", "phase_meter", "reset_counter", "ring_distributor"] {
        let history = History::draw(block, 20_000, 1).expect("a block of the list");
        assert_eq!(history.first_difference(&sources).expect("Icarus starts"), None, "{block}");
        let mutants = of_module(&sources, block).expect("its file is there");
        for mutant in mutants.iter().step_by(mutants.len() / 3) {
            let fate = try_mutant(&sources, mutant, &history).expect("the tools start");
            assert!(matches!(fate, Fate::Properties | Fate::Lockstep), "{mutant:?}: {fate:?}");
        }
    }
}
