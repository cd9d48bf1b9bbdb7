//! Emitted Verilog, as text a reviewer can read and a tool can run.

use std::path::Path;

use expect_test::expect_file;
use helixlock_netlist::{Design, Library, elaborate};
use helixlock_rtl::BLOCKS;

/// The whole device with its shell; its blocks carry the names of [`BLOCKS`].
pub(crate) fn whole_design() -> Design {
    let library = BLOCKS.iter().fold(Library::new(), |library, card| {
        library.with(card.name, card.summary, (card.build)())
    });
    let shell = BLOCKS.last().expect("there are blocks");
    elaborate(shell.name, &*(shell.build)(), &library).expect("the design is sound")
}

#[test]
fn every_block_is_as_reviewed() {
    let modules = helixlock_gen::verilog(&whole_design()).expect("the names are legal");
    let names: Vec<_> = modules.iter().map(|(name, _)| name.as_str()).collect();
    for card in BLOCKS {
        assert!(names.contains(&card.name), "{} is in the device: {names:?}", card.name);
    }
    for (name, text) in &modules {
        expect_file![Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/golden/{name}.v"))]
            .assert_eq(text);
    }
}
