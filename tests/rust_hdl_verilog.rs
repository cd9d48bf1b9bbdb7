//! Our Verilog computes what rust-hdl's own Verilog computes: yosys proves it for every block.
//!
//! rust-hdl calls a flip-flop's output `x$q` where ours is `x_q`. With that changed, every
//! flip-flop has its partner, and the proof is by induction: partners that are equal are equal
//! after the next clock, whatever the state and the inputs. They start equal, at zero.

use std::path::Path;
use std::process::Command;

use helixlock_netlist::{Library, elaborate};
use helixlock_rtl::{APART, BLOCKS, BlockCard};
use rust_hdl::core::module_defines::ModuleDefines;

use crate::golden_verilog::design_of;

/// rust-hdl's Verilog of a block, with `_` for `$`.
fn theirs(card: &BlockCard) -> String {
    let mut modules = ModuleDefines::default();
    (card.build)().accept("top", &mut modules);
    modules.defines().replace('$', "_")
}

/// What yosys says of the two texts; an error when they differ.
fn proof(block: &str, ours: &[(String, String)], theirs: &str) -> Result<String, String> {
    let folder = tempfile::tempdir().expect("a scratch folder");
    put(folder.path(), "theirs.v", theirs);
    let ours: String = ours.iter().map(|(_, text)| text.as_str()).collect();
    put(folder.path(), "ours.v", &ours);
    let script = format!(
        "read_verilog theirs.v; hierarchy -top top; proc; flatten; design -stash gold; \
         read_verilog ours.v; hierarchy -top {block}; proc; flatten; design -stash gate; \
         design -copy-from gold -as gold top; design -copy-from gate -as gate {block}; \
         equiv_make gold gate equiv; hierarchy -top equiv; clean; \
         equiv_simple; equiv_induct; equiv_status -assert"
    );
    let output = Command::new("yosys")
        .args(["-p", &script])
        .current_dir(folder.path())
        .output()
        .expect("yosys is installed");
    let said = String::from_utf8_lossy(&[output.stdout, output.stderr].concat()).into_owned();
    if output.status.success() { Ok(said) } else { Err(said) }
}

#[expect(clippy::disallowed_methods, reason = "a test's scratch folder")]
fn put(folder: &Path, name: &str, text: &str) {
    std::fs::write(folder.join(name), text).expect("the scratch folder is writable");
}

#[test]
fn every_block_is_proven_equal() {
    let apart = |card: &BlockCard| {
        let library = Library::new().with(card.name, card.summary, (card.build)());
        elaborate(card.name, &*(card.build)(), &library).expect("the design is sound")
    };
    let blocks = BLOCKS.iter().map(|card| (card, design_of(card.name)));
    for (card, design) in blocks.chain(APART.iter().map(|card| (card, apart(card)))) {
        let ours = helixlock_gen::verilog(&design).expect("legal names");
        let said = proof(card.name, &ours, &theirs(card));
        let said = said.unwrap_or_else(|said| panic!("{}: {said}", card.name));
        assert!(said.contains("Equivalence successfully proven!"), "{}", card.name);
    }
}

#[test]
fn a_single_changed_gate_is_found() {
    let mut ours = helixlock_gen::verilog(&design_of("ring_distributor")).expect("legal names");
    let (_, text) = ours.last_mut().expect("there is a top");
    let sound = text.clone();
    *text = text.replacen("a_d = ~b_q;", "a_d = b_q;", 1);
    assert_ne!(*text, sound);
    let ring = BLOCKS.iter().find(|card| card.name == "ring_distributor").expect("it is listed");
    let said = proof(ring.name, &ours, &theirs(ring));
    let said = said.expect_err("they differ");
    assert!(said.contains("unproven"), "{said}");
}
