//! Emitted Verilog, as text a reviewer can read and tools can run.

use std::path::{Path, PathBuf};
use std::process::Command;

use expect_test::expect_file;
use helixlock_netlist::{Design, elaborate};
use helixlock_rtl::BLOCKS;
use helixlock_sim::library;

/// The block of that name, its inner blocks named as in [`BLOCKS`].
pub(crate) fn design_of(name: &str) -> Design {
    let card = BLOCKS.iter().find(|card| card.name == name).expect("the block is listed");
    elaborate(card.name, &*(card.build)(), &library()).expect("the design is sound")
}

/// The device in its shell.
pub(crate) fn whole_design() -> Design {
    design_of("board_shell")
}

/// The device with its wheels as inputs.
pub(crate) fn device_design() -> Design {
    design_of("device")
}

fn golden() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden")
}

#[test]
fn every_block_is_as_reviewed() {
    for card in BLOCKS {
        let modules = helixlock_gen::verilog(&design_of(card.name)).expect("names are legal");
        let (_, text) = modules.last().expect("there is a top");
        expect_file![golden().join(format!("{}.v", card.name))].assert_eq(text);
    }
}

/// Fails when the tool fails or has anything to remark.
fn is_silent(tool: &str, words: &[&str]) {
    let files = BLOCKS.iter().map(|card| format!("{}.v", card.name));
    let words = words.iter().map(|word| (*word).to_owned()).chain(files);
    let output = Command::new(tool).args(words).current_dir(golden()).output();
    let output = output.unwrap_or_else(|error| panic!("{tool}: {error}"));
    let said = [output.stdout, output.stderr].concat();
    let said = String::from_utf8_lossy(&said);
    assert!(output.status.success() && said.is_empty(), "{tool}: {said}");
}

#[test]
fn verilator_has_no_remark() {
    for card in BLOCKS {
        is_silent("verilator", &["--lint-only", "-Wall", "--top-module", card.name]);
    }
}

#[test]
fn icarus_has_no_remark() {
    for card in BLOCKS {
        is_silent("iverilog", &["-g2005", "-Wall", "-t", "null", "-s", card.name]);
    }
}

#[test]
fn yosys_has_no_remark() {
    let script = "hierarchy -check; proc; check -assert";
    is_silent("yosys", &["-q", "-p", script]);
}
