//! Our Verilog computes what rust-hdl's own Verilog computes: yosys proves it for every block.
//!
//! From power-up on, where all flip-flops are zero, both answer alike to every input, for ever.

use std::path::Path;

use helixlock_evidence::prove::alike::{Likeness, alike};
use helixlock_netlist::{Library, elaborate};
use helixlock_rtl::{APART, BLOCKS, BlockCard};
use rust_hdl::core::module_defines::ModuleDefines;

use crate::golden_verilog::design_of;

/// rust-hdl's Verilog of a block.
fn theirs(card: &BlockCard) -> String {
    let mut modules = ModuleDefines::default();
    (card.build)().accept("top", &mut modules);
    modules.defines()
}

/// What becomes of the two texts, and what the tools said.
fn compared(block: &str, ours: &[(String, String)], theirs: &str) -> (Likeness, String) {
    let folder = tempfile::tempdir().expect("a scratch folder");
    put(folder.path(), "theirs.v", theirs);
    let ours: String = ours.iter().map(|(_, text)| text.as_str()).collect();
    put(folder.path(), "ours.v", &ours);
    let flat = |file: &str, top: &str| {
        let file = folder.path().join(file);
        format!("read_verilog {}; hierarchy -top {top}; proc; flatten; opt_clean;", file.display())
    };
    let theirs = format!("{} rename top {block};", flat("theirs.v", "top"));
    alike(block, &flat("ours.v", block), &theirs).expect("yosys and abc start")
}

#[expect(clippy::disallowed_methods, reason = "a test's scratch folder")]
fn put(folder: &Path, name: &str, text: &str) {
    std::fs::write(folder.join(name), text).expect("the scratch folder is writable");
}

/// Proves one block in so many equal.
fn are_proven_equal(one_in: usize) {
    let apart = |card: &BlockCard| {
        let library = Library::new().with(card.name, card.summary, (card.build)());
        elaborate(card.name, &*(card.build)(), &library).expect("the design is sound")
    };
    let blocks = BLOCKS.iter().map(|card| (card, design_of(card.name)));
    let blocks = blocks.chain(APART.iter().map(|card| (card, apart(card))));
    for (card, design) in blocks.step_by(one_in) {
        let ours = helixlock_gen::verilog(&design).expect("legal names");
        let (likeness, said) = compared(card.name, &ours, &theirs(card));
        assert_eq!(likeness, Likeness::Alike, "{}: {said}", card.name);
    }
}

#[test]
fn every_fifth_block_is_proven_equal() {
    are_proven_equal(5);
}

#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn every_block_is_proven_equal() {
    are_proven_equal(1);
}

#[test]
fn a_single_changed_gate_is_found() {
    let mut ours = helixlock_gen::verilog(&design_of("ring_distributor")).expect("legal names");
    let (_, text) = ours.last_mut().expect("there is a top");
    let sound = text.clone();
    *text = text.replacen("a_d = ~b_q;", "a_d = b_q;", 1);
    assert_ne!(*text, sound);
    let ring = BLOCKS.iter().find(|card| card.name == "ring_distributor").expect("it is listed");
    let (likeness, said) = compared(ring.name, &ours, &theirs(ring));
    assert_eq!(likeness, Likeness::Differ { clock: 2 }, "{said}");
}
