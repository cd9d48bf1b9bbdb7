//! The proofs of the emitted Verilog go through, and would not if it were wrong.
//!
//! `cargo xtask prove` does the same with every mutant, and with a waveform for every state that
//! the properties call interesting.

use helixlock_evidence::prove::exhaustive::{Outcome, exhaustively};
use helixlock_evidence::prove::lockstep::History;
use helixlock_evidence::prove::mutants::{Fate, of_module, try_mutant};
use helixlock_evidence::prove::properties::{Verdict, prove};
use helixlock_evidence::prove::synthesis::{self, recorded, synthesised};
use helixlock_evidence::prove::vacuity::idle;
use helixlock_evidence::prove::{Sources, document, forgets};
use helixlock_gen::Family;
use tempfile::TempDir;

use crate::support::command::{put, repository};
use crate::support::seeds::all_boards_are_asked;

fn sources() -> Sources {
    Sources::of(repository())
}

/// The sources with a text in one file of theirs exchanged for another; they go with the folder.
fn altered(file: &str, was: &str, now: &str) -> (TempDir, Sources) {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let sound = sources();
    for from in [&sound.verilog, &sound.properties] {
        for entry in std::fs::read_dir(from).expect("the folder is there") {
            let path = entry.expect("it can be listed").path();
            let name = path.file_name().expect("a file").to_string_lossy().into_owned();
            let text = std::fs::read_to_string(&path).expect("it is text");
            let wrong = if name == file { text.replacen(was, now, 1) } else { text.clone() };
            assert_eq!(wrong == text, name != file, "{file} has `{was}`");
            put(&folder.path().join(name), &wrong);
        }
    }
    let path = folder.path().to_owned();
    (folder, Sources { verilog: path.clone(), properties: path })
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

/// The table of `docs/verification.md` was made from the Verilog and the properties as they are.
#[test]
fn the_printed_table_is_fresh() {
    let stale = document::stale(repository(), &sources()).expect("the document is there");
    let how = "cargo xtask prove --write, with --block for one";
    assert!(stale.is_empty(), "docs/verification.md is stale of {stale:?}: {how}");
}

/// What is said of a block is stale with its properties, and with any Verilog in it; no other is.
#[test]
fn what_is_said_of_a_block_is_stale_with_its_sources() {
    let stale_with = |file: &str, was: &str, now: &str| {
        let (_folder, other) = altered(file, was, now);
        document::stale(repository(), &other).expect("the document is there")
    };
    assert_eq!(stale_with("phase_meter.sv", "endmodule", "\nendmodule"), ["phase_meter"]);
    let made_of_it = ["board_shell", "device", "phase_meter"];
    assert_eq!(stale_with("phase_meter.v", "1'b1;", "1'b0;"), made_of_it);
}

/// The gates of the blocks that count, unbounded, and of an iCE40 those of the device on its board,
/// which has the others in it; with `HELIXLOCK_BOARD=all` every block's of every family.
fn gates_equal_the_verilog(family: Family) {
    let all = all_boards_are_asked();
    let counts = ["decade_counter", "programmable_divider", "phase_meter", "reset_counter"];
    let sources = sources();
    for card in synthesis::blocks() {
        let whole = family == Family::Ice40 && card.name == "board_shell";
        if !(all || whole || counts.contains(&card.name)) {
            continue;
        }
        let verdict = synthesised(&sources, &sources, card.name, family).expect("yosys starts");
        assert!(matches!(verdict, synthesis::Verdict::Equal { .. }), "{}: {verdict:?}", card.name);
    }
}

#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn gates_of_ice40_equal_the_verilog() {
    gates_equal_the_verilog(Family::Ice40);
}

#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn gates_of_ecp5_equal_the_verilog() {
    gates_equal_the_verilog(Family::Ecp5);
}

#[test]
fn gates_of_gowin_equal_the_verilog() {
    gates_equal_the_verilog(Family::Gowin);
}

#[test]
fn gates_of_another_ring_are_not_equal() {
    let (_folder, wrong) = altered("ring_distributor.v", "a_d = ~b_q;", "a_d = b_q;");
    for family in Family::ALL {
        let verdict = synthesised(&sources(), &wrong, "ring_distributor", family);
        let verdict = verdict.expect("yosys starts");
        let synthesis::Verdict::Unequal { log } = verdict else { panic!("{verdict:?}") };
        assert!(log.ends_with("they differ 2 clocks after power-up"), "{log}");
    }
}

/// With the carry cells of yosys 0.23 the decade's comparison with 9 is wrong, and it wraps at 6.
#[test]
fn gates_that_wrap_at_six_are_not_equal() {
    let gates = repository().join("tests/cases/gates/gowin_carry_cells_of_yosys_0_23.v");
    let verdict = recorded(&sources(), &gates, "decade_counter", Family::Gowin);
    let synthesis::Verdict::Unequal { log } = verdict.expect("yosys starts") else {
        panic!("a decade that wraps at 6 equals one that wraps at 10");
    };
    assert!(log.ends_with("they differ 6 clocks after power-up"), "{log}");
}

/// Every state with every input of the blocks that have few; the four million of divider and decoder
/// each are left to `cargo xtask prove`.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn few_states_are_all_tried() {
    let sources = sources();
    let mut tried = 0;
    let many = ["programmable_divider", "quadrature_decoder"];
    for card in synthesis::blocks().filter(|card| !many.contains(&card.name)) {
        match exhaustively(&sources, card.name).expect("Icarus starts") {
            Outcome::TooMany => {}
            Outcome::Alike(_) => tried += 1,
            Outcome::Differs(first) => panic!("{}: {first}", card.name),
        }
    }
    assert_eq!(tried, 15, "blocks with few states");
}

#[test]
fn one_wrong_transition_is_found() {
    let (_folder, wrong) = altered("ring_distributor.v", "c_d = ~b_q;", "c_d = b_q;");
    let outcome = exhaustively(&wrong, "ring_distributor").expect("Icarus starts");
    let Outcome::Differs(first) = outcome else { panic!("{outcome:?}") };
    assert!(first.starts_with("DIFFERS after state "), "{first}");
}

/// Every assertion of these is reached; `cargo xtask prove` tries those of all blocks.
#[test]
fn no_assertion_is_idle() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    for block in ["phase_meter", "ring_distributor", "standard_wave", "reset_counter"] {
        let idle = idle(&sources(), block, folder.path()).expect("yosys starts");
        assert!(idle.is_empty(), "{block}: {idle:?}");
    }
}

/// With a contradiction among its assumptions a proof goes through, and every assertion is idle.
#[test]
fn a_contradiction_makes_assertions_idle() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let (was, now) = ("endmodule", "    always @* assume (hold && !hold);\nendmodule");
    let (_folder, vacuous) = altered("phase_meter.sv", was, now);
    let proof = prove(&vacuous, "phase_meter").expect("yosys starts");
    assert!(matches!(proof, Verdict::Proven { .. }), "{proof:?}");
    let idle = idle(&vacuous, "phase_meter", folder.path()).expect("yosys starts");
    assert_eq!(idle, ["assert (meter == grating_last);"]);
}

/// What a block's first difference is worth is said with it.
#[test]
fn a_difference_of_a_block_is_given_in_micrometres() {
    let (_folder, wrong) = altered("phase_meter.v", "1'b1;", "1'b0;");
    let history = History::draw("phase_meter", 2_000, 1).expect("a block of the list");
    let said = history.first_difference(&wrong).expect("Icarus starts").expect("they differ");
    assert!(said.starts_with("first difference at clock "), "{said}");
    let tail = "\n  meter: engine 1, Verilog 0: a clock is 0.00005 µm in this comparison";
    assert!(said.ends_with(tail), "{said}");
}
